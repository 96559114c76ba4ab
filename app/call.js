// Runs a function of frontend/src/figures/callbacks.js for a callback of Bokeh's or Panel's, which may come before the bundle.
const act = () => window.tippeCallbacks[run](given, cb_obj);
if (window.tippeCallbacks) act();
else window.addEventListener("tippe:callbacks", act, { once: true });

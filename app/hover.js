// What Bokeh writes beside the mouse, by a function of frontend/src/figures/callbacks.js.
return window.tippeCallbacks?.[run](given, { value, format, ...special_vars });

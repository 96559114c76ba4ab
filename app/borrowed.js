// What is borrowed of Bokeh's and Panel's scripts that has to be done before the bundle is there: first.html runs this, with
// the addresses of the bundles. The rest, and what holds for all: frontend/src/borrowed.js.

// 1. Bokeh asks the style sheets for each colour and width of each stroke (--bk-...), and has the browser work them out anew
// each time: nine tenths of a figure's painting. Here they say nothing of it. https://github.com/bokeh/bokeh/issues/15286
try {
  Bokeh.require("core/visuals/visual").VisualProperties.prototype._get_css_value = () => "";
} catch (error) {
  console.warn(error); // slower, and nothing else
}

// 2. Panel fetches a component's bundle when the first of its components comes, reads through it and runs a copy. The browser
// has ours by then: under its address (https://github.com/holoviz/panel/pull/7410) it is given out as it is.
const ours = new Set(bundles.map((path) => new URL(path, document.baseURI).href));
const theirs = window.importShim;
const load = (path, ...more) => {
  const { href } = new URL(path, document.baseURI);
  return ours.has(href) ? import(href) : theirs(path, ...more);
};
window.importShim = Object.setPrototypeOf(load, theirs);
// run while the server makes the session
const runAll = () => ours.forEach((href) => import(href).catch(console.error));
addEventListener("DOMContentLoaded", () => setTimeout(runAll));

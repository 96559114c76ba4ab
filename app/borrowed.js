// What is borrowed of Bokeh's scripts that has to be done before the bundle is there: it stands in the page
// itself. The rest, and what holds for all: frontend/src/borrowed.js.

// 1. Bokeh asks the style sheets for each colour and width of each stroke (--bk-...), and for the size of letters, and has the
// browser work them out anew each time: nine tenths of a figure's painting. Here they say nothing of it. And where a label of
// an axis takes more room, or a figure that is hidden is painted, it lays out all of the page: here what is seen of a figure
// alone, whose own size its place gives. https://github.com/bokeh/bokeh/issues/15286, https://github.com/bokeh/bokeh/issues/12129
try {
  Bokeh.require("core/visuals/visual").VisualProperties.prototype._get_css_value = () => "";
  const figure = Bokeh.require("models/plots/plot_canvas").PlotView.prototype;
  const sheet = Bokeh.require("core/dom").InlineStyleSheet.prototype;
  Object.defineProperty(figure, "base_font_size", { get: () => null });
  const { _update: renew } = sheet, { _invalidate_layout_if_needed: look, compute_layout: everywhere } = figure;
  sheet._update = function (css) {
    if (css !== this.css) renew.call(this, css);
  };
  figure._invalidate_layout_if_needed = function () {
    if (this.is_displayed || !this.is_managed) look.call(this);
  };
  figure.compute_layout = function () {
    if (!this.is_managed) return everywhere.call(this);
    this.measure_layout();
    this._compute_layout();
    this.after_layout();
  };
} catch (error) {
  console.warn(error); // slower, and nothing else
}

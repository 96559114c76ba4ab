// By which Bokeh writes a number on an axis of a page whose language has no decimal point.
// @ts-expect-error: Bokeh makes a function of it
return String(Number(tick.toPrecision(12))).replace("-", "−").replace(".", point);

// By which Bokeh writes a number on an axis of a page whose language has no decimal point.
return String(Number(tick.toPrecision(12))).replace("-", "−").replace(".", point);

// By which Bokeh writes the numbers on an axis of a page whose language has no decimal point: as it would, but for the point.
// @ts-expect-error: Bokeh makes a function of it, for each number; `this` is one and the same for all on an axis
return (this.labels ??= basic.doFormat(ticks, { loc: 0 }))[index].replace(".", point);

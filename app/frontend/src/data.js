// Arrays come as bytes: an ArrayBuffer on the wire, so nothing passes through JSON.
export function float32(bytes) {
  if (!bytes) return new Float32Array(0);
  if (bytes instanceof ArrayBuffer) return new Float32Array(bytes);
  // A view may start off a multiple of four: then only a copy can be read as floats.
  if (bytes.byteOffset % 4) return new Float32Array(bytes.slice().buffer);
  return new Float32Array(bytes.buffer, bytes.byteOffset, bytes.byteLength >> 2);
}

// The largest of 1, 2, 5 times a power of ten that is at most x.
export function niceBelow(x) {
  if (!(x > 0) || !isFinite(x)) return 1;
  const decade = 10 ** Math.floor(Math.log10(x));
  const digits = x / decade;
  return decade * (digits >= 5 ? 5 : digits >= 2 ? 2 : 1);
}

// Calls run once before the next paint, however often it was asked for in between.
export function coalesce(run) {
  let asked = 0;
  const later = () => {
    asked ||= requestAnimationFrame(() => {
      asked = 0;
      run();
    });
  };
  later.cancel = () => {
    cancelAnimationFrame(asked);
    asked = 0;
  };
  return later;
}

// Writes films into files. The page fetches this only when a film is made: app/bundle.py says from where.
import { applyPalette, GIFEncoder, quantize } from "gifenc";
import { BufferTarget, CanvasSource, Mp4OutputFormat, Output, QUALITY_HIGH, WebMOutputFormat } from "mediabunny";

const FORMATS = { webm: () => new WebMOutputFormat(), mp4: () => new Mp4OutputFormat() };
const KEY_S = 1; // between two pictures that a player can jump to
const COLOURS = 256;

/** @typedef {{ add(at: number): unknown, end(): Promise<Blob>, stop(): unknown }} Writer */

// A film of what the canvas shows at each call of add, which is given the number of the picture.
/**
 * @param {string} kind "webm", "mp4" or "gif" @param {any} codec of a video, as the library calls it
 * @param {HTMLCanvasElement} canvas @param {{ rate: number, width: number, height: number }} size rate: pictures a second
 * @returns {Promise<Writer>}
 */
export async function writerOf(kind, codec, canvas, size) {
  if (kind === "gif") return gif(canvas, size);
  const { rate } = size, target = new BufferTarget(), output = new Output({ format: FORMATS[kind](), target });
  const source = new CanvasSource(canvas, { codec, bitrate: QUALITY_HIGH, keyFrameInterval: KEY_S });
  output.addVideoTrack(source, { frameRate: rate });
  await output.start();
  return {
    add: (at) => source.add(at / rate, 1 / rate),
    async end() {
      await output.finalize();
      return new Blob([/** @type {ArrayBuffer} */ (target.buffer)], { type: `video/${kind}` });
    },
    stop: () => output.cancel(),
  };
}

/** @returns {Writer} */
function gif(canvas, { rate, width, height }) {
  const small = document.createElement("canvas"), file = GIFEncoder();
  Object.assign(small, { width, height });
  const pen = /** @type {CanvasRenderingContext2D} */ (small.getContext("2d", { willReadFrequently: true }));
  return {
    add() {
      pen.drawImage(canvas, 0, 0, width, height);
      const { data } = pen.getImageData(0, 0, width, height), palette = quantize(data, COLOURS);
      file.writeFrame(applyPalette(data, palette), width, height, { palette, delay: 1000 / rate });
    },
    async end() {
      file.finish();
      return new Blob([file.bytes()], { type: "image/gif" });
    },
    stop() {},
  };
}

// The functions that Python has Bokeh call, by name: see app/bundle.py. Arguments: what Python passed, then the event.
import { keepFinger, moveBead, pullBead } from "./maps.js";
import { moveLines, nameFigure } from "./common.js";
import { pullFilm } from "./measured.js";
import { followCurve, seekOnCurve } from "./portraits.js";
import { followWell } from "./run.js";
import { seekAlong } from "./seeking.js";

const callbacks = {
  followCurve, followWell, keepFinger, moveBead, moveLines, nameFigure, pullBead, pullFilm,
  seekAlong, seekOnCurve,
};

export function offerCallbacks() {
  window.tippeCallbacks = callbacks;
  window.dispatchEvent(new CustomEvent("tippe:callbacks"));
}

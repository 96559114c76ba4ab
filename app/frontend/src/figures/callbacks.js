// What Python has Bokeh call, by its name: app/bundle.py. Each takes what it was given there, then what happened.
import { keepFinger, pullBead } from "./maps.js";
import { moveLines, nameFigure } from "./common.js";
import { followMotion, pullPlane, readPlane, sayPull } from "./plane.js";
import { followPlanes } from "./planes.js";
import { followCurve, seekOnCurve } from "./portraits.js";
import { pressSection } from "./sections.js";
import { seekAlong } from "./seeking.js";
import { turnTab } from "../widgets/tabs.js";

const callbacks = {
  followCurve, followMotion, followPlanes, keepFinger, moveLines, nameFigure, pressSection, pullBead, pullPlane, readPlane,
  sayPull, seekAlong, seekOnCurve, turnTab,
};

export function offerCallbacks() {
  window.tippeCallbacks = callbacks;
  window.dispatchEvent(new CustomEvent("tippe:callbacks"));
}

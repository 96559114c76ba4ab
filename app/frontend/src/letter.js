// The own pictures in a letter: a page that works without a server. It contains the values of their models.
import { bytesOf } from "./data.js";
import { renderPlane } from "./plane/plane.js";
import { renderSurface3D } from "./three/surface3d.js";
import { renderTop3D } from "./three/top3d.js";

const pictures = { PlaneView: renderPlane, Surface3D: renderSurface3D, Top3D: renderTop3D };

// A stand-in for the model that Panel passes to a component: values, with listeners that run when one is set.
/** @param {Record<string, any>} values */
export function modelOf(values) {
  const asked = {};
  return new Proxy(values, {
    get: (_, /** @type {string} */ name) => (name === "on" ? (event, run) => (asked[event] ??= []).push(run) : values[name]),
    set: (_, /** @type {string} */ name, value) => {
      const news = values[name] !== value;
      values[name] = value;
      if (news) asked[name]?.forEach((run) => run());
      return true;
    },
  });
}

/** @param {Record<string, Record<string, any>>} models by the id of the element that holds the picture */
export function letter(models) {
  for (const [name, said] of Object.entries(models)) {
    const values = Object.fromEntries(Object.entries(said).map(([key, value]) =>
      [key, value?.base64 === undefined ? value : bytesOf(value.base64)]));
    const place = /** @type {HTMLElement} */ (document.getElementById(name)), el = document.createElement("div");
    el.style.height = "100%";
    place.attachShadow({ mode: "open" }).append(el);
    pictures[name]({ model: modelOf(values), el, view: {} });
  }
}

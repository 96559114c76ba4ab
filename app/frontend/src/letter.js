// Components in a page that works without a server. It contains the values of their models.
import { valued } from "./data.js";
import { renderPlane } from "./plane/plane.js";
import { renderSurface3D } from "./three/surface3d.js";

const pictures = { PlaneView: renderPlane, Surface3D: renderSurface3D };

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

// Draws a component from these values, in place of what is there.
/** @param {string} id of the element @param {Record<string, any>} values @param {(rendering: any) => void} render */
export function drawIn(id, values, render) {
  const place = /** @type {HTMLElement} */ (document.getElementById(id)), el = document.createElement("div"), model = modelOf(values);
  el.style.height = "100%";
  (place.shadowRoot ?? place.attachShadow({ mode: "open" })).replaceChildren(el);
  render({ model, el, view: {} });
  return { model, leave: () => void Object.assign(model, { remove: true }) };
}

/** @param {string} models JSON of their values, by the id of the element that holds the picture */
export function letter(models) {
  for (const [name, values] of Object.entries(valued(models))) drawIn(name, values, pictures[name]);
}

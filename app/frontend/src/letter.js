// Components in a page that works without a server. It contains the values of their models.
import { valued } from "./data.js";
import { modelOf } from "./stand_in.js";
import { renderPlane } from "./plane/plane.js";
import { renderSurface3D } from "./three/surface3d.js";

const pictures = { PlaneView: renderPlane, Surface3D: renderSurface3D };

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

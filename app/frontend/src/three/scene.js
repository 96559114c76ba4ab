// The colours of the 3-D pictures: those of objects, on a light page and on a dark one. Text takes its colours from
// tokens.js.
import { colours, onDark } from "../colours.js";
import { isDark, onLook } from "../life.js";

const scenes = {
  light: {
    sky: "#f1efea", edge: "#5a3312", table: "#f6f1e9", grid: "#d6d5d1", strong: "#a9b0b8", ink: "#1d2733", shade: "#2a2118",
    ground: "#f7f8fa", lines: "#6b7a88", walls: 0.68, edges: 0.3,
    force: colours.normal, omega: colours.omega, momentum: colours.momentum,
  },
  dark: {
    sky: "#191f25", edge: "#f0cfa3", table: "#2b323a", grid: "#3d4751", strong: "#66727e", ink: "#eef2f6", shade: "#000000",
    ground: "#1b232c", lines: "#8a97a5", walls: 0.06, edges: 0.36,
    force: onDark.normal, omega: onDark.omega, momentum: onDark.momentum,
  },
};

// Calls dress now and whenever the look changes.
/** @param {(look: typeof scenes.light) => void} dress @param {AbortSignal} life */
export const followScene = (dress, life) => onLook(() => dress(scenes[isDark() ? "dark" : "light"]), life);

// What a scene keeps on the graphics card.
/** @param {import("three").Object3D} scene */
export function letGo(scene) {
  scene.traverse((/** @type {any} */ object) => {
    object.geometry?.dispose();
    for (const material of [object.material ?? []].flat()) {
      material.map?.dispose();
      material.dispose();
    }
    object.shadow?.dispose?.();
  });
}

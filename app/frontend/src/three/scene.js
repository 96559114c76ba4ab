// The colours of the 3-D pictures: those of objects, on a light page and on a dark one. Text takes its colours from
// tokens.js.
import { colours, onDark } from "../colours.js";
import { isDark, onLook } from "../life.js";

const scenes = {
  light: {
    sky: 0xf1efea, edge: 0x5a3312, table: 0xf6f1e9, grid: 0xd6d5d1, strong: 0xa9b0b8, ink: 0x1d2733, shade: 0x2a2118,
    ground: 0xf7f8fa, lines: 0x6b7a88, walls: 0.68, edges: 0.3,
    force: colours.normal, omega: colours.omega, momentum: colours.momentum,
  },
  dark: {
    sky: 0x191f25, edge: 0xf0cfa3, table: 0x2b323a, grid: 0x3d4751, strong: 0x66727e, ink: 0xeef2f6, shade: 0x000000,
    ground: 0x1b232c, lines: 0x8a97a5, walls: 0.06, edges: 0.36,
    force: onDark.normal, omega: onDark.omega, momentum: onDark.momentum,
  },
};

// Calls dress now and whenever the look changes.
/** @param {(look: typeof scenes.light) => void} dress @param {AbortSignal} life */
export const followScene = (dress, life) => onLook(() => dress(scenes[isDark() ? "dark" : "light"]), life);

// What a scene keeps on the graphics card.
/** @param {import("three").Scene} scene */
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

import { renderDial } from "./dial.js";
import { first } from "./first.js";
import { renderFirst } from "./first.js";
import { renderGuide } from "./guide.js";
import { renderLook } from "./look.js";
import { renderSurface3D } from "./surface3d.js";

// Panel looks a component up by its Python class's name.
export default { Dial: { render: renderDial }, Guide: { render: renderGuide }, Look: { render: renderLook }, Surface3D: { render: renderSurface3D }, Top3D: { render: renderFirst }, first };

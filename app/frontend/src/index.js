import { renderDial } from "./dial.js";
import { renderGuide } from "./guide.js";
import { renderLook } from "./look.js";
import { renderSurface3D } from "./surface3d.js";
import { renderTop3D } from "./top3d.js";

// Panel looks a component up by its Python class's name.
export default { Dial: { render: renderDial }, Guide: { render: renderGuide }, Look: { render: renderLook }, Surface3D: { render: renderSurface3D }, Top3D: { render: renderTop3D } };

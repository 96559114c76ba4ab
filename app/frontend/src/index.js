import { renderDial } from "./widgets/dial.js";
import { first } from "./first.js";
import { renderFirst } from "./first.js";
import { renderGuide } from "./widgets/guide.js";
import { renderLab } from "./lab/lab.js";
import { renderLook } from "./widgets/look.js";
import { renderSurface3D } from "./three/surface3d.js";

// Panel looks a component up by its Python class's name.
export default { Dial: { render: renderDial }, Guide: { render: renderGuide }, LabView: { render: renderLab }, Look: { render: renderLook }, Surface3D: { render: renderSurface3D }, Top3D: { render: renderFirst }, first };

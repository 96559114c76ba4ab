import { colours } from "./colours.js";
import * as THREE from "three";
export default { c: colours, t: THREE.Scene };

import { renderTop3D } from "./top3d.js";

// Panel looks a component up by its Python class's name.
export default { Top3D: { render: renderTop3D } };

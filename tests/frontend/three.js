// Next to the sources, three.js is installed only once the bundle has been built; the tests use the one of this folder.
import { registerHooks } from "node:module";

registerHooks({
  resolve: (name, context, next) => next(name, /^three(\/|$)/.test(name) ? { ...context, parentURL: import.meta.url } : context),
});

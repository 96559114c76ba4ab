// The sources lie where three.js is only once the bundle was built; here they get the one of this folder.
import { registerHooks } from "node:module";

registerHooks({
  resolve: (name, context, next) => next(name, /^three(\/|$)/.test(name) ? { ...context, parentURL: import.meta.url } : context),
});

// Patterns are from the project's folder, where ESLint is started.
import js from "@eslint/js";
import globals from "globals";

export default [
  { ignores: ["app/static"] }, // the bundle
  js.configs.recommended,
  {
    files: ["**/*.js"],
    languageOptions: { globals: { ...globals.browser, Bokeh: "readonly" } },
    rules: {
      "array-callback-return": "error",
      "default-param-last": "error",
      eqeqeq: "error",
      "max-lines": ["error", 350],
      "max-lines-per-function": ["error", 60],
      "no-constructor-return": "error",
      "no-self-compare": "error",
      "no-shadow": "error",
      "no-throw-literal": "error",
      "no-unmodified-loop-condition": "error",
      // Functions may call what stands below them.
      "no-use-before-define": ["error", { functions: false, classes: false, variables: false }],
      "no-var": "error",
      "prefer-const": "error",
    },
  },
  // Bodies of functions, with the names that Bokeh calls them with.
  {
    files: ["app/*.js"],
    languageOptions: {
      sourceType: "commonjs",
      globals: Object.fromEntries(["run", "given", "cb_obj", "value", "format", "special_vars", "bundles"].map((name) => [name, "readonly"])),
    },
  },
  { files: ["tests/frontend/*.js"], languageOptions: { globals: globals.node } },
];

// Patterns are from the project's folder, where ESLint is started.
import js from "@eslint/js";
import globals from "globals";

// The components' scripts in strings of Python, as if each were a file, with the lines that it has there.
const inPython = {
  preprocess: (text) =>
    [...text.matchAll(/_esm = """([^]*?)"""/g)].map(({ 1: script, index }) => ({
      text: "\n".repeat(text.slice(0, index).split("\n").length - 1) + script.replaceAll("\\\\", "\\"),
      filename: "esm.js",
    })),
  postprocess: (messages) => messages.flat(),
};

export default [
  { ignores: ["app/static"] }, // the bundle
  { files: ["app/**/*.py"], plugins: { python: { processors: { esm: inPython } } }, processor: "python/esm" },
  js.configs.recommended,
  {
    files: ["**/*.js"],
    languageOptions: { globals: { ...globals.browser, Bokeh: "readonly" } },
    rules: {
      "array-callback-return": "error",
      "default-param-last": "error",
      eqeqeq: "error",
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
  { files: ["app/**/*.py/*.js"], rules: { eqeqeq: "off", "no-useless-assignment": "off" } },
  { files: ["tests/frontend/*.js"], languageOptions: { globals: globals.node } },
];

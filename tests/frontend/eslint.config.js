// Patterns are relative to the project's folder, where ESLint is started.
import js from "@eslint/js";
import globals from "globals";

// Exported functions must document their parameters with @param or @type, which tsc checks.
const typed = {
  create(context) {
    const look = (node, made) => {
      const wording = context.sourceCode.getCommentsBefore(node).some(({ value }) => /@(param|type)\b/.test(value));
      const inside = made.params.every(({ loc }) => context.sourceCode.lines[loc.start.line - 1].includes("/** @type"));
      if (made.params.length && !wording && !inside) context.report({ node, message: "An exported function says the types of what it takes." });
    };
    return {
      ExportNamedDeclaration(node) {
        const { declaration } = node;
        if (declaration?.type === "FunctionDeclaration") look(node, declaration);
        for (const { init } of declaration?.declarations ?? []) if (init?.type === "ArrowFunctionExpression") look(node, init);
      },
    };
  },
};

// Each folder imports only from those before it, and from the files beside them all.
const FOLDERS = ["motion", "figures", "three", "controls", "widgets", "plane", "lab", "learn"];
const importsOnly = (/** @type {string[]} */ folders, /** @type {string[]} */ files) => ({
  files, rules: { "no-restricted-imports": ["error", { patterns: [{ regex: `^\\.\\.?/(${folders.join("|")})/` }] }] },
});
const BASE = "data,life,parts,paint,colours,tokens,style,ends,regimes,borrowed,stand_in";

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
      // Functions may be used before they are defined.
      "no-use-before-define": ["error", { functions: false, classes: false, variables: false }],
      "no-var": "error",
      "prefer-const": "error",
    },
  },
  // Function bodies, whose parameters are named by Bokeh.
  {
    files: ["app/call.js"],
    languageOptions: {
      sourceType: "commonjs",
      globals: Object.fromEntries(["run", "given", "cb_obj"].map((name) => [name, "readonly"])),
    },
  },
  {
    files: ["app/ticks.js"],
    languageOptions: {
      sourceType: "commonjs",
      globals: Object.fromEntries(["basic", "ticks", "index", "point"].map((name) => [name, "readonly"])),
    },
  },
  { files: ["app/*.js", "app/{page,server,share}/*.js"], languageOptions: { sourceType: "commonjs" } }, // they are inlined in a page
  { files: ["app/frontend/src/**/*.js"], plugins: { ours: { rules: { typed } } }, rules: { "ours/typed": "error" } },
  ...FOLDERS.slice(0, -1).map((folder, i) => importsOnly(FOLDERS.slice(i + 1), [`app/frontend/src/${folder}/*.js`])),
  importsOnly(FOLDERS, [`app/frontend/src/{${BASE}}.js`]),
  { files: ["tests/frontend/*.js"], languageOptions: { globals: globals.node } },
];

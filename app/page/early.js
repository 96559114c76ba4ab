// The language of the page, and the Lab of the arrival, before any script of Bokeh's: first.py says what with, and why.
const { language, bundle, numbers, searches } = JSON.parse(document.getElementById("early")?.textContent ?? "");
document.documentElement.lang = language;

// Bokeh's scripts come after it. What the page asks of Bokeh until then is kept.
const PATIENCE = 4000; // ms
/** @type {any} */
const here = window;
/** @type {(() => void)[]} */
const asked = [];
const standIn = (here.Bokeh = { safely: (what) => asked.push(what) });
// Panel has es-module-shims fetch the bundle when the first of its components comes, read through it and run a copy. The
// browser has it by then, so its hook `fetch` gives out the one that runs.
const ours = new URL(bundle, document.baseURI).href;
here.tippeBundle = () => import(ours);
here.esmsInitOptions = {
  fetch: async (address, ...more) =>
    address === ours
      ? new Response("export default (await tippeBundle()).default", { headers: { "Content-Type": "text/javascript" } })
      : fetch(address, ...more),
};
const parsed = new Promise((resolve) => addEventListener("DOMContentLoaded", resolve));

/** @param {HTMLScriptElement} script */
function insert(script) {
  const again = document.createElement("script");
  for (const { name, value } of script.attributes) again.setAttribute(name, value);
  again.text = script.text;
  again.async = false; // in the order of the page
  document.body.append(again);
  again.onerror = () => dispatchEvent(new Event("tippe:missing")); // waiting.js says so
  return again.src && new Promise((resolve) => ["load", "error"].forEach((name) => again.addEventListener(name, resolve)));
}

let isTime = false;
async function later() {
  if (isTime) return;
  isTime = true;
  await parsed;
  const { content } = /** @type {HTMLTemplateElement} */ (document.getElementById("later"));
  /** @type {any[]} */
  const coming = [];
  for (const script of content.querySelectorAll("script")) {
    if (!script.src) await Promise.all(coming);
    coming.push(insert(script));
  }
  if (here.Bokeh === standIn) return void delete here.Bokeh; // did not come
  for (const what of asked) here.Bokeh.safely(what);
  setTimeout(() => here.tippeBundle().catch(console.error)); // while the server makes the session
}

const spoken = searches[location.search]; // of an address that asks for nothing else but a language
if (spoken === undefined) later();
else {
  const file = fetch(numbers);
  here.tippeBundle().then((module) => module.default.first(file, spoken)).catch(console.error).finally(later);
  setTimeout(later, PATIENCE);
}

// The language of the page, and the Lab of the arrival, before any script of Bokeh's: first.py says what with, and why.
const { language, bundles: [bundle], numbers, searches } = JSON.parse(document.getElementById("early")?.textContent ?? "");
document.documentElement.lang = language;
const spoken = searches[location.search]; // of an address that asks for nothing else but a language
if (spoken !== undefined) {
  const file = fetch(numbers);
  import(new URL(bundle, document.baseURI).href).then((ours) => ours.default.first(file, spoken)).catch(console.error);
}

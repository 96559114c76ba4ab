// Puts the bundle and what Python computed, which both stand in the letter, to work.
const { bundle: source, models } = JSON.parse(document.getElementById("data")?.textContent ?? "");
const address = URL.createObjectURL(new Blob([source], { type: "text/javascript" }));
import(address).then((ours) => ours.default.letter(models)).catch(console.error);

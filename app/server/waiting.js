// While a page waits for its turn: what it says, and when it asks anew.
const words = /** @type {HTMLElement} */ (document.getElementById("waiting"));
const say = (text) => {
  words.textContent = text;
  words.style.display = "block";
};
const isHere = () => typeof Bokeh !== "undefined" && Bokeh.documents?.length > 0;
setTimeout(() => isHere() || say(words.dataset.made), 3000);
addEventListener("unhandledrejection", () => {
  if (isHere()) return;
  say(words.dataset.busy);
  setTimeout(() => location.reload(), 5000 + 5000 * Math.random());
});
const look = setInterval(() => {
  if (!isHere()) return;
  words.remove();
  clearInterval(look);
}, 200);

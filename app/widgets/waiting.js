// Until the page is there: what it says, and when it asks anew. Bokeh's scripts come after this one, and say nothing to anybody
// when their socket is refused; so each socket's end is heard here, in the same way whatever the version of Bokeh.
const place = /** @type {HTMLElement} */ (document.getElementById("waiting"));
const words = JSON.parse(place.dataset.words ?? "{}");
const TRIES = "tippe:tries", SOON = 3000, FIRST = 5000, MOST = 40_000; // ms
const GOING = 1001; // as an ending server says to all
let asks = false, again = false; // a socket was opened; the page will be loaded anew

const isHere = () => typeof Bokeh !== "undefined" && Bokeh.documents?.length > 0;
// How often it was tried in vain; 0 where a frame may store nothing.
function tries(next) {
  try {
    if (next !== undefined) sessionStorage.setItem(TRIES, String(next));
    return Number(sessionStorage.getItem(TRIES)) || 0;
  } catch {
    return 0;
  }
}
function say(...what) {
  place.replaceChildren(...what);
  place.style.display = "block";
}
// why: the name of a reason, which the server's words begin with
function recover(why) {
  if (isHere() || again) return;
  again = true;
  if (window.origin === "null") return say(words.boxed); // no further try would be better
  const now = document.createElement("button"), count = tries();
  now.textContent = words.now;
  now.style.cssText = "font:inherit;margin-left:12px";
  now.onclick = () => location.reload();
  say(`${words[why] ?? words.lost} ${words.again}`, now);
  tries(count + 1);
  setTimeout(() => location.reload(), Math.min(FIRST * 2 ** count, MOST) * (1 + Math.random()));
}
// What a page sends is answered. A server that hangs, or a line that was cut without a word, closes no socket: only the answer
// is missing. Heard by notices.js.
const SLOW = 5000, LOST = 30_000, LOOK = 500; // ms
/** @param {WebSocket} socket */
function listen(socket) {
  const { send } = socket;
  let since = 0, told = "";
  socket.send = (data) => {
    since ||= performance.now();
    send.call(socket, data);
  };
  socket.addEventListener("message", () => { since = 0; });
  const timer = setInterval(() => {
    const waits = since && isHere() ? performance.now() - since : 0, now = waits > LOST ? "lost" : waits > SLOW ? "slow" : "";
    if (now === told) return;
    told = now;
    window.dispatchEvent(new CustomEvent("tippe:answer", { detail: now }));
  }, LOOK);
  socket.addEventListener("close", () => clearInterval(timer));
}
const { WebSocket: Plain } = window;
window.WebSocket = new Proxy(Plain, {
  construct(kind, given) {
    const socket = Reflect.construct(kind, given);
    asks = true;
    listen(socket);
    socket.addEventListener("close", ({ code, reason }) => recover(code === GOING ? "stopping" : reason.split(":")[0]));
    return socket;
  },
});
addEventListener("tippe:missing", () => recover("lost"));
setTimeout(() => isHere() || again || say(asks ? words.made : words.coming), SOON);
const look = setInterval(() => {
  if (asks && !again && !isHere() && place.textContent === words.coming) say(words.made);
  if (!isHere()) return;
  tries(0);
  place.remove();
  window.WebSocket = Plain;
  clearInterval(look);
}, 200);

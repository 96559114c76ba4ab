// What the page says and does while it is not there: app/widgets/waiting.js, in a browser of a few lines.
import assert from "node:assert/strict";
import { readFileSync } from "node:fs";
import { test } from "node:test";
import { createContext, runInContext } from "node:vm";

const SCRIPT = readFileSync(new URL("../../app/widgets/waiting.js", import.meta.url), "utf-8");
const NAMES = ["coming", "made", "again", "now", "full", "crowded", "stopping", "ended", "failed", "lost"];
const words = Object.fromEntries(NAMES.map((name) => [name, `<${name}>`]));

class Socket extends EventTarget {
  sent = [];
  send(data) {
    this.sent.push(data);
  }
  end(code, reason) {
    this.dispatchEvent(Object.assign(new Event("close"), { code, reason }));
  }
}

/** A page that has just loaded; stored: its sessionStorage, which outlives it. */
function page(stored = new Map()) {
  const timers = [], heard = {}, place = { dataset: { words: JSON.stringify(words) }, style: {}, shown: [], remove() { this.gone = true; },
    replaceChildren(...parts) { this.shown = parts; }, get textContent() { return this.shown.filter((part) => typeof part === "string").join(""); } };
  const answers = [], window = { WebSocket: Socket, dispatchEvent: ({ detail }) => answers.push(detail) }, loads = [], clock = { now: 1000 };
  const here = createContext({ window, URL, Proxy, Reflect, Math, JSON, Number, String, CustomEvent,
    performance: { now: () => clock.now },
    document: { getElementById: () => place, createElement: () => ({ style: {} }) },
    sessionStorage: { setItem: (name, value) => stored.set(name, value), getItem: (name) => stored.get(name) ?? null },
    location: { reload: () => loads.push(true) }, addEventListener: (name, act) => { heard[name] = act; },
    setTimeout: (act, wait) => timers.push({ act, wait }), setInterval: (act, every) => { heard[every === 200 ? "look" : "listen"] = act; }, clearInterval() {} });
  runInContext(`{${SCRIPT}}`, here);
  return { here, timers, heard, clock, answers, place, loads, opens: () => new window.WebSocket("ws://here", ["bokeh", "token"]), window };
}

for (const [code, reason, says] of [[4000, "full: The server is full.", "full"], [4000, "crowded: Too many.", "crowded"],
  [4000, "ended: Too old.", "ended"], [4000, "failed: No.", "failed"], [1001, "Another takes over.", "stopping"],
  [4000, "stopping: Another takes over.", "stopping"], [1006, "", "lost"], [1000, "Token is expired", "lost"]]) {
  test(`a page refused with ${code} ${reason || "and no word"} says why, and loads anew`, () => {
    const { opens, place, timers, loads } = page(), [soon] = timers.splice(0);
    const socket = opens();
    assert.ok(socket instanceof Socket);
    socket.end(code, reason);
    soon.act(); // what is said does not take its place
    assert.equal(place.textContent, `<${says}> <again>`);
    const [again] = timers;
    assert.ok(again.wait >= 5000 && again.wait <= 10_000);
    assert.equal(loads.length, 0);
    again.act();
    place.shown[1].onclick(); // "Try now"
    assert.equal(loads.length, 2);
    socket.end(code, reason);
    assert.equal(timers.length, 1);
  });
}

test("each time in vain it waits longer, up to a bound, and at first again once it was there", () => {
  const stored = new Map(), waits = [];
  for (let count = 0; count < 6; count++) {
    const { opens, timers } = page(stored);
    opens().end(4000, "full: .");
    waits.push(timers[1].wait);
  }
  [5000, 10_000, 20_000, 40_000, 40_000, 40_000].forEach((least, i) => assert.ok(waits[i] >= least && waits[i] <= 2 * least));
  const { here, heard, place, opens, timers, window } = page(stored);
  here.Bokeh = { documents: [{}] };
  heard.look();
  assert.ok(place.gone && window.WebSocket === Socket);
  opens().end(1006, ""); // of the page that is there: widgets/notices.js
  assert.equal(timers.length, 1);
  const next = page(stored);
  next.opens().end(4000, "full: .");
  assert.ok(next.timers[1].wait <= 10_000);
});

test("until its scripts are there it says that it is on its way, and then that it is being prepared", () => {
  const { opens, place, timers, heard } = page();
  timers[0].act();
  assert.equal(place.textContent, "<coming>");
  opens();
  heard.look();
  assert.equal(place.textContent, "<made>");
});

test("a script that does not come is like a lost connection", () => {
  const { heard, place, timers } = page();
  heard["tippe:missing"]();
  assert.equal(place.textContent, "<lost> <again>");
  assert.equal(timers.length, 2);
});

test("a server that does not answer is said after 5 s and lost after 30, and one that answers again is not", () => {
  const { here, heard, clock, answers, opens } = page(), socket = opens();
  const later = (ms) => {
    clock.now += ms;
    heard.listen();
  };
  socket.send("hello");
  later(60_000); // its page is still being made
  here.Bokeh = { documents: [{}] };
  socket.dispatchEvent(new Event("message"));
  later(60_000); // nothing was asked
  assert.deepEqual(answers, []);
  socket.send("first");
  later(4000);
  socket.send("second");
  later(2000);
  assert.deepEqual(answers, ["slow"]);
  socket.dispatchEvent(new Event("message"));
  later(0);
  assert.deepEqual(answers, ["slow", ""]);
  socket.send("third");
  later(6000);
  later(25_000);
  assert.deepEqual(answers, ["slow", "", "slow", "lost"]);
  assert.deepEqual(socket.sent, ["hello", "first", "second", "third"]);
});

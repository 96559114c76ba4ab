// The number control: a slider, a field for a number, and below them an error message, marks and remarks, or how runs end.
import { fill, tidy } from "../data.js";
import { entry } from "./entry.js";
import { explain } from "./wrong.js";
import { fontSize, part, read, say, written } from "../parts.js";

const THUMB = 10; // px from the end of a slider's track to the centre of its thumb there
const WIDTH = 340, NARROW = 260, WIDE = 5.6, APART = 16; // px: least width of the strip of ends and of a track with marks, a letter below it, a gap between words
const TYPE = 14; // px: the font size with such letters
const NEXT = 6; // px between words if one of them is at a mark

// A value between named marks, in words.
/** @param {number} value @param {[value: number, word: string][]} marks @param {Record<string, any>} texts */
export function between(value, marks, texts) {
  const passed = Math.max(marks.filter(([at]) => at <= value).length, 1), [from, to] = [marks[passed - 1], marks[passed]];
  if (value === from[0]) return from[1];
  if (!to) return fill(texts.beyond, { mark: from[1] });
  return fill(texts.between, { percent: Math.round((100 * (value - from[0])) / (to[0] - from[0])), from: from[1], to: to[1] });
}

// Of the words at marks on a track, the first one at its left end: whether each is clear of those before it.
/** @param {[share: number, word: string][]} places */
export function clear(places) {
  let end = -Infinity; // px, of the last word that is clear
  return places.map(([share, { length }], i) => {
    const half = (WIDE * length) / 2, middle = i ? share * NARROW : half, isClear = middle - half > end + NEXT;
    if (isClear) end = middle + half;
    return isClear;
  });
}

export class Control {
  /**
   * @param {string} name
   * @param {Wording} wording
   * @param {Record<string, any>} texts
   * @param {(name: string, value: any, typed?: boolean) => void} ask
   */
  constructor(name, wording, texts, ask) {
    this.name = name;
    this.texts = texts;
    this.wording = wording;
    this.ask = ask;
    /** @type {{ low: number, high: number, digits: number | null }} */
    this.limits = { low: 0, high: 1, digits: 0 };
    /** @type {[value: number, word: string][]} */
    this.marks = [];
    this.text = ""; // of the field, as last written
    this.isApart = false; // whether the field has another number than the slider, for example E and not its share
    this.was = /** @type {HTMLElement[]} */ ([]); // what marks the earlier run
    this.share = this.value = 0; // fraction of the track at the present value; the value last shown while the button is held
    const id = `lab-${name}`;
    this.slider = part("input", { type: "range", id, "aria-label": wording.name, oninput: () => {
      this.put(Number(this.slider.value));
      ask(name, Number(this.slider.value));
    } });
    this.number = entry({ "aria-label": wording.typed, "aria-describedby": `${id}-wrong` }, (typed) => this.send(typed), () => this.write(this.text));
    this.wrong = part("p", { class: "wrong", id: `${id}-wrong`, role: "alert", hidden: true });
    this.below = part("div", { class: "below" });
    this.remark = part("p", { class: "small", role: "status" });
    const label = part("label", { for: id, title: wording.hint }, wording.name);
    if (wording.html) label.innerHTML = wording.html;
    this.element = part("div", { class: "ctl" }, label,
      part("span", {}, this.number, part("span", { class: "unit" }, wording.unit)), this.slider, this.below, this.remark, this.wrong);
  }

  // Requests what was typed.
  /** @param {string} typed */
  send(typed) {
    const value = read(typed);
    this.ask(this.name, Number.isFinite(value) ? value : typed, true);
    if (!Number.isFinite(value) || this.isApart) return;
    this.slider.value = String(value);
    this.put(value);
  }

  /** @param {number} value @param {string} [text] what was typed, where that cannot be */
  put(value, text) {
    const { low, high } = this.limits, share = (value - low) / (high - low);
    this.slider.style.setProperty("--p", `${(100 * Math.min(Math.max(share, 0), 1)).toFixed(2)}%`);
    if (text !== undefined || !this.isApart) this.write(text ?? this.print(value));
    this.slider.setAttribute("aria-valuetext", this.speak(value));
    this.share = share;
    this.point();
  }

  // As its field has it: with its decimals, or else six digits.
  /** @param {number} value */
  print(value) {
    const { digits } = this.limits;
    return digits === null ? tidy(value, 6) : written(value, digits, this.texts.decimal);
  }

  /** @param {number} value */
  speak(value) {
    return this.marks.length ? between(value, this.marks, this.texts) : `${this.print(value)} ${this.wording.speaks ?? this.wording.unit}`;
  }

  // Never overwrites what a person is typing. Selected text stays selected, otherwise typing would append to it.
  /** @param {string} text */
  write(text) {
    const { number } = this, { value, selectionStart, selectionEnd } = number;
    if (number.isTyping) return;
    this.text = text;
    if (value === text) return;
    number.value = text;
    if (value && !selectionStart && selectionEnd === value.length && number.matches(":focus")) number.select();
  }

  // The mark of the present value; a value beyond the track has none.
  point() {
    const { low, high } = this.limits;
    const places = this.marks.map(([at, word]) => /** @type {[number, string]} */ ([(at - low) / (high - low), word])), isClear = clear(places);
    for (const [i, [share]] of places.entries()) {
      const tick = /** @type {HTMLElement} */ (this.ticks.children[i]);
      tick.style.left = this.along(share);
      tick.classList.toggle("crowded", !isClear[i]);
    }
    if (!this.mark) return;
    this.mark.hidden = this.share < 0 || this.share > 1;
    this.mark.style.left = this.along(this.share);
  }

  /** @param {number} share of the track */
  along = (share) => `calc(${THUMB}px + ${share} * (100% - ${2 * THUMB}px))`;

  /** @param {any} state @param {boolean} ahead whether it has been moved since */
  show(state, ahead) {
    const [least, most, step, digits] = state.sliders[this.name], message = state.messages[this.name], own = state.fields?.[this.name];
    this.isApart = own !== undefined;
    // A track that reached beyond its ends, to a value there, is not shortened under a hand.
    const isHeld = this.slider.matches(":active"), low = isHeld ? Math.min(least, this.limits.low) : least, high = isHeld ? Math.max(most, this.limits.high) : most;
    this.limits = { low, high, digits };
    Object.assign(this.slider, { min: low, max: high, step });
    const [refused, kept] = [state.refused[this.name], state.values[this.name]];
    if (!ahead) {
      this.slider.value = String(kept);
      this.put(kept, message && refused !== undefined ? this.typed(refused) : this.print(own ?? kept));
    }
    this.number.setAttribute("aria-invalid", String(Boolean(message)));
    this.element.classList.toggle("bad", Boolean(message));
    this.remark.textContent = state.remarks?.[this.name] ?? "";
    this.remark.hidden = !this.remark.textContent;
    explain(this.wrong, message, message ? this.ways(state.nearest[this.name], kept, own) : [], Boolean(this.wording.html));
  }

  // The ways out of an error.
  /** @param {number | undefined} nearest the nearest allowed value @param {number} kept the last valid one @param {number} [own] that of the field @returns {[string, () => void][]} */
  ways(nearest, kept, own = kept) {
    const unit = `${this.wording.unit && this.wording.unit !== "°" ? " " : ""}${this.wording.unit}`;
    const says = (text, value) => say(this.texts, text, { value: `${value}${unit}` });
    /** @type {[string, () => void]} */
    const back = [says(this.texts.back, this.print(own)), () => this.ask(this.name, kept)];
    return nearest === undefined ? [back] : [[says(this.texts.take, this.typed(nearest)), () => this.ask(this.name, nearest, true)], back];
  }

  // A remark on the value, plain text unless its name is HTML.
  /** @param {string} [wording] */
  note(wording) {
    if (wording === this.noted) return;
    this.noted = wording;
    const words = part("p", { class: "small" }, wording ?? "");
    if (this.wording.html) words.innerHTML = wording;
    this.below.replaceChildren(...(wording || this.wording.html ? [words] : []));
  }

  // Like the text that was typed.
  typed(value) {
    if (typeof value !== "number") return String(value);
    return Number.isInteger(value) ? written(value, 0, this.texts.decimal) : this.print(value);
  }

  // Names places on the track.
  /** @param {[value: number, word: string][]} marks */
  tick(marks) {
    this.marks = marks;
    this.ticks = part("div", { class: "ticks", "aria-hidden": "true" }, ...marks.map(([, word]) => part("span", {}, word)));
    this.below.before(this.ticks);
  }

  // Sets the value at a fraction of the track, rounded to its digits, and returns it.
  /** @param {number} share */
  putShare(share) {
    const { low, high, digits } = this.limits;
    this.value = Number((low + share * (high - low)).toFixed(digits ?? 0));
    this.slider.value = String(this.value);
    this.put(this.value);
    return this.value;
  }

  // Marks the value of the earlier run on the strip below the track.
  /** @param {number | undefined} value */
  showWas(value) {
    const { low, high } = this.limits, [bar, line] = this.below.children;
    for (const old of this.was) old.remove();
    this.was = [];
    if (value === undefined || !bar || value < low || value > high) return;
    const wording = say(this.texts, this.texts.was, { value: [value, value % 1 ? 1 : 0] }), style = `left: ${this.along((value - low) / (high - low))}`;
    this.was = [part("i", { class: "was", title: wording, style }), part("b", { style }, wording)];
    bar.append(this.was[0]);
    line.append(this.was[1]);
    this.fitWas(line, this.was[1]);
  }

  // Its name, where there is room: below the mark, or to the left or right of it.
  /** @param {Element} line @param {HTMLElement} word */
  fitWas(line, word) {
    const others = [...line.children].filter((each) => each !== word).map((each) => each.getBoundingClientRect());
    for (const share of [50, 100, 0]) {
      word.style.transform = `translateX(-${share}%)`;
      const { left, right } = word.getBoundingClientRect();
      if (others.every((other) => right + NEXT < other.left || other.right + NEXT < left)) return;
    }
    word.remove();
  }

  // Below the track: how the run ends for each spin.
  /** @param {[from: number, to: number, code: string, word: string][] | null} ends */
  showEnds(ends) {
    const { low, high } = this.limits, key = JSON.stringify([ends, low, high]);
    if (key === this.ends) return;
    this.ends = key;
    const at = (value) => this.along((value - low) / (high - low));
    const bar = part("div", { class: "ends", role: "img", "aria-label": this.texts.ends });
    this.mark = part("i", { class: "mark" });
    if (!ends?.length) {
      this.below.replaceChildren(bar, part("div", { class: "words" }, part("span", {}, this.texts.ends_wait)));
      bar.classList.add("none");
      return;
    }
    bar.setAttribute("aria-label", `${this.texts.ends}: ${ends.map(([from, to, , word]) => `${this.digits(from)}–${this.digits(to)} ${word}`).join("; ")}`);
    bar.append(...ends.map(([from, to, code, word]) => part("span", {
      class: `end ${code}`, title: `${this.digits(from)}–${this.digits(to)} ${this.wording.unit}: ${word}`,
      style: `left: ${at(from)}; right: calc(100% - ${at(to)})`,
    })), this.mark);
    this.below.replaceChildren(bar, this.words(ends));
    this.point();
  }

  digits = (value) => written(value, value % 1 ? 1 : 0, this.texts.decimal);

  // The words of its two largest parts, left and right, and where the right one begins.
  words(ends) {
    const { low, high } = this.limits, size = ([from, to]) => to - from;
    const [large, next] = [...ends].sort((a, b) => size(b) - size(a)), first = (ends[0][0] - low) / (high - low);
    const line = part("div", { class: "words", style: `padding-left: ${this.along(first)}` }); // below the strip, which may begin later than the track
    if (!next || next[3] === large[3]) line.append(part("span", {}, large[3]));
    else {
      const [left, right] = large[0] < next[0] ? [large, next] : [next, large];
      const [from, at] = [left, right].map(([start]) => (start - low) / (high - low));
      const wide = (WIDE * Math.max(TYPE, fontSize(this.element) || 0)) / TYPE;
      const letters = wide * (left[3].length + right[3].length), room = (at - from) * WIDTH > wide * left[3].length + APART;
      if (room || letters + APART < (1 - first) * WIDTH) line.append(part("span", {}, left[3]));
      if (room) Object.assign(line.children[0].style, { position: "absolute", left: this.along(from) }); // below its own part
      if ((room || at * WIDTH > wide * left[3].length + APART) && (1 - at) * WIDTH > wide * right[3].length + APART && letters < WIDTH) {
        line.append(part("b", { style: `left: ${this.along(at)}` }, this.digits(right[0])));
      }
      line.append(part("span", { style: "margin-left: auto" }, right[3]));
    }
    return line;
  }
}

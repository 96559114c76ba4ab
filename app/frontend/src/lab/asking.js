// What a hand asks for, one wish at a time under way; of those that wait only the newest for each input.
const LATE = 2000; // ms: an answer that has not come by then is not waited for

export class Asking {
  /** @param {(count: number, name: string, value: any) => void} send */
  constructor(send) {
    this.send = send;
    this.count = 0;
    this.answered = 0;
    this.sentAt = -Infinity;
    this.waiting = new Map();
    this.held = false;
  }

  // While there is nobody who answers.
  /** @param {boolean} held */
  hold(held) {
    this.held = held;
    this.next();
  }

  /** @param {string} name @param {any} value */
  ask(name, value) {
    this.waiting.delete(name);
    this.waiting.set(name, value);
    this.next();
  }

  /** @param {number} answered the last count that came back */
  hear(answered) {
    this.answered = Math.max(answered, this.answered);
    this.next();
  }

  next() {
    clearTimeout(this.later);
    if (this.held || !this.waiting.size) return;
    const left = LATE - (performance.now() - this.sentAt);
    if (this.answered < this.count && left > 0) {
      this.later = setTimeout(() => this.next(), left);
      return;
    }
    const [[name, value]] = this.waiting;
    this.waiting.delete(name);
    this.count += 1;
    this.sentAt = performance.now();
    this.send(this.count, name, value);
  }

  // Whether a hand is ahead of what is shown.
  get isAhead() {
    return this.waiting.size > 0 || this.answered < this.count;
  }
}

// Sends requests to Python, one at a time. Of those that wait, only the newest for each input is kept.
const LATE = 2000; // ms to wait for an answer before the next request is sent anyway

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

  // Holds requests back while there is no session to answer them.
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

  /** @param {number} answered the number of the last request that was answered */
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

  // Whether a request has not been answered yet.
  get isAhead() { return this.waiting.size > 0 || this.answered < this.count; }
}

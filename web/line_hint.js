import { LimitedBy } from './protocol.js';

/** A line that falls short for a moment is not worth a word; nor is one that recovers for a moment. Milliseconds. */
const kUntilSaid = 2000;
const kUntilGone = 3000;

/** A few words at the edge of the picture while the visitor's line keeps the stream from being better. */
export class LineHint {
  #element;
  #clock;
  #slow = false;
  #timer;
  #words = '';

  /** `clock` is as `window`. */
  constructor(element, clock) {
    this.#element = element;
    this.#clock = clock;
  }

  /** `status` as in the message Status; `lines`: how high the pictures are that the visitor sees. */
  update({ limitedBy, framesPerSecond }, lines) {
    const slow = limitedBy === LimitedBy.line;
    if (slow) this.#words = `Slow line: ${lines} lines, ${framesPerSecond} frames/s`;
    if (slow && !this.#element.hidden) this.#write();
    if (slow === this.#slow) return;
    this.#slow = slow;
    this.#clock.clearTimeout(this.#timer);
    this.#timer = this.#clock.setTimeout(() => this.#settle(), slow ? kUntilSaid : kUntilGone);
  }

  /** Nothing is known of the line any more. */
  reset() {
    this.#clock.clearTimeout(this.#timer);
    this.#slow = false;
    this.#element.hidden = true;
  }

  #settle() {
    if (this.#slow) this.#write();
    this.#element.hidden = !this.#slow;
  }

  /** What stays the same is left alone, or it would be read out again. */
  #write() {
    if (this.#element.textContent !== this.#words) this.#element.textContent = this.#words;
  }
}

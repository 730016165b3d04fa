import { LimitedBy } from '../stream/protocol.js';
import { kHints } from '../texts.js';

/** The hint skips brief shortages and brief recoveries. Milliseconds. */
const kUntilSaid = 2000;
const kUntilGone = 3000;

/** The start of the hint, by bottleneck; limits by choice need no hint. */
const kShort = {
  [LimitedBy.line]: kHints.line,
  [LimitedBy.browser]: kHints.browser,
  [LimitedBy.machine]: kHints.machine,
};

/** A hint at the edge of the picture while line, browser or server limits the stream. */
export class LimitHint {
  #element;
  #clock;
  #isShort = false;
  #timer;
  #words = '';

  /** `clock` has the timers of `window`. */
  constructor(element, clock) {
    this.#element = element;
    this.#clock = clock;
  }

  /** `status` as in the message Status; `lines`: the height of the visible pictures. */
  update({ limitedBy, framesPerSecond }, lines) {
    const isShort = limitedBy in kShort;
    if (isShort) this.#words = kHints.limited(kShort[limitedBy], lines, framesPerSecond);
    if (isShort && !this.#element.hidden) this.#write();
    if (isShort === this.#isShort) return;
    this.#isShort = isShort;
    this.#clock.clearTimeout(this.#timer);
    this.#timer = this.#clock.setTimeout(() => this.#settle(), isShort ? kUntilSaid : kUntilGone);
  }

  /** For the end of a connection. */
  reset() {
    this.#clock.clearTimeout(this.#timer);
    this.#isShort = false;
    this.#element.hidden = true;
  }

  #settle() {
    if (this.#isShort) this.#write();
    this.#element.hidden = !this.#isShort;
  }

  /** Writes only a changed text, because screen readers read out each write. */
  #write() {
    if (this.#element.textContent !== this.#words) this.#element.textContent = this.#words;
  }
}

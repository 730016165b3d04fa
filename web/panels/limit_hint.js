import { LimitedBy } from '../stream/protocol.js';
import { kHints } from '../texts.js';

/** What falls short for a moment is not worth a word; nor is what recovers for a moment. Milliseconds. */
const kUntilSaid = 2000;
const kUntilGone = 3000;

/** Who is short, as the hint begins; limits by choice need no words. */
const kShort = {
  [LimitedBy.line]: kHints.line,
  [LimitedBy.browser]: kHints.browser,
  [LimitedBy.machine]: kHints.machine,
};

/** A few words at the edge of the picture while line, browser or server keep the stream from being better. */
export class LimitHint {
  #element;
  #clock;
  #isShort = false;
  #timer;
  #words = '';

  /** `clock` is as `window`. */
  constructor(element, clock) {
    this.#element = element;
    this.#clock = clock;
  }

  /** `status` as in the message Status; `lines`: how high the pictures are that the visitor sees. */
  update({ limitedBy, framesPerSecond }, lines) {
    const isShort = limitedBy in kShort;
    if (isShort) this.#words = kHints.limited(kShort[limitedBy], lines, framesPerSecond);
    if (isShort && !this.#element.hidden) this.#write();
    if (isShort === this.#isShort) return;
    this.#isShort = isShort;
    this.#clock.clearTimeout(this.#timer);
    this.#timer = this.#clock.setTimeout(() => this.#settle(), isShort ? kUntilSaid : kUntilGone);
  }

  /** Nothing is known of the stream any more. */
  reset() {
    this.#clock.clearTimeout(this.#timer);
    this.#isShort = false;
    this.#element.hidden = true;
  }

  #settle() {
    if (this.#isShort) this.#write();
    this.#element.hidden = !this.#isShort;
  }

  /** What stays the same is left alone, or it would be read out again. */
  #write() {
    if (this.#element.textContent !== this.#words) this.#element.textContent = this.#words;
  }
}

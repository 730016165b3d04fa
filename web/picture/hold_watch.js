/** A decoder out of which nothing comes for so long (ms), though nothing else goes in, is keeping it back. */
const kLongestRest = 250;
/** So many rests in a row, without the decoder ever running empty, are no accident. */
const kAccidents = 3;
/** Before the first picture, it may still be made ready. */
const kAccidentsAtFirst = 12;
/** So many pictures in a row that came out only after a newer one had gone in ask for a closer look. */
const kSuspicious = 30;
/** Each look that finds nothing makes the next one so many times rarer: it costs a hitch. */
const kPatienceGrowth = 4;

/**
 * Finds out whether a decoder keeps pictures back until newer ones push them out, as some hardware decoders do whatever
 * they are told. That is not the same as being slow: given nothing more, a slow one ends by handing out all it has.
 */
export class HoldWatch {
  #clock;
  #on;
  #timer;
  #inside = 0;
  #rests = 0;
  #accidents = kAccidentsAtFirst;
  #overtaken = 0;
  #suspicious = kSuspicious;
  #testing = false;

  /**
   * @param {object} parts
   * @param {{setTimeout: Function, clearTimeout: Function}} parts.clock
   * @param {{rest: Function, holds: Function, tested: Function}} parts.on `rest()`: nothing came out for a while;
   *     `holds()`: it keeps pictures back for certain; `tested()`: it does not, and may be fed again
   */
  constructor({ clock, on }) {
    this.#clock = clock;
    this.#on = on;
  }

  /** Whether the decoder must be given nothing for now, so that it shows whether it hands out what it has. */
  get testing() {
    return this.#testing;
  }

  /** A picture went in; `inside` of them have not come out. */
  put(inside) {
    this.#inside = inside;
    this.#rearm();
  }

  /** One came out, and these many are still inside; of them, the decoder has begun `begun`. */
  out(inside, begun) {
    this.#inside = inside;
    this.#accidents = kAccidents;
    this.#overtaken = begun > 0 ? this.#overtaken + 1 : 0;
    if (inside === 0) this.#ranEmpty();
    else if (this.#overtaken >= this.#suspicious) this.#testing = true;
    this.#rearm();
  }

  close() {
    this.#clock.clearTimeout(this.#timer);
  }

  #ranEmpty() {
    this.#rests = 0;
    if (!this.#testing) return;
    this.#testing = false;
    this.#overtaken = 0;
    this.#suspicious *= kPatienceGrowth;
    this.#on.tested();
  }

  #rearm() {
    this.#clock.clearTimeout(this.#timer);
    if (this.#inside > 0) this.#timer = this.#clock.setTimeout(() => this.#rest(), kLongestRest);
  }

  #rest() {
    this.#rests += 1;
    if (this.#testing || this.#rests >= this.#accidents) {
      this.#on.holds();
      return;
    }
    this.#rearm();
    this.#on.rest();
  }
}

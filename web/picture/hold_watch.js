/** A rest: nothing goes in or comes out for this long (ms), though pictures are inside. */
const kLongestRest = 250;
/** This many rests, without the decoder running empty in between, prove that it holds pictures back. */
const kAccidents = 3;
/** More rests before the first picture: the decoder may still be starting. */
const kAccidentsAtFirst = 12;
/** This many pictures in a row that came out only after a newer one went in start a test. */
const kSuspicious = 30;
/** Each test without a finding makes the next this many times rarer, because a test costs a hitch. */
const kPatienceGrowth = 4;

/**
 * Detects whether a decoder holds pictures back until newer ones push them out, as some hardware decoders do whatever
 * their configuration. A slow decoder differs: without more input, it outputs everything in the end.
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
   * @param {{rest: Function, holds: Function, tested: Function}} parts.on `rest()`: no output for a while;
   *     `holds()`: it certainly holds pictures back; `tested()`: it does not, and may get input again
   */
  constructor({ clock, on }) {
    this.#clock = clock;
    this.#on = on;
  }

  /** Whether a test runs: the decoder must get no input, to show whether it outputs all it has. */
  get testing() {
    return this.#testing;
  }

  /** A picture went in; `inside` of them have not come out. */
  put(inside) {
    this.#inside = inside;
    this.#rearm();
  }

  /** One came out; `inside` remain, of which the decoder has begun `begun`. */
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

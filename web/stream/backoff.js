const kFirstDelay = 500;
const kLongestDelay = 5000;
const kSpread = 0.2;

/**
 * Delays between attempts to reach the server, in milliseconds: each twice the one before, up to five seconds. They are
 * spread by a fifth so that many visitors do not return in the same instant.
 */
export class Backoff {
  #random;
  #delay = kFirstDelay;

  constructor(random = Math.random) {
    this.#random = random;
  }

  next() {
    const delay = this.#delay * (1 + kSpread * (this.#random() - 0.5));
    this.#delay = Math.min(2 * this.#delay, kLongestDelay);
    return Math.min(delay, kLongestDelay);
  }

  reset() {
    this.#delay = kFirstDelay;
  }
}

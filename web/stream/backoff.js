const kFirstDelay = 500;
const kLongestDelay = 5000;
const kSpread = 0.2;

/**
 * Delays (ms) between attempts to reach the server: each doubles the one before, up to five seconds. A random spread of
 * a fifth keeps visitors from returning all at the same moment.
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

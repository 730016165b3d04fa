import { amortizationOf } from './amortization.js';
import { known } from './figures.js';

const kInterval = 1000;

/**
 * Share of the uses of shared views by others than the visitor who used them first, in the last seconds: 0..1, `null`
 * without a use.
 */
export function sharedViews(statistics) {
  const { views_made: made, uses_again: again, uses_by_others: others } = statistics?.amortization?.reuse ?? {};
  const counts = [made, again, others].map(known);
  if (counts.includes(null)) return null;
  const all = counts.reduce((sum, count) => sum + count, 0);
  return all > 0 ? counts[2] / all : null;
}

/** The server's version, such as 0.2.0; `null` if the server does not report it. */
export function versionOf(statistics) {
  return typeof statistics?.version === 'string' ? statistics.version : null;
}

/** The server's `/sharing.json`, requested once a second while watched. */
export class WorldStatistics {
  #fetch;
  #timers;
  #timer = null;
  #version = null;
  #shared = null;
  #amortization = null;

  /** `fetch()` promises the statistics. `timers` has the timers of `window`. */
  constructor(fetch, timers) {
    this.#fetch = fetch;
    this.#timers = timers;
  }

  watch(on) {
    this.#timers.clearTimeout(this.#timer);
    this.#timer = null;
    if (on) this.#ask();
  }

  read() {
    return { version: this.#version, sharedViews: this.#shared, amortization: this.#amortization };
  }

  #ask() {
    const timer = this.#timers.setTimeout(() => this.#ask(), kInterval);
    this.#timer = timer;
    this.#fetch().then(
      (statistics) => {
        this.#version = versionOf(statistics);
        this.#shared = sharedViews(statistics);
        this.#amortization = amortizationOf(statistics);
      },
      () => {
        this.#version = null; // the notice reports the lost server
        this.#shared = null;
        this.#amortization = null;
      },
    );
  }
}

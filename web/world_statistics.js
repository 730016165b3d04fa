import { amortizationOf } from './amortization.js';

const kInterval = 1000;

/** Share of light field pictures reused from another visitor's view: 0..1, `null` before the first. */
export function sharedViews(before, now) {
  const grown = (name) => (now.counters?.[name] ?? 0) - (before?.counters?.[name] ?? 0);
  const hits = grown('view cache hits');
  const all = hits + grown('view cache misses') + grown('views too near to share');
  return all > 0 ? hits / all : null;
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
  #last = null;
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
        this.#shared = sharedViews(this.#last, statistics);
        this.#amortization = amortizationOf(statistics);
        this.#last = statistics;
      },
      () => {
        this.#version = null; // the notice reports the lost server
        this.#shared = null;
        this.#amortization = null;
        this.#last = null;
      },
    );
  }
}

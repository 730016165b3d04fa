import { amortizationOf } from './amortization.js';

const kInterval = 1000;

/** Share of the light fields' pictures that one visitor's view had made for another: 0..1, `null` before the first. */
export function sharedViews(before, now) {
  const grown = (name) => (now.counters?.[name] ?? 0) - (before?.counters?.[name] ?? 0);
  const hits = grown('view cache hits');
  const all = hits + grown('view cache misses') + grown('views too near to share');
  return all > 0 ? hits / all : null;
}

/** The server's version, as in 0.2.0; `null` from a server that does not tell. */
export function versionOf(statistics) {
  return typeof statistics?.version === 'string' ? statistics.version : null;
}

/** What the server reports of itself in `/sharing.json`, asked for once a second while somebody looks. */
export class WorldStatistics {
  #fetch;
  #timers;
  #timer = null;
  #last = null;
  #version = null;
  #shared = null;
  #amortization = null;

  /** `fetch()` promises the statistics. `timers` is as `window`. */
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
        this.#version = null; // the server is away: the page says so elsewhere
        this.#shared = null;
        this.#amortization = null;
        this.#last = null;
      },
    );
  }
}

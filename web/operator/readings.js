import { known } from '../figures.js';
import { sharedViews } from '../world_statistics.js';

/** The span of rates: long enough to be steady, short enough to be live. Milliseconds. */
const kSpan = 5000;

const stagesOf = ({ stages }) => Object.entries(stages ?? {}).filter(([, stage]) => known(stage?.runs) !== null);

/** Whether sums since the start have shrunk, because the process was restarted. */
function isRestarted(before, now) {
  const shrank = ([name, stage]) => (now.stages?.[name]?.runs ?? 0) < stage.runs;
  const less = ([name, count]) => (now.counters?.[name] ?? 0) < count;
  return stagesOf(before).some(shrank) || Object.entries(before.counters ?? {}).some(less);
}

/** The newest answers of the server, and their differences. Times in milliseconds. */
export class Readings {
  #entries = [];

  add(time, statistics) {
    if (this.#entries.length > 0 && isRestarted(this.newest, statistics)) this.clear();
    this.#entries.push({ time, statistics });
    while (this.#entries.length > 2 && this.#entries[1].time <= time - kSpan) this.#entries.shift();
  }

  /** To be called after a pause. */
  clear() {
    this.#entries = [];
  }

  get newest() {
    return this.#entries.at(-1)?.statistics ?? null;
  }

  /**
   * The stages, those for everybody first. Rates are `null` before the second reading, costs per run also without a
   * run. `share` is of the CPU of all stages; `failures` count since the start.
   */
  stages() {
    const first = this.#entries[0];
    const last = this.#entries.at(-1);
    if (!last) return [];
    const seconds = (last.time - first.time) / 1000;
    const grown = stagesOf(last.statistics).map(([name, stage]) => {
      const past = first.statistics.stages?.[name];
      return {
        name,
        work: String(stage.work),
        runs: known(stage.runs - (known(past?.runs) ?? 0)) ?? 0,
        cpu: known(stage.cpu_ms - (known(past?.cpu_ms) ?? 0)) ?? 0,
        failures: known(stage.failures),
      };
    });
    const all = grown.reduce((sum, stage) => sum + stage.cpu, 0);
    return grown
      .map(({ name, work, runs, cpu, failures }) => ({
        name,
        work,
        runsPerSecond: seconds > 0 ? runs / seconds : null,
        cpuPerRun: seconds > 0 && runs > 0 ? cpu / runs : null,
        share: seconds > 0 && all > 0 ? cpu / all : null,
        failures,
      }))
      .sort((a, b) => order(a.work) - order(b.work) || a.name.localeCompare(b.name));
  }

  /** The share of uses of shared views by others than who used them first; `null` without a use. */
  cacheHits() {
    return sharedViews(this.newest);
  }
}

const kOrder = ['across-user', 'on-demand', 'per-user-backend', 'per-user-frontend'];
const order = (work) => (kOrder.includes(work) ? kOrder.indexOf(work) : kOrder.length);

import { kOperator } from '../texts.js';
import { memoryOf } from './memory.js';
import { Readings } from './readings.js';

/** Nodes in other processes that report their own work, as `/statistics.json` lists them. */
const reportingNodes = ({ nodes }) => (nodes ?? []).filter(({ stages }) => stages);

/** The newest readings of the server's own process and of each node that reports. Times in milliseconds. */
export class Processes {
  #server = new Readings();
  #nodes = new Map();

  add(time, statistics) {
    this.#server.add(time, statistics);
    const nodes = reportingNodes(statistics);
    for (const name of this.#nodes.keys()) {
      if (!nodes.some((node) => node.name === name)) this.#nodes.delete(name);
    }
    for (const node of nodes) {
      if (!this.#nodes.has(node.name)) this.#nodes.set(node.name, new Readings());
      this.#nodes.get(node.name).add(time, node);
    }
  }

  /** To be called after a pause. */
  clear() {
    this.#server.clear();
    this.#nodes.clear();
  }

  /** Of this server first, then of each node: `{ process, stages }`, see `Readings.stages()`. */
  stages() {
    return this.#all().map(([process, readings]) => ({ process, stages: readings.stages() }));
  }

  /** The same of memory: `{ process, memory }`, see `memoryOf()`. */
  memory() {
    return this.#all().map(([process, { newest }]) => ({ process, memory: memoryOf(newest) }));
  }

  cacheHits() {
    return this.#server.cacheHits();
  }

  #all() {
    return [[kOperator.here, this.#server], ...this.#nodes];
  }
}

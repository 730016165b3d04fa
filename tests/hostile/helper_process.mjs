import { fork } from 'node:child_process';
import { setPriority } from 'node:os';
import { fileURLToPath } from 'node:url';

import { keepTrackOf } from './leftovers.mjs';
import { within } from './time.mjs';

/**
 * A Node process of its own that functions are called in: what it does keeps neither this process nor another helper
 * from reading its sockets in time.
 */
export class HelperProcess {
  #child;
  #calls = new Map();
  #nextCall = 1;

  /** `file` stands beside this one and calls answerCalls(). `niceness` 0 to 19: the higher, the more it gives way. */
  constructor(file, { niceness = 0 } = {}) {
    this.#child = keepTrackOf(fork(fileURLToPath(new URL(file, import.meta.url))));
    if (niceness > 0) setPriority(this.#child.pid, niceness);
    this.#child.on('message', ({ call, result, error }) => {
      const waiting = this.#calls.get(call);
      this.#calls.delete(call);
      if (error === undefined) waiting?.resolve(result);
      else waiting?.reject(new Error(error));
    });
    this.#child.on('exit', (code, signal) => {
      for (const { reject } of this.#calls.values()) reject(new Error(`${file} ended with ${code ?? signal}`));
      this.#calls.clear();
    });
  }

  /** What its function of this name gives; fails after `patience` seconds. */
  call(name, argument, patience) {
    const call = this.#nextCall++;
    const answer = new Promise((resolve, reject) => this.#calls.set(call, { resolve, reject }));
    this.#child.send({ call, name, argument }, (error) => {
      if (error) this.#calls.get(call)?.reject(error);
    });
    return within(patience, name, answer);
  }

  /** Ends it, and with it every socket that it has. */
  end() {
    return new Promise((resolve) => {
      if (this.#child.exitCode !== null || this.#child.signalCode !== null) resolve();
      this.#child.once('exit', resolve);
      this.#child.kill('SIGKILL');
    });
  }
}

/** The other end: answers calls with these functions of one argument. */
export function answerCalls(functions) {
  process.on('disconnect', () => process.exit());
  process.on('message', async ({ call, name, argument }) => {
    const answer = await functions[name](argument).then(
      (result) => ({ call, result }),
      (error) => ({ call, error: String(error?.message ?? error) }),
    );
    if (process.connected) process.send(answer);
  });
}

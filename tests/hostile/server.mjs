import { spawn } from 'node:child_process';
import { createInterface } from 'node:readline';
import { fileURLToPath } from 'node:url';

import { keepTrackOf } from './leftovers.mjs';
import { becomes, now, pause, within } from './time.mjs';

const kRoot = fileURLToPath(new URL('../..', import.meta.url));
const kBinary = process.env.GROVE_BINARY ?? `${kRoot}/build/release/grove`;

/** The first server on a machine bakes the light fields of its world. Seconds. */
const kPreparation = 600;
const kEnd = 10;

/** A `grove serve` that was started, whether it ever listens or not. */
export class Server {
  static #running = new Set();

  /** What it wrote to stdout and stderr, line by line. */
  said = [];
  logged = [];
  /** When it ended: `{ code, signal, seconds }` since its start. Null while it runs. */
  end = null;
  #started = now();
  #ended;

  /** `limits` are options of the shell's ulimit, `-n 24`. */
  constructor({ options = [], environment = {}, limits = null } = {}) {
    const command = [kBinary, 'serve', '--listen', '127.0.0.1:0', ...options];
    const shell = limits ? ['bash', '-c', `ulimit ${limits} && exec "$@"`, 'bash'] : [];
    const [program, ...words] = [...shell, ...command];
    this.process = keepTrackOf(spawn(program, words, { cwd: kRoot, env: { ...process.env, ...environment } }));
    createInterface({ input: this.process.stdout }).on('line', (line) => this.said.push(line));
    createInterface({ input: this.process.stderr }).on('line', (line) => this.logged.push(line));
    Server.#running.add(this);
    this.#ended = new Promise((resolve) => {
      const finish = (code, signal) => {
        this.end = { code, signal, seconds: now() - this.#started };
        Server.#running.delete(this);
        resolve(this.end);
      };
      // 'close' comes when its last line has been read.
      this.process.once('close', finish);
      this.process.once('error', (error) => {
        this.logged.push(error.message);
        finish(null, null);
      });
    });
  }

  /** A server that listens. */
  static async listening(options) {
    const server = new Server(options);
    await becomes(() => server.port !== null || server.end, kPreparation);
    if (server.port === null) throw new Error(`the server did not start:\n${server.logged.join('\n')}`);
    // The line about the operator's page may come after.
    await pause(0.2);
    return server;
  }

  /** Kills all that run but this one. */
  static async killOthers(server) {
    for (const other of Server.#running) if (other !== server) await other.stop('SIGKILL');
  }

  get pid() {
    return this.process.pid;
  }

  /** Where visitors go; null before it listens. */
  get port() {
    return this.#portBehind('listening on ');
  }

  /** Where the operator's reports are: on a port of their own, or on the visitors' port. */
  get operatorPort() {
    return this.#portBehind("operator's page at ") ?? this.port;
  }

  #portBehind(words) {
    const line = this.said.find((said) => said.includes(words));
    return line ? Number(new URL(line.slice(line.indexOf('http'))).port) : null;
  }

  /** When it has ended by itself; null if it has not within so many seconds. */
  async endsWithin(seconds) {
    await Promise.race([this.#ended, pause(seconds)]);
    return this.end;
  }

  /** The seconds from this signal to its end, or null if that took more than `patience`; then it is killed. */
  async stop(signal = 'SIGTERM', patience = kEnd) {
    const asked = now();
    this.process.kill(signal);
    const ended = await this.endsWithin(patience);
    const seconds = now() - asked;
    if (!ended) {
      this.process.kill('SIGKILL');
      await within(kEnd, 'the end of a killed server', this.#ended);
    }
    return ended ? seconds : null;
  }
}

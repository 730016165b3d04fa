/** Min and max time between two inputs, in milliseconds. */
const kShortestInterval = 8;
const kLongestInterval = 1000;

/** Sends the state of all controls: soon after each change, and at least once a second. */
export class InputSender {
  #controls;
  #send;
  #clock;
  #number = 0;
  #running = false;
  #lastSent = -Infinity;
  #timer;
  #due = Infinity;

  /**
   * @param {object} parts
   * @param {import('./controls.js').Controls} parts.controls
   * @param {(input: {number: number, keys: number, yaw: number, pitch: number}, now: number) => void} parts.send
   * @param {{now: Function, setTimeout: Function, clearTimeout: Function}} parts.clock milliseconds
   */
  constructor({ controls, send, clock }) {
    this.#controls = controls;
    this.#send = send;
    this.#clock = clock;
    controls.onChange(() => this.#changed());
  }

  /** For a new connection: numbers count from 1 again, and the current state is sent at once. */
  start() {
    this.#number = 0;
    this.#running = true;
    this.#now();
  }

  stop() {
    this.#running = false;
    this.#clock.clearTimeout(this.#timer);
    this.#due = Infinity;
  }

  /** Sends the unchanged state again. */
  repeat() {
    if (this.#running) this.#now();
  }

  #changed() {
    if (!this.#running) return;
    const due = this.#lastSent + kShortestInterval;
    if (this.#clock.now() >= due) this.#now();
    else this.#at(due);
  }

  #at(due) {
    if (due === this.#due) return;
    this.#clock.clearTimeout(this.#timer);
    this.#due = due;
    this.#timer = this.#clock.setTimeout(() => this.#now(), due - this.#clock.now());
  }

  #now() {
    const { keys, yaw, pitch } = this.#controls;
    this.#number += 1;
    this.#lastSent = this.#clock.now();
    this.#send({ number: this.#number, keys, yaw, pitch }, this.#lastSent);
    this.#at(this.#lastSent + kLongestInterval);
  }
}

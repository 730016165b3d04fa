import { windowOf } from '../picture/look_geometry.js';
import { median, quantile } from '../stream/meters.js';
import { kCodecNames } from '../stream/protocol.js';
import { kLatency } from '../texts.js';

/** While it is measured, the controls' state is sent at least so often (ms), moved or not: more to measure. */
const kInterval = 50;
/** Longer than this (s), the table would only fill the memory. */
const kLongestTest = 600;
const kColumns = 'number,sent_ms,presented_ms,latency_ms,frame,width,height,codec';

/** Records the way of every input to the screen for some seconds, for a table of its own. */
export class LatencyTest {
  #clock;
  #sendInput;
  #onChange;
  #until = -Infinity;
  #rows = [];
  #begin = 0;

  /**
   * @param {object} parts
   * @param {object} parts.clock milliseconds
   * @param {() => void} parts.sendInput sends the controls as they are
   * @param {() => void} parts.onChange it has begun or ended
   */
  constructor({ clock, sendInput, onChange }) {
    this.#clock = clock;
    this.#sendInput = sendInput;
    this.#onChange = onChange;
  }

  get isRunning() {
    return this.#clock.now() < this.#until;
  }

  start(seconds) {
    if (this.isRunning) return;
    this.#rows = [];
    this.#begin = this.#clock.now();
    this.#until = this.#begin + Math.min(seconds, kLongestTest) * 1000;
    this.#onChange();
    this.#ask();
  }

  /**
   * `inputs` as LatencyMeter.presented() returns them, first shown by this picture. Its size in the table is the window's,
   * as in the overlay: how wide a border is says nothing about what a visitor sees.
   */
  presented(inputs, picture, now) {
    if (!this.isRunning) return;
    const { width, height } = windowOf(picture);
    for (const { number, time, latency } of inputs) {
      if (time < this.#begin) continue;
      const times = [time - this.#begin, now - this.#begin, latency].map((value) => value.toFixed(2));
      this.#rows.push({
        latency,
        cells: [number, ...times, picture.frame, width, height, kCodecNames[picture.codec]],
      });
    }
  }

  /** `p50 41, p95 58, p99 60 ms of 380 inputs`; `null` before anything was measured. */
  get words() {
    const values = this.#rows.map(({ latency }) => latency);
    if (values.length === 0) return null;
    const quantiles = [median(values), quantile(values, 0.95), quantile(values, 0.99)];
    return kLatency.result(...quantiles.map((value) => value.toFixed(0)), values.length);
  }

  /** A header and a row for each input, as comma-separated values. */
  get csv() {
    return [kColumns, ...this.#rows.map(({ cells }) => cells.join(','))].join('\n') + '\n';
  }

  #ask() {
    if (!this.isRunning) {
      this.#onChange();
      return;
    }
    this.#sendInput();
    this.#clock.setTimeout(() => this.#ask(), kInterval);
  }
}

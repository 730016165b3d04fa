import { windowOf } from '../picture/look_geometry.js';
import { median, quantile } from '../stream/meters.js';
import { kCodecNames } from '../stream/protocol.js';
import { kLatency } from '../texts.js';

/** During a test, inputs are sent at least this often (ms), changed or not, for more samples. */
const kInterval = 50;
/** Longer than this (s), the table would only fill the memory. */
const kLongestTest = 600;
const kColumns = 'number,sent_ms,presented_ms,latency_ms,frame,width,height,codec,screen_ms';

/**
 * Records the latency of every input for some seconds, in a table: until the server's picture shows the input, and in
 * the last column until the screen does, which late look may bring forward.
 */
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
   * @param {() => void} parts.sendInput sends the current controls
   * @param {() => void} parts.onChange the test has begun or ended
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
    this.#sendRepeatedly();
  }

  /**
   * `inputs` as LatencyMeter.presented() returns them. The size in the table is the window's, as in the overlay,
   * because visitors do not see the border.
   */
  presented(inputs, picture, now) {
    if (!this.isRunning) return;
    const { width, height } = windowOf(picture);
    for (const { number, time, latency, screen } of inputs) {
      if (time < this.#begin) continue;
      const times = [time - this.#begin, now - this.#begin, latency].map((value) => value.toFixed(2));
      this.#rows.push({
        latency,
        cells: [number, ...times, picture.frame, width, height, kCodecNames[picture.codec], screen.toFixed(2)],
      });
    }
  }

  /** `p50 41, p95 58, p99 60 ms of 380 inputs`; `null` without samples. */
  get words() {
    const values = this.#rows.map(({ latency }) => latency);
    if (values.length === 0) return null;
    const quantiles = [median(values), quantile(values, 0.95), quantile(values, 0.99)];
    return kLatency.result(...quantiles.map((value) => value.toFixed(0)), values.length);
  }

  /** Comma-separated values: a header, and a row for each input. */
  get csv() {
    return [kColumns, ...this.#rows.map(({ cells }) => cells.join(','))].join('\n') + '\n';
  }

  #sendRepeatedly() {
    if (!this.isRunning) {
      this.#onChange();
      return;
    }
    this.#sendInput();
    this.#clock.setTimeout(() => this.#sendRepeatedly(), kInterval);
  }
}

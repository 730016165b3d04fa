import { LatencyTest } from './latency_test.js';
import { kLatency } from '../texts.js';

const kSeconds = 10;

/** Starts a latency test by button, key or address, shows its result, and saves its table. */
export class LatencyButton {
  #button;
  #words;
  #link;
  #test;

  /**
   * `panel` has a button, a paragraph and a second button for the table, which `save(file)` gives to the visitor.
   * `clock` and `sendInput` as in LatencyTest.
   */
  constructor(panel, { clock, sendInput, save }) {
    this.#button = panel.querySelector('[data-latency=start]');
    this.#words = panel.querySelector('[data-latency=words]');
    this.#link = panel.querySelector('[data-latency=save]');
    this.#test = new LatencyTest({ clock, sendInput, onChange: () => this.#write() });
    this.#button.addEventListener('click', () => this.start());
    this.#link.addEventListener('click', () => save(new File([this.#test.csv], 'grove-latency.csv', { type: 'text/csv' })));
    this.#write();
  }

  start(seconds = kSeconds) {
    this.#test.start(seconds);
  }

  presented(inputs, picture, now) {
    this.#test.presented(inputs, picture, now);
  }

  #write() {
    const { isRunning, words } = this.#test;
    this.#button.disabled = isRunning;
    this.#button.textContent = isRunning ? kLatency.measuring : kLatency.measure(kSeconds);
    this.#words.textContent = (!isRunning && words) || '';
    this.#words.hidden = this.#link.hidden = isRunning || words === null;
  }
}

import { LatencyTest } from './latency_test.js';

const kSeconds = 10;
const kInvitation = `Measure latency for ${kSeconds} s`;

/** Saves text as a file of the visitor's. */
function save(document, name, text) {
  const link = document.createElement('a');
  link.href = URL.createObjectURL(new Blob([text], { type: 'text/csv' }));
  link.download = name;
  link.click();
  setTimeout(() => URL.revokeObjectURL(link.href), 10_000);
}

/** Starts a latency test by button, key or address, tells how it went, and hands out its table. */
export class LatencyButton {
  #document;
  #button;
  #words;
  #link;
  #test;

  /** `panel` has a button, a paragraph and a second button for the table; `clock` and `sendInput` as LatencyTest. */
  constructor(panel, { clock, sendInput }) {
    this.#document = panel.ownerDocument;
    this.#button = panel.querySelector('[data-latency=start]');
    this.#words = panel.querySelector('[data-latency=words]');
    this.#link = panel.querySelector('[data-latency=save]');
    this.#test = new LatencyTest({ clock, sendInput, onChange: () => this.#write() });
    this.#button.addEventListener('click', () => this.start());
    this.#link.addEventListener('click', () => save(this.#document, 'grove-latency.csv', this.#test.csv));
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
    this.#button.textContent = isRunning ? 'Measuring\u2026' : kInvitation;
    this.#words.textContent = (!isRunning && words) || '';
    this.#words.hidden = this.#link.hidden = isRunning || words === null;
  }
}

/** Long enough to read a line (ms). */
const kShownFor = 4000;

/** A line about the last action, which disappears by itself. `element` is a live region. */
export class Toast {
  #element;
  #timers;
  #timer;

  constructor(element, timers) {
    this.#element = element;
    this.#timers = timers;
  }

  say(text) {
    this.#element.textContent = text;
    this.#timers.clearTimeout(this.#timer);
    this.#timer = this.#timers.setTimeout(() => (this.#element.textContent = ''), kShownFor);
  }
}

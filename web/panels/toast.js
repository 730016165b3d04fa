/** Long enough to read a line (ms). */
const kShownFor = 4000;

/** A line that says what was just done, for eyes and ears, and goes by itself. `element` is a live region. */
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

/** The hint fades after this long (ms) ... */
const kLongestTime = 12_000;
/** ... and this long after the visitor begins to walk. */
const kAfterStart = 2500;

/** The title and a short help for walking, which fade. */
export class Hint {
  #element;
  #timer;
  #begun = false;

  constructor(element, controls) {
    this.#element = element;
    controls.onChange(() => {
      if (controls.keys !== 0) this.#begin();
    });
  }

  show() {
    this.#begun = false;
    this.#element.classList.remove('faded');
    this.#fadeAfter(kLongestTime);
  }

  #begin() {
    if (this.#begun) return;
    this.#begun = true;
    this.#fadeAfter(kAfterStart);
  }

  #fadeAfter(time) {
    clearTimeout(this.#timer);
    this.#timer = setTimeout(() => this.#element.classList.add('faded'), time);
  }
}

/** The hint leaves by itself after this long (ms) ... */
const kLongestTime = 12_000;
/** ... and this soon after the visitor began to walk. */
const kAfterStart = 2500;

/** The title and the few words on how to move; they fade once they are not needed. */
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

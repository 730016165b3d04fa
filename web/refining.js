/** A guess is no more exact than this (s). */
const kRounding = 5;
const kLongestInSeconds = 90;

/** The small line that says that the world gets finer while it is shown; no live region, for it changes each second. */
export class Refining {
  #element;

  constructor(element) {
    this.#element = element;
  }

  /** As in the message Refining. */
  show({ percent, secondsLeft }) {
    this.#element.hidden = percent >= 100;
    this.#element.textContent = `The world is getting finer: ${percent}\u00a0%${left(secondsLeft)}`;
  }

  hide() {
    this.#element.hidden = true;
  }
}

function left(seconds) {
  if (seconds === null) return '';
  if (seconds > kLongestInSeconds) return `, about ${Math.round(seconds / 60)}\u00a0minutes left`;
  return `, about ${Math.max(kRounding, Math.round(seconds / kRounding) * kRounding)}\u00a0s left`;
}

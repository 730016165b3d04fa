import { kHints } from '../texts.js';

/** The precision of the estimate (s). */
const kRounding = 5;
const kLongestInSeconds = 90;

/** A line about the improving detail of the world. No live region, because it changes each second. */
export class Refining {
  #element;

  constructor(element) {
    this.#element = element;
  }

  /** As in the message Refining. */
  show({ percent, secondsLeft }) {
    this.#element.hidden = percent >= 100;
    this.#element.textContent = kHints.refining(percent) + left(secondsLeft);
  }

  hide() {
    this.#element.hidden = true;
  }
}

function left(seconds) {
  if (seconds === null) return '';
  if (seconds > kLongestInSeconds) return kHints.minutesLeft(Math.round(seconds / 60));
  return kHints.secondsLeft(Math.max(kRounding, Math.round(seconds / kRounding) * kRounding));
}

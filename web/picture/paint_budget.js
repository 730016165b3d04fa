import { median } from '../stream/meters.js';

/** Half a frame of a screen of 60 a second: longer paints leave too little time for decoding. Milliseconds. */
const kLongestPaint = 8;
const kPaints = 12;

/** Judges by the last dozen paints whether they take longer than a page can afford; one slow paint is an accident. */
export class PaintBudget {
  #paints = [];

  /** Adds a paint's milliseconds; whether the median of the last dozen is too long. */
  isExceededBy(paint) {
    this.#paints = [...this.#paints, paint].slice(-kPaints);
    return this.#paints.length === kPaints && median(this.#paints) > kLongestPaint;
  }
}

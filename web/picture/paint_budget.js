import { median } from '../stream/meters.js';

/** Half a frame at 60 frames/s: longer paints leave too little time for decoding. Milliseconds. */
const kLongestPaint = 8;
const kPaints = 12;

/** Detects by the last dozen paints whether painting takes too long. A median ignores single slow paints. */
export class PaintBudget {
  #paints = [];

  /** Adds a paint's milliseconds. Returns whether the median of the last dozen is too long. */
  isExceededBy(paint) {
    this.#paints = [...this.#paints, paint].slice(-kPaints);
    return this.#paints.length === kPaints && median(this.#paints) > kLongestPaint;
  }
}

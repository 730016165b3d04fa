/**
 * Shows the newest picture at the next chance to paint. At most one waits; a newer one takes its place, and the
 * acknowledgement of the newer covers the older.
 */
export class Display {
  #paint;
  #schedule;
  #onPresented;
  #waiting = null;
  #scheduled = false;

  /**
   * @param {object} parts
   * @param {(bitmap: ImageBitmap) => void} parts.paint
   * @param {(callback: Function) => void} parts.schedule calls back when the screen can take a picture
   * @param {(frame: object) => void} parts.onPresented
   */
  constructor({ paint, schedule, onPresented }) {
    this.#paint = paint;
    this.#schedule = schedule;
    this.#onPresented = onPresented;
  }

  /** Takes over the bitmap. */
  show(bitmap, frame) {
    this.#waiting?.bitmap.close();
    this.#waiting = { bitmap, frame };
    if (this.#scheduled) return;
    this.#scheduled = true;
    this.#schedule(() => this.#present());
  }

  /** Drops the waiting picture; the one on the screen stays. */
  reset() {
    this.#waiting?.bitmap.close();
    this.#waiting = null;
  }

  #present() {
    this.#scheduled = false;
    if (!this.#waiting) return;
    const { bitmap, frame } = this.#waiting;
    this.#waiting = null;
    try {
      this.#paint(bitmap);
    } finally {
      bitmap.close();
    }
    this.#onPresented(frame);
  }
}

/** A painter onto the canvas, which takes each picture's size; the style sheet fits it into the window. */
export function canvasPainter(canvas) {
  const context = canvas.getContext('2d', { alpha: false });
  return (bitmap) => {
    // Setting the size clears the canvas, so it happens only when it changes and in one go with the drawing: no flash.
    if (canvas.width !== bitmap.width || canvas.height !== bitmap.height) {
      canvas.width = bitmap.width;
      canvas.height = bitmap.height;
    }
    context.drawImage(bitmap, 0, 0);
  };
}

/** Slower than this (ms between paints) and the server would take a hidden page for a dead one. */
const kHiddenInterval = 1000;

/**
 * Schedules paints: with the screen while the page is visible, else once a second, so that a page in the background
 * keeps its place in the world and costs the server almost nothing.
 */
export function paintScheduler(document) {
  return (callback) => {
    let frame;
    let timer;
    const plan = () => {
      cancelAnimationFrame(frame);
      clearTimeout(timer);
      if (document.hidden) timer = setTimeout(run, kHiddenInterval);
      else frame = requestAnimationFrame(run);
    };
    const run = () => {
      document.removeEventListener('visibilitychange', plan);
      callback();
    };
    document.addEventListener('visibilitychange', plan);
    plan();
  };
}

/**
 * Paints the newest picture at the next opportunity. At most one waits; a newer one replaces it, and its
 * acknowledgement covers the older. Between pictures, the one on the screen is turned to the newest look, and moved as
 * long as the visitor walks.
 */
export class Display {
  #screen;
  #schedule;
  #clock;
  #onTurned;
  #onPresented;
  #waiting = null;
  #scheduled = false;

  /**
   * @param {object} parts
   * @param {import('./screen.js').Screen} parts.screen
   * @param {(callback: Function) => void} parts.schedule calls back when the screen can take a picture
   * @param {{now: Function}} parts.clock milliseconds
   * @param {(paint: number) => void} parts.onTurned after painting a turned or moved picture; `paint`: milliseconds
   * @param {(picture: object, paint: number) => void} parts.onPresented after painting a new picture
   */
  constructor({ screen, schedule, clock, onTurned, onPresented }) {
    this.#screen = screen;
    this.#schedule = schedule;
    this.#clock = clock;
    this.#onTurned = onTurned;
    this.#onPresented = onPresented;
  }

  /** Takes ownership of the image. */
  show(image, picture) {
    this.#waiting?.image.close();
    this.#waiting = { image, picture };
    this.#plan();
  }

  /** For a changed look or other controls. */
  turn() {
    if (!this.#scheduled && this.#screen.isBehind) this.#plan();
  }

  /** Drops the waiting picture; the one on the screen stays. */
  reset() {
    this.#waiting?.image.close();
    this.#waiting = null;
    this.#screen.freeze();
  }

  #plan() {
    if (this.#scheduled) return;
    this.#scheduled = true;
    this.#schedule(() => this.#present());
  }

  #present() {
    this.#scheduled = false;
    if (this.#waiting) this.#presentWaiting();
    else this.#paint(() => this.#screen.turn());
    if (this.#screen.isMoving) this.#plan();
  }

  #presentWaiting() {
    const { image, picture } = this.#waiting;
    this.#waiting = null;
    this.#onPresented(picture, this.#paint(() => this.#screen.show(image, picture)));
  }

  /** Returns the milliseconds of painting. */
  #paint(draw) {
    const begin = this.#clock.now();
    draw();
    const paint = this.#clock.now() - begin;
    if (this.#screen.isTurned) this.#onTurned(paint);
    return paint;
  }
}

/** With more time (ms) between paints, older servers would drop a hidden page. */
const kHiddenInterval = 1000;

/**
 * Schedules paints: with the screen while the page is visible, else once a second, so that a hidden page keeps its
 * place in the world. Current servers send it nothing, older ones almost nothing. `visibility` is a document or a
 * Visibility.
 */
export function paintScheduler(visibility) {
  return (callback) => {
    let frame;
    let timer;
    const plan = () => {
      cancelAnimationFrame(frame);
      clearTimeout(timer);
      if (visibility.hidden) timer = setTimeout(run, kHiddenInterval);
      else frame = requestAnimationFrame(run);
    };
    const run = () => {
      visibility.removeEventListener('visibilitychange', plan);
      callback();
    };
    visibility.addEventListener('visibilitychange', plan);
    plan();
  };
}

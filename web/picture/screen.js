import { turnOf, windowOf } from './look_geometry.js';
import { kNoMovement } from '../walk/prediction.js';

/** The view of the picture's own camera. */
const kOwnView = Object.freeze({ turn: Object.freeze({ yaw: 0, pitch: 0 }), ...kNoMovement });

const isSame = (a, b) =>
  a.turn.yaw === b.turn.yaw &&
  a.turn.pitch === b.turn.pitch &&
  a.elapsed === b.elapsed &&
  a.displacement.every((value, i) => value === b.displacement[i]);

/**
 * Paints pictures: unchanged while the visitor is where their camera was, else turned and moved by late look. So late
 * look costs time only during a turn or a walk.
 *
 * A view is `turn` (radians) and `displacement` (metres) from the picture's camera, and `elapsed`, `until` and `isMoving`
 * as Prediction.moved() returns them.
 */
export class Screen {
  #canvas;
  #context;
  #lateLook;
  #look;
  #move;
  #onPaint;
  #shown = null;
  #view = kOwnView;
  #taken = false;

  /**
   * @param {object} parts
   * @param {HTMLCanvasElement | OffscreenCanvas} parts.canvas gets each picture's size; the style sheet fits it in
   * @param {import('./late_look.js').LateLook} parts.lateLook
   * @param {() => {yaw: number, pitch: number} | null} parts.look the newest direction, in radians; `null`: turn no
   *     pictures
   * @param {(picture: object) => object} parts.move the visitor's movement since the picture, as Prediction.moved()
   *     returns it
   * @param {(picture: object, view: object) => void} parts.onPaint after each paint
   */
  constructor({ canvas, lateLook, look, move, onPaint }) {
    this.#canvas = canvas;
    this.#context = canvas.getContext('2d', { alpha: false });
    this.#lateLook = lateLook;
    this.#look = look;
    this.#move = move;
    this.#onPaint = onPaint;
  }

  /** Shows a new picture, and takes ownership of its image. */
  show(image, picture) {
    this.freeze();
    this.#shown = { image, picture };
    this.#paint(this.#wanted());
  }

  /** Whether the view on the screen differs from the visitor's, or will soon. */
  get isBehind() {
    if (!this.#shown) return false;
    const view = this.#wanted();
    return view.isMoving || !isSame(view, this.#view);
  }

  /** Whether the visitor's view changes without another look or input. */
  get isMoving() {
    return this.#shown !== null && this.#view.isMoving;
  }

  /** Whether the picture on the screen is turned or moved, which costs more time. */
  get isTurned() {
    return !isSame(this.#view, kOwnView);
  }

  /** Turns and moves the picture on the screen to the visitor's newest view. */
  turn() {
    if (!this.#shown) return;
    const view = this.#wanted();
    if (isSame(view, this.#view)) this.#view = view;
    else this.#paint(view);
  }

  /** Keeps the screen as it is until the next picture. */
  freeze() {
    this.#shown?.image.close();
    this.#shown = null;
    this.#taken = false;
  }

  #wanted() {
    const look = this.#look();
    const { picture } = this.#shown;
    const canTurn = look && this.#lateLook.isReady && picture.tanHalfX !== undefined;
    return canTurn ? { turn: turnOf(picture, look), ...this.#move(picture) } : kOwnView;
  }

  #paint(view) {
    this.#view = view;
    this.#draw(view);
    this.#onPaint(this.#shown.picture, view);
  }

  #draw(view) {
    const { image, picture } = this.#shown;
    const { width, height } = windowOf(picture);
    // Setting the size clears the canvas, so it happens only on a change, and together with drawing, to avoid a flash.
    if (this.#canvas.width !== width || this.#canvas.height !== height) {
      this.#canvas.width = width;
      this.#canvas.height = height;
    }
    if (isSame(view, kOwnView)) {
      const [left, top] = [(picture.width - width) / 2, (picture.height - height) / 2];
      if (image.imageData) this.#context.putImageData(image.imageData, -left, -top);
      else this.#context.drawImage(image, left, top, width, height, 0, 0, width, height);
      return;
    }
    if (!this.#taken || this.#lateLook.isEmpty) this.#lateLook.take(image.imageData ?? image, picture);
    this.#taken = true;
    this.#context.drawImage(this.#lateLook.seen(picture, view), 0, 0);
  }
}

import { turnOf, windowOf } from './look_geometry.js';

const kNoTurn = Object.freeze({ yaw: 0, pitch: 0 });

/**
 * Paints pictures: unchanged while the visitor looks in their camera's direction, else turned by late look. So late
 * look costs time only during a turn.
 */
export class Screen {
  #canvas;
  #context;
  #lateLook;
  #look;
  #onPaint;
  #shown = null;
  #turn = kNoTurn;
  #taken = false;

  /**
   * @param {object} parts
   * @param {HTMLCanvasElement | OffscreenCanvas} parts.canvas gets each picture's size; the style sheet fits it in
   * @param {import('./late_look.js').LateLook} parts.lateLook
   * @param {() => {yaw: number, pitch: number} | null} parts.look the newest direction, in radians; `null`: turn no
   *     pictures
   * @param {(picture: object, turn: {yaw: number, pitch: number}) => void} parts.onPaint after each paint
   */
  constructor({ canvas, lateLook, look, onPaint }) {
    this.#canvas = canvas;
    this.#context = canvas.getContext('2d', { alpha: false });
    this.#lateLook = lateLook;
    this.#look = look;
    this.#onPaint = onPaint;
  }

  /** Shows a new picture, and takes ownership of its image. */
  show(image, picture) {
    this.freeze();
    this.#shown = { image, picture };
    this.#paint(this.#wanted());
  }

  /** Whether the direction on the screen differs from the visitor's. */
  get isBehind() {
    if (!this.#shown) return false;
    const { yaw, pitch } = this.#wanted();
    return yaw !== this.#turn.yaw || pitch !== this.#turn.pitch;
  }

  /** Whether the picture on the screen is turned, which costs more time. */
  get isTurned() {
    return this.#turn.yaw !== 0 || this.#turn.pitch !== 0;
  }

  /** Turns the picture on the screen to the newest look. */
  turn() {
    if (this.isBehind) this.#paint(this.#wanted());
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
    return canTurn ? turnOf(picture, look) : kNoTurn;
  }

  #paint(turn) {
    this.#turn = turn;
    this.#draw(turn);
    this.#onPaint(this.#shown.picture, turn);
  }

  #draw(turn) {
    const { image, picture } = this.#shown;
    const { width, height } = windowOf(picture);
    // Setting the size clears the canvas, so it happens only on a change, and together with drawing, to avoid a flash.
    if (this.#canvas.width !== width || this.#canvas.height !== height) {
      this.#canvas.width = width;
      this.#canvas.height = height;
    }
    if (turn.yaw === 0 && turn.pitch === 0) {
      const [left, top] = [(picture.width - width) / 2, (picture.height - height) / 2];
      if (image.imageData) this.#context.putImageData(image.imageData, -left, -top);
      else this.#context.drawImage(image, left, top, width, height, 0, 0, width, height);
      return;
    }
    if (!this.#taken || this.#lateLook.isEmpty) this.#lateLook.take(image.imageData ?? image, picture);
    this.#taken = true;
    this.#context.drawImage(this.#lateLook.turned(picture, turn), 0, 0);
  }
}

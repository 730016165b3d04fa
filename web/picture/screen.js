import { turnOf, windowOf } from './look_geometry.js';

const kNoTurn = Object.freeze({ yaw: 0, pitch: 0 });

/**
 * Where pictures are painted: as they are while the visitor looks where their camera did, else turned by late look, whose
 * cost is so paid only while somebody turns.
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
   * @param {HTMLCanvasElement | OffscreenCanvas} parts.canvas takes each picture's size; the style sheet fits it into the window
   * @param {import('./late_look.js').LateLook} parts.lateLook
   * @param {() => {yaw: number, pitch: number} | null} parts.look the newest direction, in radians; `null` to leave
   *     pictures as they are
   * @param {(picture: object, turn: {yaw: number, pitch: number}) => void} parts.onPaint what is on the screen now
   */
  constructor({ canvas, lateLook, look, onPaint }) {
    this.#canvas = canvas;
    this.#context = canvas.getContext('2d', { alpha: false });
    this.#lateLook = lateLook;
    this.#look = look;
    this.#onPaint = onPaint;
  }

  /** Shows a new picture and takes over its image. */
  show(image, picture) {
    this.freeze();
    this.#shown = { image, picture };
    this.#paint(this.#wanted());
  }

  /** Whether the picture on the screen looks elsewhere than the visitor. */
  get isBehind() {
    if (!this.#shown) return false;
    const { yaw, pitch } = this.#wanted();
    return yaw !== this.#turn.yaw || pitch !== this.#turn.pitch;
  }

  /** Whether the picture on the screen is turned, which costs more than to paint it as it is. */
  get isTurned() {
    return this.#turn.yaw !== 0 || this.#turn.pitch !== 0;
  }

  /** Turns the picture on the screen to the newest look. */
  turn() {
    if (this.isBehind) this.#paint(this.#wanted());
  }

  /** What is on the screen stays as it is until the next picture. */
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
    // Setting the size clears the canvas, so it happens only when it changes and in one go with the drawing: no flash.
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
    if (!this.#taken) this.#lateLook.take(image.imageData ?? image, picture);
    this.#taken = true;
    this.#context.drawImage(this.#lateLook.turned(picture, turn), 0, 0);
  }
}

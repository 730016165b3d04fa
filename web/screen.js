import { LateLookPainter } from './late_look.js';
import { turnOf, windowOf } from './look_geometry.js';

const kNoTurn = Object.freeze({ yaw: 0, pitch: 0 });

/** Paints the middle of each picture, as it is. */
function flatPainter(canvas) {
  const context = canvas.getContext('2d', { alpha: false });
  return (image, picture) => {
    const { width, height } = windowOf(picture);
    // Setting the size clears the canvas, so it happens only when it changes and in one go with the drawing: no flash.
    if (canvas.width !== width || canvas.height !== height) {
      canvas.width = width;
      canvas.height = height;
    }
    const [left, top] = [(picture.width - width) / 2, (picture.height - height) / 2];
    context.drawImage(image, left, top, width, height, 0, 0, width, height);
  };
}

/**
 * Where pictures are painted: by WebGL, turned to the newest look, or flat where WebGL is missing. While a graphics card
 * has lost what it held, pictures are painted flat on a second canvas over the first.
 */
export class Screen {
  #canvas;
  #look;
  #onChange;
  #warp;
  #flat;
  #cover = null;
  #lost = false;
  #lateLook = true;
  #picture = null;
  #turn = kNoTurn;

  /**
   * @param {object} parts
   * @param {HTMLCanvasElement} parts.canvas takes each picture's size; the style sheet fits it into the window
   * @param {() => {yaw: number, pitch: number}} parts.look the newest direction, in radians
   * @param {() => void} parts.onChange `canTurn` has changed
   */
  constructor({ canvas, look, onChange }) {
    this.#canvas = canvas;
    this.#look = look;
    this.#onChange = onChange;
    this.#warp = LateLookPainter.on(canvas);
    if (!this.#warp) this.#flat = flatPainter(canvas);
    canvas.addEventListener('webglcontextlost', (event) => {
      event.preventDefault(); // or it never comes back
      this.#lost = true;
      this.#onChange();
    });
    canvas.addEventListener('webglcontextrestored', () => {
      this.#lost = !this.#warp.prepare();
      this.#picture = null;
      this.#onChange();
    });
  }

  /** Whether pictures can be turned to the newest look here. */
  get canTurn() {
    return Boolean(this.#warp) && !this.#lost;
  }

  /** The canvas that shows the picture. */
  get canvas() {
    return this.#cover ?? this.#canvas;
  }

  /** Whether to turn pictures, where that can be done. */
  set lateLook(on) {
    this.#lateLook = on;
  }

  /** Paints a new picture; the image is the caller's to close. */
  paint(image, picture) {
    if (!this.canTurn) {
      this.#flat ??= flatPainter(this.#makeCover());
      this.#flat(image, picture);
      return;
    }
    this.#warp.take(image, picture);
    this.#picture = picture;
    this.#turn = this.#wanted();
    this.#warp.paint(picture, this.#turn);
    this.#removeCover();
  }

  /** Whether the picture on the screen looks elsewhere than the visitor. */
  get isBehind() {
    if (!this.canTurn || !this.#picture) return false;
    const { yaw, pitch } = this.#wanted();
    return yaw !== this.#turn.yaw || pitch !== this.#turn.pitch;
  }

  /** Turns the picture on the screen to the newest look. */
  turn() {
    if (!this.isBehind) return;
    this.#turn = this.#wanted();
    this.#warp.paint(this.#picture, this.#turn);
  }

  /** What is on the screen stays as it is until the next picture. */
  freeze() {
    this.#picture = null;
  }

  #wanted() {
    const known = this.#lateLook && this.#picture.tanHalfX !== undefined;
    return known ? turnOf(this.#picture, this.#look()) : kNoTurn;
  }

  #makeCover() {
    this.#cover = this.#canvas.ownerDocument.createElement('canvas');
    this.#cover.className = 'cover';
    this.#canvas.after(this.#cover);
    return this.#cover;
  }

  #removeCover() {
    if (!this.#cover) return;
    this.#cover.remove();
    this.#cover = null;
    this.#flat = null;
  }
}

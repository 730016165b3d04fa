import { LookBuffers } from './look_buffers.js';
import { isMoved, lookMatrix, windowOf } from './look_geometry.js';
import { isSoftware, kContext, link } from './look_program.js';

/** The places of the mesh's corners are in the picture already. */
const kIdentity = Object.freeze([1, 0, 0, 0, 1, 0, 0, 0, 1]);

/**
 * Shows a picture in another view, on its own canvas: turned to another direction, which needs no depth, or as from
 * another eye, by the picture's depths. So turns and steps show at the screen's next frame instead of after a round
 * trip.
 */
export class LateLook {
  /** Whether it has no copy of an image; a lost context loses its copy. */
  isEmpty = true;
  #canvas;
  #gl;
  #onChange;
  #look;
  #halfPixel;
  #buffers;
  #ready;
  #isTooSlow = false;

  /** `canvas` is hidden. `onChange()`: `isReady` has changed, as a graphics card may lose its contexts. */
  constructor(canvas, onChange) {
    this.#canvas = canvas;
    this.#onChange = onChange;
    this.#gl = canvas.getContext('webgl', kContext);
    this.#ready = this.#prepare();
    canvas.addEventListener('webglcontextlost', (event) => {
      event.preventDefault(); // else the browser never restores the context
      this.#become(false);
    });
    canvas.addEventListener('webglcontextrestored', () => this.#become(this.#prepare()));
  }

  /** False where WebGL is missing, lost or too slow. */
  get isReady() {
    return this.hindrance === '';
  }

  /** The reason why it is not ready, in a few words, or ''. */
  get hindrance() {
    if (this.#isTooSlow) return 'too slow';
    return this.#ready ? '' : 'no fast WebGL';
  }

  /** Turning takes too long in this browser: not ready until the page is reloaded. */
  giveUp() {
    this.#isTooSlow = true;
    this.#onChange();
  }

  /** Copies the image (ImageBitmap, VideoFrame or ImageData); the canvas gets the size of its window. */
  take(image, picture) {
    const gl = this.#gl;
    const { width, height } = windowOf(picture);
    if (this.#canvas.width !== width || this.#canvas.height !== height) {
      this.#canvas.width = width;
      this.#canvas.height = height;
      gl.viewport(0, 0, width, height);
    }
    gl.texImage2D(gl.TEXTURE_2D, 0, gl.RGBA, gl.RGBA, gl.UNSIGNED_BYTE, image);
    gl.uniform2f(this.#halfPixel, 0.5 / picture.width, 0.5 / picture.height);
    this.isEmpty = false;
  }

  /**
   * The copy in this view, on a canvas that holds it until the end of this task. `view`: turn (radians), displacement
   * (metres) and the time for which the moving parts went on (ms); the last two need the picture's `depths` (DepthGrid).
   */
  seen(picture, view) {
    const gl = this.#gl;
    if (isMoved(view.displacement) || view.elapsed > 0) {
      gl.uniformMatrix3fv(this.#look, false, kIdentity);
      this.#buffers.drawMesh(picture, view);
    } else {
      gl.uniformMatrix3fv(this.#look, false, lookMatrix(picture, view.turn));
      this.#buffers.drawTriangle();
    }
    return this.#canvas;
  }

  #become(ready) {
    this.#ready = ready;
    this.isEmpty = true;
    this.#onChange();
  }

  /** Sets up a new or restored context. Returns whether that worked. */
  #prepare() {
    const gl = this.#gl;
    const program = gl && !isSoftware(gl) && link(gl);
    if (!program) return false;
    gl.useProgram(program);
    this.#look = gl.getUniformLocation(program, 'look');
    this.#halfPixel = gl.getUniformLocation(program, 'halfPixel');
    this.#buffers = new LookBuffers(gl, program);

    gl.bindTexture(gl.TEXTURE_2D, gl.createTexture());
    for (const side of [gl.TEXTURE_WRAP_S, gl.TEXTURE_WRAP_T]) gl.texParameteri(gl.TEXTURE_2D, side, gl.CLAMP_TO_EDGE);
    for (const size of [gl.TEXTURE_MIN_FILTER, gl.TEXTURE_MAG_FILTER]) gl.texParameteri(gl.TEXTURE_2D, size, gl.LINEAR);
    gl.viewport(0, 0, this.#canvas.width, this.#canvas.height);
    return true;
  }
}

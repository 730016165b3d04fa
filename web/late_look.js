import { lookMatrix, windowOf } from './look_geometry.js';

const kVertexShader = `
attribute vec2 place;
uniform mat3 look;
varying highp vec3 point;
void main() {
  point = look * vec3(place, 1.0);
  gl_Position = vec4(place, 0.0, 1.0);
}`;

// Beyond the picture its edge goes on, ever darker: what is not known yet is not shown as if it were.
const kFragmentShader = `
precision highp float;
uniform sampler2D picture;
uniform vec2 halfPixel;
varying highp vec3 point;
void main() {
  vec2 place = point.xy / point.z;
  vec2 inside = clamp(place, halfPixel, 1.0 - halfPixel);
  float beyond = distance(place, clamp(place, 0.0, 1.0));
  gl_FragColor = vec4(texture2D(picture, inside).rgb * exp(-5.0 * beyond), 1.0);
}`;

const kContext = Object.freeze({
  alpha: false,
  antialias: false,
  depth: false,
  stencil: false,
  // Who saves a picture of the page, or looks at it in a test, finds one.
  preserveDrawingBuffer: true,
});

function compile(gl, type, source) {
  const shader = gl.createShader(type);
  gl.shaderSource(shader, source);
  gl.compileShader(shader);
  return shader;
}

function link(gl) {
  const program = gl.createProgram();
  gl.attachShader(program, compile(gl, gl.VERTEX_SHADER, kVertexShader));
  gl.attachShader(program, compile(gl, gl.FRAGMENT_SHADER, kFragmentShader));
  gl.linkProgram(program);
  return gl.getProgramParameter(program, gl.LINK_STATUS) ? program : null;
}

/**
 * Paints the newest picture as seen in another direction: turned, not moved, which needs no depth. So a turn of the head
 * shows at the next frame of the screen instead of after a round trip.
 */
export class LateLookPainter {
  #gl;
  #canvas;
  #look;
  #halfPixel;

  /** On a canvas without a context of another kind; `null` where WebGL is missing. */
  static on(canvas) {
    const gl = canvas.getContext('webgl', kContext);
    if (!gl) return null;
    const painter = new LateLookPainter(canvas, gl);
    return painter.prepare() ? painter : null;
  }

  constructor(canvas, gl) {
    this.#canvas = canvas;
    this.#gl = gl;
  }

  /** Makes what a new or a restored context lacks; whether that went well. */
  prepare() {
    const gl = this.#gl;
    const program = link(gl);
    if (!program) return false;
    gl.useProgram(program);
    this.#look = gl.getUniformLocation(program, 'look');
    this.#halfPixel = gl.getUniformLocation(program, 'halfPixel');

    // One triangle that covers the window has no seam through its middle.
    gl.bindBuffer(gl.ARRAY_BUFFER, gl.createBuffer());
    gl.bufferData(gl.ARRAY_BUFFER, Float32Array.of(-1, -1, 3, -1, -1, 3), gl.STATIC_DRAW);
    const place = gl.getAttribLocation(program, 'place');
    gl.enableVertexAttribArray(place);
    gl.vertexAttribPointer(place, 2, gl.FLOAT, false, 0, 0);

    gl.bindTexture(gl.TEXTURE_2D, gl.createTexture());
    for (const side of [gl.TEXTURE_WRAP_S, gl.TEXTURE_WRAP_T]) gl.texParameteri(gl.TEXTURE_2D, side, gl.CLAMP_TO_EDGE);
    for (const size of [gl.TEXTURE_MIN_FILTER, gl.TEXTURE_MAG_FILTER]) gl.texParameteri(gl.TEXTURE_2D, size, gl.LINEAR);
    return true;
  }

  /** Takes a copy of the image (ImageBitmap or VideoFrame), and its window's size for the canvas. */
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
  }

  /** Paints what was taken, turned by these angles (radians). */
  paint(picture, turn) {
    const gl = this.#gl;
    gl.uniformMatrix3fv(this.#look, false, lookMatrix(picture, turn));
    gl.drawArrays(gl.TRIANGLES, 0, 3);
  }
}

import { lookMatrix, windowOf } from './look_geometry.js';

const kVertexShader = `
attribute vec2 place;
uniform mat3 look;
varying highp vec3 point;
void main() {
  point = look * vec3(place, 1.0);
  gl_Position = vec4(place, 0.0, 1.0);
}`;

// Beyond the picture its edge continues, ever darker and, along the edge, more blurred: unknown areas must not look
// real.
const kFragmentShader = `
precision highp float;
uniform sampler2D picture;
uniform vec2 halfPixel;
varying highp vec3 point;
vec3 colourAt(vec2 place) {
  return texture2D(picture, clamp(place, halfPixel, 1.0 - halfPixel)).rgb;
}
void main() {
  vec2 place = point.xy / point.z;
  vec2 outwards = place - clamp(place, 0.0, 1.0);
  vec3 colour = vec3(0.0);
  if (outwards == vec2(0.0)) {
    colour = colourAt(place);
  } else {
    for (int i = -6; i <= 6; i += 1) colour += colourAt(place + 0.12 * float(i) * outwards.yx);
    colour *= exp(-2.5 * length(outwards)) / 13.0;
  }
  gl_FragColor = vec4(colour, 1.0);
}`;

// Software WebGL turns a picture more slowly than the server sends the next, on the processor that decodes it.
const kContext = Object.freeze({
  alpha: false,
  antialias: false,
  depth: false,
  stencil: false,
  failIfMajorPerformanceCaveat: true,
});

// Not every browser counts these as a major performance caveat.
const kSoftware = /swiftshader|llvmpipe|softpipe|software|basic render/i;

function isSoftware(gl) {
  const names = gl.getExtension('WEBGL_debug_renderer_info');
  return kSoftware.test(gl.getParameter(names ? names.UNMASKED_RENDERER_WEBGL : gl.RENDERER));
}

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
 * Turns a picture to another direction, on its own canvas. It turns without moving, which needs no depth. So a turn of
 * the head shows at the screen's next frame instead of after a round trip.
 */
export class LateLook {
  /** Whether it has no copy of an image; a lost context loses its copy. */
  isEmpty = true;
  #canvas;
  #gl;
  #onChange;
  #look;
  #halfPixel;
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

  /** The copy, turned by these angles (radians), on a canvas that holds it until the end of this task. */
  turned(picture, turn) {
    const gl = this.#gl;
    gl.uniformMatrix3fv(this.#look, false, lookMatrix(picture, turn));
    gl.drawArrays(gl.TRIANGLES, 0, 3);
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

    // One triangle that covers the window has no seam through its middle.
    gl.bindBuffer(gl.ARRAY_BUFFER, gl.createBuffer());
    gl.bufferData(gl.ARRAY_BUFFER, Float32Array.of(-1, -1, 3, -1, -1, 3), gl.STATIC_DRAW);
    const place = gl.getAttribLocation(program, 'place');
    gl.enableVertexAttribArray(place);
    gl.vertexAttribPointer(place, 2, gl.FLOAT, false, 0, 0);

    gl.bindTexture(gl.TEXTURE_2D, gl.createTexture());
    for (const side of [gl.TEXTURE_WRAP_S, gl.TEXTURE_WRAP_T]) gl.texParameteri(gl.TEXTURE_2D, side, gl.CLAMP_TO_EDGE);
    for (const size of [gl.TEXTURE_MIN_FILTER, gl.TEXTURE_MAG_FILTER]) gl.texParameteri(gl.TEXTURE_2D, size, gl.LINEAR);
    gl.viewport(0, 0, this.#canvas.width, this.#canvas.height);
    return true;
  }
}

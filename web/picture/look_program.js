const kVertexShader = `
attribute vec2 corner;
attribute vec2 place;
uniform mat3 look;
varying highp vec3 point;
void main() {
  point = look * vec3(place, 1.0);
  gl_Position = vec4(corner, 0.0, 1.0);
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
export const kContext = Object.freeze({
  alpha: false,
  antialias: false,
  depth: false,
  stencil: false,
  failIfMajorPerformanceCaveat: true,
});

// Not every browser counts these as a major performance caveat.
const kSoftware = /swiftshader|llvmpipe|softpipe|software|basic render/i;

export function isSoftware(gl) {
  const names = gl.getExtension('WEBGL_debug_renderer_info');
  return kSoftware.test(gl.getParameter(names ? names.UNMASKED_RENDERER_WEBGL : gl.RENDERER));
}

function compile(gl, type, source) {
  const shader = gl.createShader(type);
  gl.shaderSource(shader, source);
  gl.compileShader(shader);
  return shader;
}

/**
 * The program that draws a picture in another view, or `null`. `look` maps the places of its corners to the picture.
 */
export function link(gl) {
  const program = gl.createProgram();
  gl.attachShader(program, compile(gl, gl.VERTEX_SHADER, kVertexShader));
  gl.attachShader(program, compile(gl, gl.FRAGMENT_SHADER, kFragmentShader));
  gl.linkProgram(program);
  return gl.getProgramParameter(program, gl.LINK_STATUS) ? program : null;
}

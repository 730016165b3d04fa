/** A WebGL context of a graphics card, and a log of what it draws with which buffers. */
export function fakeGl() {
  const log = [];
  const bound = {};
  let buffers = 0;
  const known = {
    getExtension: () => null,
    getParameter: () => 'a graphics card',
    getProgramParameter: () => true,
    getAttribLocation: (program, name) => name,
    getUniformLocation: (program, name) => name,
    createBuffer: () => ({ id: (buffers += 1), length: 0 }),
    bindBuffer: (target, buffer) => (bound[target] = buffer),
    bufferData: (target, values) => (bound[target].length = values.length),
    vertexAttribPointer: (attribute) => (bound[attribute] = bound.ARRAY_BUFFER),
    uniformMatrix3fv: (place, transpose, matrix) => (bound.look = matrix.join()),
    drawArrays: (mode, first, count) =>
      log.push({ triangle: count, places: bound.place, corners: bound.corner, look: bound.look }),
    drawElements: (mode, count) =>
      log.push({
        indices: count,
        of: bound.ELEMENT_ARRAY_BUFFER.length,
        places: bound.place.length,
        corners: bound.corner.length,
        look: bound.look,
      }),
  };
  const gl = new Proxy(known, {
    get: (target, name) => target[name] ?? (/^[A-Z_\d]+$/.test(name) ? name : () => ({})),
  });
  return { log, gl };
}

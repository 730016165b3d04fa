import { windowOf } from './look_geometry.js';
import { WarpMesh } from './warp_mesh.js';

/** One triangle that covers the window has no seam through its middle. */
const kTriangle = Float32Array.of(-1, -1, 3, -1, -1, 3);

/** What LateLook draws, as buffers of one WebGL context: a triangle, and a mesh for the pictures of one size. */
export class LookBuffers {
  #gl;
  #corner;
  #place;
  #triangle;
  #corners;
  #places;
  #indices;
  #mesh = null;
  #size = '';

  constructor(gl, program) {
    this.#gl = gl;
    this.#corner = gl.getAttribLocation(program, 'corner');
    this.#place = gl.getAttribLocation(program, 'place');
    gl.enableVertexAttribArray(this.#corner);
    gl.enableVertexAttribArray(this.#place);
    [this.#triangle, this.#corners, this.#places, this.#indices] = Array.from({ length: 4 }, () => gl.createBuffer());
    this.#fill(this.#triangle, kTriangle, gl.STATIC_DRAW);
  }

  /** Corners and places are the same: the program's matrix finds the places in the picture. */
  drawTriangle() {
    const gl = this.#gl;
    this.#use(this.#corner, this.#triangle);
    this.#use(this.#place, this.#triangle);
    gl.drawArrays(gl.TRIANGLES, 0, 3);
  }

  /** Draws the picture bent to the view; the places are in the picture already. */
  drawMesh(picture, view) {
    const gl = this.#gl;
    this.#fit(picture);
    this.#mesh.bend(picture, picture.depths, view);
    this.#fill(this.#places, this.#mesh.places, gl.STREAM_DRAW);
    this.#use(this.#place, this.#places);
    this.#use(this.#corner, this.#corners);
    gl.drawElements(gl.TRIANGLES, this.#mesh.indices.length, gl.UNSIGNED_SHORT, 0);
  }

  #fit(picture) {
    const gl = this.#gl;
    const size = Object.values(windowOf(picture)).join();
    if (size === this.#size) return;
    this.#size = size;
    this.#mesh = new WarpMesh(picture);
    this.#fill(this.#corners, this.#mesh.corners, gl.STATIC_DRAW);
    gl.bindBuffer(gl.ELEMENT_ARRAY_BUFFER, this.#indices);
    gl.bufferData(gl.ELEMENT_ARRAY_BUFFER, this.#mesh.indices, gl.STATIC_DRAW);
  }

  #fill(buffer, values, use) {
    this.#gl.bindBuffer(this.#gl.ARRAY_BUFFER, buffer);
    this.#gl.bufferData(this.#gl.ARRAY_BUFFER, values, use);
  }

  #use(attribute, buffer) {
    this.#gl.bindBuffer(this.#gl.ARRAY_BUFFER, buffer);
    this.#gl.vertexAttribPointer(attribute, 2, this.#gl.FLOAT, false, 0, 0);
  }
}

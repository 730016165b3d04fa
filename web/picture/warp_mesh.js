import { kCell } from './depth_grid.js';
import { lookMatrix, shiftOf, windowOf } from './look_geometry.js';
import { MovingSurface, displacementFrom } from './moving_surface.js';

/** Steps that find the surface at a corner: in the first row from the nearest surface, then from the corner above. */
const kFirstSteps = 4;
const kSteps = 2;
/** Rays that advance less along the picture's direction meet nothing in it. */
const kLeastForward = 1e-3;

/** The corners' positions in the window along one side, -1 to 1 in steps of a cell; the last one is at the end. */
function positionsAlong(side) {
  const count = Math.ceil(side / kCell) + 1;
  return Float32Array.from({ length: count }, (_, i) => (2 * Math.min(side, i * kCell)) / side - 1);
}

function cornersOf(xs, ys) {
  const corners = new Float32Array(2 * xs.length * ys.length);
  let out = 0;
  for (const y of ys) {
    for (const x of xs) {
      corners[out++] = x;
      corners[out++] = y;
    }
  }
  return corners;
}

/** Two triangles per cell, as indices of corners. */
function trianglesOf(across, down) {
  const indices = new Uint16Array(6 * (across - 1) * (down - 1));
  let out = 0;
  for (let row = 0; row + 1 < down; row += 1) {
    for (let column = 0; column + 1 < across; column += 1) {
      const at = row * across + column;
      for (const corner of [at, at + 1, at + across, at + across, at + 1, at + across + 1]) indices[out++] = corner;
    }
  }
  return indices;
}

/**
 * A mesh over the window whose corners have places in the picture, so that the picture appears as from another eye.
 * For pictures of one size.
 */
export class WarpMesh {
  /** Positions of the corners in the window: x and y, each -1 to 1, y upwards. */
  corners;
  /** The corners' places in the picture, from 0 to 1, t downwards; beyond the picture outside that. */
  places;
  /** Two triangles per cell. */
  indices;
  #xs;
  #ys;
  #nearness;
  /** The corners' places if everything were infinitely far. */
  #far;

  constructor(picture) {
    const { width, height } = windowOf(picture);
    this.#xs = positionsAlong(width);
    this.#ys = positionsAlong(height).map((y) => -y);
    const across = this.#xs.length;
    this.#nearness = new Float32Array(across);
    this.corners = cornersOf(this.#xs, this.#ys);
    this.places = new Float32Array(this.corners.length);
    this.#far = new Float32Array(this.corners.length);
    this.indices = trianglesOf(across, this.#ys.length);
  }

  /**
   * Finds the places for an eye that has moved by `displacement` (metres, in the world) and turned by `turn` (radians)
   * since the picture, whose moving parts went on for `elapsed` milliseconds. As server/node/frontend/backdrops does with
   * backdrops: a ray of the window meets the surface of nearness w at the place a + b w.
   */
  bend(picture, depths, view) {
    const look = lookMatrix(picture, view.turn);
    const shift = shiftOf(picture, view.displacement);
    this.#nearness.fill(depths.nearest);
    for (let row = 0; row < this.#ys.length; row += 1) {
      this.#bendRow(row, look, shift, depths, row === 0 ? kFirstSteps : kSteps);
    }
    if (view.elapsed === 0) return;
    // The nearest comes last, because it hides the others.
    for (const part of [...picture.space.moving].reverse()) {
      const surface = new MovingSurface(picture, depths, part);
      this.#follow(surface, shiftOf(picture, displacementFrom(part, view)));
    }
  }

  /**
   * Finds the places again for corners that show a moving surface now, or would show it where it was: there, what is
   * behind it moves along. `shift`: of the eye, as seen from the surface.
   */
  #follow(surface, [shiftX, shiftY, forwards]) {
    const places = this.places;
    for (let i = 0; i < places.length; i += 2) {
      const [farX, farY] = [this.#far[i], this.#far[i + 1]];
      const x = farX + (shiftX - farX * forwards) * surface.nearness;
      const y = farY + (shiftY - farY * forwards) * surface.nearness;
      if (!surface.isAt(x, y) && !surface.isAt(places[i], places[i + 1])) continue;
      places[i] = x;
      places[i + 1] = y;
    }
  }

  #bendRow(row, look, [shiftX, shiftY, forwards], depths, steps) {
    const xs = this.#xs;
    const places = this.places;
    const y = this.#ys[row];
    const beginX = look[3] * y + look[6];
    const beginY = look[4] * y + look[7];
    const beginForward = look[5] * y + look[8];
    let out = 2 * row * xs.length;
    for (let column = 0; column < xs.length; column += 1) {
      const x = xs[column];
      const perForward = 1 / Math.max(kLeastForward, look[2] * x + beginForward);
      const farX = (look[0] * x + beginX) * perForward;
      const farY = (look[1] * x + beginY) * perForward;
      const wayX = shiftX - farX * forwards;
      const wayY = shiftY - farY * forwards;
      let nearness = this.#nearness[column];
      for (let i = 0; i < steps; i += 1) nearness = depths.at(farX + wayX * nearness, farY + wayY * nearness);
      this.#nearness[column] = nearness;
      this.#far[out] = farX;
      this.#far[out + 1] = farY;
      places[out] = farX + wayX * nearness;
      places[out + 1] = farY + wayY * nearness;
      out += 2;
    }
  }
}

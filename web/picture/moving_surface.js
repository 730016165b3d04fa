import { kCell } from './depth_grid.js';

/** Nearness in a picture may be wrong by so much, 1/m. */
const kTolerance = 1.5 / 64;

/** A cell and its neighbours, in cells. */
const kAround = [-1, 0, 1].flatMap((down) => [-1, 0, 1].map((right) => [right, down]));

/** The movement of the eye (metres) as seen from a moving part that went on for `elapsed` milliseconds. */
export function displacementFrom({ velocity }, { displacement, elapsed }) {
  return displacement.map((value, i) => value - (velocity[i] * elapsed) / 1000);
}

/** 1 / view depth of a moving part's middle, in 1/m. */
export const nearnessOf = ({ nearest, farthest }) => 2 / (nearest + farthest);

/** The surface of an object that moves by itself, in a picture with its depths (DepthGrid). */
export class MovingSurface {
  /** 1 / view depth of its middle, in 1/m. */
  nearness;
  #depths;
  #cell;
  #least;
  #most;
  #left;
  #right;
  #top;
  #bottom;

  /** `part`: of the picture's space. */
  constructor({ width, height }, depths, part) {
    const { left, top, right, bottom, nearest, farthest } = part;
    this.#depths = depths;
    this.nearness = nearnessOf(part);
    this.#least = 1 / farthest - kTolerance;
    this.#most = 1 / nearest + kTolerance;
    this.#cell = [kCell / width, kCell / height];
    [this.#left, this.#right] = [left / width - this.#cell[0], right / width + this.#cell[0]];
    [this.#top, this.#bottom] = [top / height - this.#cell[1], bottom / height + this.#cell[1]];
  }

  /**
   * Whether a corner of the mesh at this place, as shares of width and height, moves with the surface. So do those
   * within a cell of it, unless something nearer is there: silhouettes move as a whole.
   */
  isAt(x, y) {
    if (x < this.#left || x > this.#right || y < this.#top || y > this.#bottom) return false;
    if (this.#depths.ofCellAt(x, y) > this.#most) return false;
    const [cellX, cellY] = this.#cell;
    return kAround.some(([right, down]) => {
      const nearness = this.#depths.ofCellAt(x + right * cellX, y + down * cellY);
      return nearness >= this.#least && nearness <= this.#most;
    });
  }
}

/** Side of a cell of the grid, in pixels of the picture. */
export const kCell = 16;

/** A cell that is farther than its neighbour by more than this (1/m) is beyond a silhouette. */
const kSilhouette = 0.1;

/** The number of cells of a picture, border included. */
export function cellsOf({ width, height }) {
  return { columns: Math.ceil(width / kCell), rows: Math.ceil(height / kCell) };
}

/** Silhouettes move with the nearer surface, so the cells around it get its nearness. */
function spread(nearness, columns, rows) {
  const out = new Float32Array(nearness.length);
  for (let row = 0; row < rows; row += 1) {
    const [top, bottom] = [Math.max(0, row - 1), Math.min(rows - 1, row + 1)];
    for (let column = 0; column < columns; column += 1) {
      const [left, right] = [Math.max(0, column - 1), Math.min(columns - 1, column + 1)];
      let nearest = 0;
      for (let y = top; y <= bottom; y += 1) {
        for (let x = left; x <= right; x += 1) nearest = Math.max(nearest, nearness[y * columns + x]);
      }
      const at = row * columns + column;
      out[at] = nearest > nearness[at] + kSilhouette ? nearest : nearness[at];
    }
  }
  return out;
}

/** How near the surfaces in a picture are: 1 / view depth, in 1/m. */
export class DepthGrid {
  nearness;
  columns;
  rows;
  /** The largest nearness. */
  nearest = 0;
  /** Cells per width and height of the picture. */
  across;
  down;

  /** `nearness`: of each cell, row by row from the top, at its centre; 0 is infinitely far. */
  constructor(picture, nearness) {
    const { columns, rows } = cellsOf(picture);
    this.columns = columns;
    this.rows = rows;
    this.across = picture.width / kCell;
    this.down = picture.height / kCell;
    this.nearness = spread(nearness, columns, rows);
    for (const value of this.nearness) this.nearest = Math.max(this.nearest, value);
  }

  /** The nearness of the cell at a place; without the values between two surfaces, which at() has. */
  ofCellAt(x, y) {
    const column = Math.min(this.columns - 1, Math.max(0, Math.floor(x * this.across)));
    const row = Math.min(this.rows - 1, Math.max(0, Math.floor(y * this.down)));
    return this.nearness[row * this.columns + column];
  }

  /** The nearness at a place, as shares of the picture's width and height, between the centres of cells. */
  at(x, y) {
    const nearness = this.nearness;
    const columns = this.columns;
    const u = Math.min(columns - 1, Math.max(0, x * this.across - 0.5));
    const v = Math.min(this.rows - 1, Math.max(0, y * this.down - 0.5));
    const column = u | 0;
    const row = v | 0;
    const first = row * columns + column;
    const next = column + 1 < columns ? 1 : 0;
    const below = row + 1 < this.rows ? columns : 0;
    const right = u - column;
    const upper = nearness[first] + right * (nearness[first + next] - nearness[first]);
    const lower = nearness[first + below] + right * (nearness[first + below + next] - nearness[first + below]);
    return upper + (v - row) * (lower - upper);
  }
}

import { DepthGrid, cellsOf } from '../picture/depth_grid.js';

/** A mesh has at most this many cells: its indices have 16 bits. */
const kMaxCells = 65_000;

/**
 * The picture with its `depths` (DepthGrid) if it has a space, else without both. Bad depths cost only this picture's
 * movement. `decodeNearness(bytes, columns, rows)` returns a nearness per cell, or throws.
 */
export function withDepths(picture, decodeNearness) {
  if (!picture.space) return picture;
  const { columns, rows } = cellsOf(picture);
  try {
    if ((columns + 1) * (rows + 1) > kMaxCells) throw new RangeError('the picture is too large for a mesh');
    return { ...picture, depths: new DepthGrid(picture, decodeNearness(picture.space.nearness, columns, rows)) };
  } catch {
    return { ...picture, space: null };
  }
}

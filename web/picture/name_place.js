import { windowPlace } from './look_geometry.js';
import { displacementFrom, nearnessOf } from './moving_surface.js';

/** A name is above its object by at most this share of the object's height. */
const kNameAbove = 0.15;

/** The nearest moving part of a picture whose name may be at this place, as shares of width and height. */
function partNamedAt({ width, height, space }, { x, y }) {
  return space?.moving.find(({ left, top, right, bottom }) => {
    const isBeside = x * width >= left && x * width <= right;
    return isBeside && y * height <= bottom && y * height >= top - kNameAbove * (bottom - top);
  });
}

/** The place of a name in the window, as windowPlace() returns it. Names move with those who walk. */
export function namePlace(picture, view, label) {
  const part = partNamedAt(picture, label);
  if (!part) return windowPlace(picture, view, label, picture.depths?.at(label.x, label.y));
  return windowPlace(picture, { ...view, displacement: displacementFrom(part, view) }, label, nearnessOf(part));
}

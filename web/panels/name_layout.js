/** Pixels between two names. */
const kGap = 3;
/** Names move up by at most this many times their height: further up, they fit no figure. */
const kFurthest = 3;

const overlaps = (a, b) =>
  Math.abs(a.x - b.x) * 2 < a.width + b.width + 2 * kGap && a.y - a.height < b.y + kGap && b.y - b.height < a.y + kGap;

/**
 * Pixels to move each name up so that no names overlap; `null` for a name without room. Earlier `boxes` have priority;
 * `x` is the middle, `y` the lower edge.
 */
export function liftsOf(boxes) {
  const taken = [];
  return boxes.map((box) => {
    let { y } = box;
    const obstacle = () => taken.find((other) => overlaps(other, { ...box, y }));
    for (let other = obstacle(); other; other = obstacle()) y = other.y - other.height - kGap;
    const lift = box.y - y;
    if (lift > kFurthest * box.height) return null;
    taken.push({ ...box, y });
    return lift;
  });
}

/** The place, in pixels of a window, of a point (shares) in a picture that covers it (`object-fit: cover`). */
export function coverPlace({ x, y }, picture, window) {
  const scale = Math.max(window.width / picture.width, window.height / picture.height);
  return {
    x: window.width / 2 + (x - 0.5) * picture.width * scale,
    y: window.height / 2 + (y - 0.5) * picture.height * scale,
  };
}

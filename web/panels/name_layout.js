/** Pixels between two names. */
const kGap = 3;
/** So many times its height a name is moved up at most; further away, nobody knows whose it is. */
const kFurthest = 3;

const overlaps = (a, b) =>
  Math.abs(a.x - b.x) * 2 < a.width + b.width + 2 * kGap && a.y - a.height < b.y + kGap && b.y - b.height < a.y + kGap;

/**
 * How far to move each name upwards so that none overlaps another: pixels, `null` for one that finds no room. `boxes` are
 * in the order in which they may choose; `x` is the middle, `y` the lower edge.
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

/** Where a share of a picture is that covers a window whatever its shape (`object-fit: cover`): pixels of the window. */
export function coverPlace({ x, y }, picture, window) {
  const scale = Math.max(window.width / picture.width, window.height / picture.height);
  return {
    x: window.width / 2 + (x - 0.5) * picture.width * scale,
    y: window.height / 2 + (y - 0.5) * picture.height * scale,
  };
}

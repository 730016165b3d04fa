/** Directions closer than this (radians) are equal: the stream carries 32-bit floats. */
const kSameAngle = 1e-5;
/**
 * The largest turn, as a share of half the picture's angle: beyond it, more of the window would be invented than seen.
 */
const kFurthestTurn = 0.8;

/** Tolerance for the rounding of a division. */
const kRounding = 1e-6;

/**
 * The size of the window in a picture: its middle, without the border. The number of cut pixels is even, so that the
 * window's pixels fall on the picture's, and rounded down, as the server rounds down the whole picture.
 */
export function windowOf({ width, height, border = 0 }) {
  const inner = (side) => side - 2 * Math.floor((side - side / (1 + border / 100)) / 2 + kRounding);
  return { width: inner(width), height: inner(height) };
}

/** As server/world/camera.h: yaw 0 looks along -Z and grows counter-clockwise seen from above, pitch grows upwards. */
function axes({ yaw, pitch }) {
  const [sinYaw, cosYaw, sinPitch, cosPitch] = [Math.sin(yaw), Math.cos(yaw), Math.sin(pitch), Math.cos(pitch)];
  return {
    right: [cosYaw, 0, -sinYaw],
    up: [sinYaw * sinPitch, cosPitch, cosYaw * sinPitch],
    forward: [-sinYaw * cosPitch, sinPitch, -cosYaw * cosPitch],
  };
}

const dot = (a, b) => a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
const within = (value, limit) => Math.min(limit, Math.max(-limit, value));

/**
 * The turn from the picture's direction to the look (radians), as far as the picture goes; zeros for equal directions.
 */
export function turnOf(picture, look) {
  const whole = 2 * Math.PI;
  const yaw = look.yaw - picture.yaw;
  const turn = {
    yaw: within(yaw - whole * Math.round(yaw / whole), kFurthestTurn * Math.atan(picture.tanHalfX)),
    pitch: within(look.pitch - picture.pitch, kFurthestTurn * Math.atan(picture.tanHalfY)),
  };
  if (Math.abs(turn.yaw) < kSameAngle) turn.yaw = 0;
  if (Math.abs(turn.pitch) < kSameAngle) turn.pitch = 0;
  return turn;
}

/**
 * The place in the window of a point in the picture, both as shares of width and height from the top left; `null`
 * outside the window. The inverse of lookMatrix(). If the eye has moved, by `displacement` (metres), it depends on the
 * point's `nearness`, 1 / view depth.
 */
export function windowPlace(picture, { turn, displacement }, { x, y }, nearness = 0) {
  const inner = windowOf(picture);
  const { tanHalfX, tanHalfY } = picture;
  const from = axes(picture);
  const to = axes({ yaw: picture.yaw + turn.yaw, pitch: picture.pitch + turn.pitch });
  const [across, upwards] = [(2 * x - 1) * tanHalfX, (1 - 2 * y) * tanHalfY];
  const ray = from.forward.map(
    (value, i) => value + across * from.right[i] + upwards * from.up[i] - nearness * displacement[i],
  );
  const depth = dot(ray, to.forward);
  const place = {
    x: 0.5 + dot(ray, to.right) / depth / (tanHalfX * inner.width / picture.width) / 2,
    y: 0.5 - dot(ray, to.up) / depth / (tanHalfY * inner.height / picture.height) / 2,
  };
  const isInside = depth > 0 && place.x >= 0 && place.x <= 1 && place.y >= 0 && place.y <= 1;
  return isInside ? place : null;
}

/**
 * The homography from the window to the picture, for a camera that only turns. For a point (x, y) of the window, each
 * -1 to 1 and y upwards, `matrix * (x, y, 1)` is (s, t, q), and (s / q, t / q) the place in the picture: 0 to 1, t
 * downwards. Nine numbers, column by column, as WebGL takes them.
 *
 * `picture` has width, height, border, yaw, pitch, tanHalfX and tanHalfY of the message Picture. Without a camera, as
 * in the message Frame, only no turn is possible: then the window is the picture's middle.
 */
export function lookMatrix(picture, turn) {
  const inner = windowOf(picture);
  const [shareX, shareY] = [inner.width / picture.width, inner.height / picture.height];
  if (!isTurned(turn)) return [shareX / 2, 0, 0, 0, -shareY / 2, 0, 0.5, 0.5, 1];
  const { tanHalfX, tanHalfY } = picture;
  const from = axes(picture);
  const to = axes({ yaw: picture.yaw + turn.yaw, pitch: picture.pitch + turn.pitch });
  const column = (axis, scale) => {
    const depth = dot(axis, from.forward);
    const across = dot(axis, from.right) / tanHalfX;
    const upwards = dot(axis, from.up) / tanHalfY;
    return [(depth + across) / 2, (depth - upwards) / 2, depth].map((value) => value * scale);
  };
  return [
    ...column(to.right, tanHalfX * shareX),
    ...column(to.up, tanHalfY * shareY),
    ...column(to.forward, 1),
  ];
}

/** Whether a turn (radians) changes the direction. */
export function isTurned({ yaw, pitch }) {
  return yaw !== 0 || pitch !== 0;
}

/** Whether a displacement (metres) moves the eye. */
export function isMoved(displacement) {
  return displacement.some((value) => value !== 0);
}

/** A movement of the eye (metres) in the coordinates of lookMatrix(): s, t and q. */
export function shiftOf(picture, displacement) {
  const from = axes(picture);
  const forwards = dot(displacement, from.forward);
  const across = dot(displacement, from.right) / picture.tanHalfX;
  const upwards = dot(displacement, from.up) / picture.tanHalfY;
  return [(forwards + across) / 2, (forwards - upwards) / 2, forwards];
}

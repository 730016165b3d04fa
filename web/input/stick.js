import { Key } from '../stream/protocol.js';

/** Shares of full deflection: below the first the stick rests, above the second the visitor runs. */
const kDeadZone = 0.25;
const kRunZone = 0.92;
/** The sine of half a sector of eight: beyond it, a direction counts. */
const kSector = Math.sin(Math.PI / 8);

/** The keys for a stick at (x, y); 1 is full deflection, y grows downwards. */
export function stickKeys(x, y) {
  const length = Math.hypot(x, y);
  if (length < kDeadZone) return 0;
  let keys = length > kRunZone ? Key.run : 0;
  if (y < -kSector * length) keys |= Key.forward;
  if (y > kSector * length) keys |= Key.back;
  if (x < -kSector * length) keys |= Key.left;
  if (x > kSector * length) keys |= Key.right;
  return keys;
}

/** Removes the dead zone from one axis: 0 within it, then linear up to 1 or -1. */
export function stickAxis(value) {
  const beyond = Math.abs(value) - kDeadZone;
  return beyond <= 0 ? 0 : (Math.sign(value) * beyond) / (1 - kDeadZone);
}

/**
 * The server's rules of walking, as server/world/players.cpp and server/world/ground/hills.cpp have them: both sides
 * pass tests/world/golden_walking.json. Metres, seconds and radians; y points up.
 */
import { Key } from '../stream/protocol.js';

export const kEyeHeight = 1.7;
const kWalkSpeed = 2.2;
const kRunSpeed = 5;
/** Share per second of the difference to the wanted velocity. */
const kAcceleration = 12;
const kPlayerRadius = 0.35;
/** Rounded as on the server, so that no step of nearly nothing is left of a sixtieth of a second. */
const kLongestStep = Math.fround(1 / 60);
/** Metres before the world's end within which visitors are turned along it. */
const kSoftEnd = 4;
/** Of the speed that would lead out. */
const kTurnedShare = 0.6;
/** Square of the speed below which a visitor stands still. */
const kStill = 1e-5;
const kMiddle = 1e-4;

/** The height of the ground at a place: the sum of the hills there. */
export function groundHeight(hills, x, z) {
  let sum = 0;
  for (const hill of hills) {
    const [awayX, awayZ] = [(x - hill.x) / hill.radius, (z - hill.z) / hill.radius];
    const share = Math.max(1 - awayX * awayX - awayZ * awayZ, 0);
    sum += hill.height * share * share;
  }
  return sum;
}

/** The velocity along x and z for these keys (bits of Key) and this yaw. */
export function wantedVelocity({ keys, yaw }) {
  const held = (key) => ((keys & key) === 0 ? 0 : 1);
  const ahead = held(Key.forward) - held(Key.back);
  const aside = held(Key.right) - held(Key.left);
  if (ahead === 0 && aside === 0) return [0, 0];
  const [sin, cos] = [Math.sin(yaw), Math.cos(yaw)];
  const speed = (keys & Key.run) === 0 ? kWalkSpeed : kRunSpeed;
  const scale = speed / Math.hypot(ahead, aside);
  return [(aside * cos - ahead * sin) * scale, (-ahead * cos - aside * sin) * scale];
}

/**
 * Takes from a velocity what leads out of the world, the more the closer the end is, and turns part of it along the
 * end.
 */
function turnedAlongTheEnd(radius, [x, , z], [velocityX, velocityZ]) {
  const distance = Math.hypot(x, z);
  const share = Math.min(1, (distance - radius) / Math.min(kSoftEnd, radius / 2) + 1);
  if (share <= 0) return [velocityX, velocityZ];
  const [outX, outZ] = [x / distance, z / distance];
  const removed = share * Math.max(0, velocityX * outX + velocityZ * outZ);
  const side = velocityZ * outX - velocityX * outZ < 0 ? -kTurnedShare : kTurnedShare;
  return [velocityX - removed * outX - side * removed * outZ, velocityZ - removed * outZ + side * removed * outX];
}

/** Moves a place out of the obstacles. */
function besideObstacles(obstacles, x, z) {
  for (const obstacle of obstacles) {
    const [awayX, awayZ] = [x - obstacle.x, z - obstacle.z];
    const least = obstacle.radius + kPlayerRadius;
    const square = awayX * awayX + awayZ * awayZ;
    if (square >= least * least) continue;
    const distance = Math.sqrt(square);
    x = obstacle.x + (distance > kMiddle ? (awayX / distance) * least : least);
    z = obstacle.z + (distance > kMiddle ? (awayZ / distance) * least : 0);
  }
  return [x, z];
}

function step(ground, { position, velocity }, input, seconds) {
  const wanted = turnedAlongTheEnd(ground.radius, position, wantedVelocity(input));
  const share = 1 - Math.exp(-kAcceleration * seconds);
  let moving = velocity.map((value, i) => value + (wanted[i] - value) * share);
  if (moving[0] * moving[0] + moving[1] * moving[1] < kStill) moving = [0, 0];
  let [x, z] = besideObstacles(ground.obstacles, position[0] + moving[0] * seconds, position[2] + moving[1] * seconds);
  const inside = Math.min(1, ground.radius / Math.hypot(x, z));
  [x, z] = [x * inside, z * inside];
  return { position: [x, kEyeHeight + groundHeight(ground.hills, x, z), z], velocity: moving };
}

/** Whether a visitor in this state, with these controls, keeps the state. */
export function rests({ velocity }, input) {
  const wanted = wantedVelocity(input);
  return velocity[0] === 0 && velocity[1] === 0 && wanted[0] === 0 && wanted[1] === 0;
}

/**
 * The state after `seconds` with unchanged controls.
 *
 * @param {{radius: number, hills: object[], obstacles: object[]}} ground as the message Ground has it
 * @param {{position: number[], velocity: number[]}} state x, y, z of the eye; velocity along x and z
 * @param {{keys: number, yaw: number}} input
 * @param {number} seconds
 */
export function walked(ground, state, input, seconds) {
  let now = state;
  for (let left = seconds; left > 0; left -= kLongestStep) {
    now = step(ground, now, input, Math.min(left, kLongestStep));
  }
  return now;
}

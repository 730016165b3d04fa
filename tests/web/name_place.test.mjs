import assert from 'node:assert/strict';
import { test } from 'node:test';

import { windowPlace } from '../../web/picture/look_geometry.js';
import { namePlace } from '../../web/picture/name_place.js';

const kWalker = { left: 600, top: 200, right: 700, bottom: 600, nearest: 1.8, farthest: 2.2, velocity: [1.5, 0, 0] };
const kPicture = {
  width: 1280, height: 720, border: 0, yaw: 0, pitch: 0, tanHalfX: 1, tanHalfY: 0.5625,
  space: { moving: [kWalker] }, depths: { at: () => 0.1 },
};
/** Above the walker's head. */
const kName = { x: 650 / 1280, y: 190 / 720 };
const kView = { turn: { yaw: 0, pitch: 0 }, displacement: [0, 0, 0], elapsed: 100 };

// Fault: a name that jumps to and fro above a figure that moves smoothly.
test('a name walks with its visitor', () => {
  const { x, y } = namePlace(kPicture, kView, kName);
  assert.ok(Math.abs(x - (kName.x + 0.15 / 2 / 2)) < 1e-6);
  assert.ok(Math.abs(y - kName.y) < 1e-6);
  const along = namePlace(kPicture, { ...kView, displacement: [0.15, 0, 0] }, kName);
  assert.ok(Math.abs(along.x - kName.x) < 1e-6, 'as seen by one who walks along');
});

// Faults: names of those who stand move with a walker; a picture without depths has no names.
test('other names stay at their surface', () => {
  for (const name of [{ x: 0.2, y: kName.y }, { x: kName.x, y: 0.02 }, { x: kName.x, y: 0.95 }]) {
    const view = { ...kView, displacement: [0.2, 0, 0] };
    assert.deepEqual(namePlace(kPicture, view, name), windowPlace(kPicture, view, name, 0.1));
  }
  const plain = { ...kPicture, space: null, depths: undefined };
  assert.deepEqual(namePlace(plain, { ...kView, elapsed: 0 }, kName), windowPlace(plain, kView, kName));
});

import assert from 'node:assert/strict';
import { readFileSync } from 'node:fs';
import { test } from 'node:test';

import { rests, walked, wantedVelocity } from '../../web/walk/walking.js';

const walks = JSON.parse(readFileSync(new URL('../world/golden_walking.json', import.meta.url), 'utf8'));
const kPrecision = 1e-4;

/** As tests/world/golden_walking_test.cpp: inputs and positions divide the steps. */
function positionsOf(walk) {
  const inputs = [...walk.inputs];
  let input = { keys: 0, yaw: 0 };
  let state = { position: walk.start, velocity: [0, 0] };
  let time = 0;
  const advance = (seconds) => {
    state = walked(walk, state, input, seconds - time);
    time = seconds;
  };
  return walk.positions.map(({ seconds }) => {
    while (inputs.length > 0 && inputs[0].seconds <= seconds) {
      advance(inputs[0].seconds);
      input = inputs.shift();
    }
    advance(seconds);
    return state.position;
  });
}

// Fault: a page that walks by other rules than its server, so that every picture corrects it.
for (const walk of walks) {
  test(`a visitor ${walk.name}, as on the server`, () => {
    positionsOf(walk).forEach((position, i) => {
      const { seconds, position: expected } = walk.positions[i];
      const distance = Math.hypot(...position.map((value, axis) => value - expected[axis]));
      assert.ok(distance < kPrecision, `${position} is not ${expected} at ${seconds}`);
    });
  });
}

// Fault: a visitor who stands still is walked on, which keeps a page busy for ever.
test('comes to rest after the keys', () => {
  const ground = { radius: 30, hills: [], obstacles: [] };
  const still = { keys: 0, yaw: 0 };
  const start = { position: [0, 1.7, 0], velocity: [2, 0] };
  assert.equal(rests(start, still), false);
  const end = walked(ground, start, still, 1);
  assert.equal(rests(end, still), true);
  assert.equal(rests(end, { keys: 1, yaw: 0 }), false);
  assert.deepEqual(walked(ground, end, still, 0.1), end);
  assert.deepEqual(wantedVelocity({ keys: 3 | 16, yaw: 1 }), [0, 0]);
});

import assert from 'node:assert/strict';
import { test } from 'node:test';

import { coverPlace, liftsOf } from '../../web/panels/name_layout.js';

const box = (x, y, width = 60, height = 20) => ({ x, y, width, height });

test('names with room do not move', () => {
  assert.deepEqual(liftsOf([box(100, 50), box(200, 50), box(100, 90)]), [0, 0, 0]);
});

test('of two overlapping names, the farther moves up', () => {
  const [near, far] = liftsOf([box(100, 50), box(120, 48)]);
  assert.equal(near, 0);
  assert.equal(48 - far, 50 - 20 - 3);
});

// Fault: a name that is moved out of one and into another.
test('names of a crowd do not overlap, and those without room are hidden', () => {
  const crowd = Array.from({ length: 24 }, (_, i) => box(100 + 25 * (i % 5), 80 + (i % 7), 50 + (i % 3) * 10));
  const lifts = liftsOf(crowd);
  const shown = crowd.map((each, i) => ({ ...each, y: each.y - lifts[i] })).filter((_, i) => lifts[i] !== null);
  assert.equal(lifts[0], 0, 'the nearest is where it belongs');
  assert.ok(shown.length >= 4 && shown.length < 24, `${shown.length} are shown`);
  for (const a of shown) {
    for (const b of shown) {
      const apart = Math.abs(a.x - b.x) >= (a.width + b.width) / 2 || Math.abs(a.y - b.y) >= 20;
      assert.ok(a === b || apart, `${JSON.stringify(a)} overlaps ${JSON.stringify(b)}`);
    }
  }
  for (const lift of lifts) assert.ok(lift === null || (lift >= 0 && lift <= 60), `moved by ${lift}`);
});

test('a covering picture is cropped at two sides', () => {
  const picture = { width: 640, height: 360 };
  assert.deepEqual(coverPlace({ x: 0, y: 0 }, picture, { width: 1280, height: 720 }), { x: 0, y: 0 });
  assert.deepEqual(coverPlace({ x: 1, y: 1 }, picture, { width: 720, height: 720 }), { x: 1000, y: 720 });
  assert.deepEqual(coverPlace({ x: 0.5, y: 0 }, picture, { width: 640, height: 180 }), { x: 320, y: -90 });
});

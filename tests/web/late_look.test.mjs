import assert from 'node:assert/strict';
import { test } from 'node:test';

import { DepthGrid, cellsOf } from '../../web/picture/depth_grid.js';
import { LateLook } from '../../web/picture/late_look.js';
import { fakeGl } from './fake_gl.mjs';

const kPicture = { width: 704, height: 396, border: 10, yaw: 1, pitch: 0, tanHalfX: 1.1, tanHalfY: 0.61875 };
const kTurn = { yaw: 0.2, pitch: 0 };
const kStep = [0.2, 0, 0];

function withDepths(picture) {
  const { columns, rows } = cellsOf(picture);
  return { ...picture, depths: new DepthGrid(picture, new Float32Array(columns * rows).fill(0.25)) };
}

function setUp() {
  const { log, gl } = fakeGl();
  const listeners = {};
  const canvas = {
    width: 16,
    height: 9,
    getContext: () => gl,
    addEventListener: (name, listener) => (listeners[name] = listener),
  };
  return { log, listeners, lateLook: new LateLook(canvas, () => {}) };
}

// Faults: a turn that pays for a mesh; a mesh whose places the matrix of a turn moves again.
test('draws a triangle for a turn, a mesh for a step', () => {
  const { log, lateLook } = setUp();
  assert.equal(lateLook.isReady, true);
  const picture = withDepths(kPicture);
  lateLook.take({}, picture);
  lateLook.seen(picture, { turn: kTurn, displacement: [0, 0, 0], elapsed: 0 });
  lateLook.seen(picture, { turn: kTurn, displacement: kStep, elapsed: 0 });
  lateLook.seen(picture, { turn: kTurn, displacement: [0, 0, 0], elapsed: 0 });
  const [turned, moved, again] = log;
  assert.equal(turned.triangle, 3);
  assert.equal(turned.places, turned.corners);
  const [across, down] = [640 / 16 + 1, Math.ceil(360 / 16) + 1];
  const corners = 2 * across * down;
  const indices = 6 * (across - 1) * (down - 1);
  assert.deepEqual(moved, { indices, of: indices, places: corners, corners, look: '1,0,0,0,1,0,0,0,1' });
  assert.deepEqual(again, turned, 'and back');
});

// Fault: a window that grew is drawn with the mesh of the former one.
test('pictures of another size get another mesh', () => {
  const { log, lateLook } = setUp();
  for (const width of [704, 1408, 704]) {
    lateLook.seen(withDepths({ ...kPicture, width }), { turn: kTurn, displacement: kStep, elapsed: 0 });
  }
  assert.deepEqual(log.map(({ indices, of }) => indices === of), [true, true, true]);
  assert.ok(log[1].indices > 1.9 * log[0].indices);
  assert.equal(log[2].indices, log[0].indices);
});

// Fault: a mesh in buffers of a context that is lost.
test('a restored context gets new buffers', () => {
  const { log, listeners, lateLook } = setUp();
  const picture = withDepths(kPicture);
  const view = { turn: kTurn, displacement: kStep, elapsed: 0 };
  lateLook.seen(picture, view);
  listeners.webglcontextlost({ preventDefault() {} });
  assert.equal(lateLook.isReady, false);
  listeners.webglcontextrestored();
  assert.equal(lateLook.isReady, true);
  lateLook.seen(picture, view);
  assert.deepEqual(log[1], log[0]);
  lateLook.seen(picture, { ...view, displacement: [0, 0, 0] });
  assert.ok(log[2].places.id > 4, 'none of the former ones');
});

import assert from 'node:assert/strict';
import { test } from 'node:test';

import { lookMatrix, turnOf, windowOf, windowPlace } from '../../web/picture/look_geometry.js';

const kPicture = { width: 704, height: 396, border: 10, yaw: 0.7, pitch: -0.3, tanHalfX: 1.1, tanHalfY: 0.61875 };
const kNowhere = [0, 0, 0];

/** Where in the picture (0 to 1, downwards) the window's point (-1 to 1, upwards) is. */
function placeOf(matrix, [x, y]) {
  const at = (row) => matrix[row] * x + matrix[3 + row] * y + matrix[6 + row];
  return [at(0) / at(2), at(1) / at(2)];
}

function near(actual, expected, slack = 1e-9) {
  actual.forEach((value, i) => assert.ok(Math.abs(value - expected[i]) < slack, `${actual} is not ${expected}`));
}

test('the window is the middle of the picture, pixel on pixel', () => {
  assert.deepEqual(windowOf(kPicture), { width: 640, height: 360 });
  assert.deepEqual(windowOf({ width: 640, height: 360 }), { width: 640, height: 360 });
  for (let width = 160; width < 2200; width += 7) {
    for (const border of [0, 1, 8, 10, 25, 255]) {
      const inner = windowOf({ width, height: width, border }).width;
      assert.equal((width - inner) % 2, 0);
      const rest = inner - width / (1 + border / 100);
      assert.ok(rest > -1e-3 && rest < 2, `${width} with ${border} %`);
    }
  }
  // As the server makes them: even, rounded down.
  for (let width = 160; width < 1900; width += 2) {
    for (const border of [6, 12]) {
      const whole = 2 * Math.floor((width * (1 + border / 100)) / 2);
      assert.equal(windowOf({ width: whole, height: whole, border }).width, width, `${width} with ${border} %`);
    }
  }
});

test('at rest, the window shows the centre', () => {
  const matrix = lookMatrix(kPicture, { yaw: 0, pitch: 0 });
  near(placeOf(matrix, [0, 0]), [0.5, 0.5]);
  near(placeOf(matrix, [-1, 1]), [32 / 704, 18 / 396]);
  near(placeOf(matrix, [1, -1]), [1 - 32 / 704, 1 - 18 / 396]);
  near(placeOf(lookMatrix({ width: 640, height: 360 }, { yaw: 0, pitch: 0 }), [-1, 1]), [0, 0]);
});

test('a small turn is nearly the identity', () => {
  const still = lookMatrix(kPicture, { yaw: 0, pitch: 0 });
  const turned = lookMatrix(kPicture, { yaw: 1e-7, pitch: 1e-7 });
  for (const corner of [[-1, -1], [1, -1], [0.3, 0.9]]) near(placeOf(turned, corner), placeOf(still, corner), 1e-6);
});

test('the centre of the window is the new view direction', () => {
  // To the left by 0.2 on a level look: tan(0.2) of the picture's plane, to its left.
  const level = { ...kPicture, pitch: 0 };
  near(placeOf(lookMatrix(level, { yaw: 0.2, pitch: 0 }), [0, 0]), [0.5 - Math.tan(0.2) / 1.1 / 2, 0.5]);
  // Up by 0.1, from whatever pitch.
  const up = lookMatrix(kPicture, { yaw: 0, pitch: 0.1 });
  near(placeOf(up, [0, 0]), [0.5, 0.5 - Math.tan(0.1) / 0.61875 / 2]);
});

test('a point of the world keeps its place while the view turns', () => {
  // As server/world/camera.cpp: forward, right and up of a pose, and the ray through a point of the image.
  const axes = (yaw, pitch) => {
    const forward = [-Math.sin(yaw) * Math.cos(pitch), Math.sin(pitch), -Math.cos(yaw) * Math.cos(pitch)];
    const right = [Math.cos(yaw), 0, -Math.sin(yaw)];
    const cross = (a, b) => [0, 1, 2].map((i) => a[(i + 1) % 3] * b[(i + 2) % 3] - a[(i + 2) % 3] * b[(i + 1) % 3]);
    return { forward, right, up: cross(right, forward) };
  };
  const dot = (a, b) => a.reduce((sum, value, i) => sum + value * b[i], 0);
  const turn = { yaw: -0.25, pitch: 0.17 };
  const matrix = lookMatrix(kPicture, turn);
  const [from, to] = [axes(0.7, -0.3), axes(0.45, -0.13)];
  for (const [x, y] of [[0, 0], [-1, 1], [1, 1], [0.4, -0.8]]) {
    const ray = [0, 1, 2].map(
      (i) => to.forward[i] + (x * 1.1 * 640 * to.right[i]) / 704 + (y * 0.61875 * 360 * to.up[i]) / 396,
    );
    const depth = dot(ray, from.forward);
    const expected = [
      0.5 + dot(ray, from.right) / depth / 1.1 / 2,
      0.5 - dot(ray, from.up) / depth / 0.61875 / 2,
    ];
    near(placeOf(matrix, [x, y]), expected);
  }
});

test('picture and window coordinates agree', () => {
  for (const turn of [{ yaw: 0, pitch: 0 }, { yaw: -0.25, pitch: 0.17 }, { yaw: 0.3, pitch: 0 }]) {
    const matrix = lookMatrix(kPicture, turn);
    for (const [x, y] of [[0, 0], [-0.9, 0.8], [0.4, -0.95]]) {
      const [s, t] = placeOf(matrix, [x, y]);
      const place = windowPlace(kPicture, { turn, displacement: kNowhere }, { x: s, y: t });
      near([place.x, place.y], [(1 + x) / 2, (1 - y) / 2]);
    }
  }
  const still = { yaw: 0, pitch: 0 };
  assert.equal(windowPlace(kPicture, { turn: still, displacement: kNowhere }, { x: 0.01, y: 0.5 }), null, 'in the border');
  const behind = { yaw: Math.PI, pitch: 0 };
  assert.equal(windowPlace({ ...kPicture, pitch: 0 }, { turn: behind, displacement: kNowhere }, { x: 0.5, y: 0.5 }), null, 'behind');
});

test('turns the short way, within the picture', () => {
  const picture = { ...kPicture, yaw: 3.1 };
  near(Object.values(turnOf(picture, { yaw: -3.1, pitch: -0.3 })), [2 * Math.PI - 6.2, 0]);
  const far = turnOf(picture, { yaw: 1, pitch: 1.5 });
  near(Object.values(far), [-0.8 * Math.atan(1.1), 0.8 * Math.atan(0.61875)]);
});

test('rounding to 32 bits does not turn the view', () => {
  assert.deepEqual(turnOf(kPicture, { yaw: Math.fround(0.7), pitch: -0.3 }), { yaw: 0, pitch: 0 });
});

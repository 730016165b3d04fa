import assert from 'node:assert/strict';
import { readFileSync } from 'node:fs';
import { test } from 'node:test';

import { DepthGrid, cellsOf, kCell } from '../../web/picture/depth_grid.js';
import { lookMatrix, windowOf, windowPlace } from '../../web/picture/look_geometry.js';
import { WarpMesh } from '../../web/picture/warp_mesh.js';

const kPicture = { width: 1408, height: 792, border: 10, yaw: 0.7, pitch: -0.3, tanHalfX: 1.1, tanHalfY: 0.61875 };
const kNoTurn = { yaw: 0, pitch: 0 };

const dot = (a, b) => a.reduce((sum, value, i) => sum + value * b[i], 0);
const plus = (a, b, scale = 1) => a.map((value, i) => value + scale * b[i]);

/** As server/world/camera.cpp. */
function axesOf({ yaw, pitch }) {
  const forward = [-Math.sin(yaw) * Math.cos(pitch), Math.sin(pitch), -Math.cos(yaw) * Math.cos(pitch)];
  const right = [Math.cos(yaw), 0, -Math.sin(yaw)];
  const cross = (a, b) => [0, 1, 2].map((i) => a[(i + 1) % 3] * b[(i + 2) % 3] - a[(i + 2) % 3] * b[(i + 1) % 3]);
  return { forward, right, up: cross(right, forward) };
}

/** The ray through a point of the picture (shares, downwards), one metre deep. */
function rayOf(picture, s, t) {
  const { forward, right, up } = axesOf(picture);
  return plus(plus(forward, right, (2 * s - 1) * picture.tanHalfX), up, (1 - 2 * t) * picture.tanHalfY);
}

/** Where a point, relative to the picture's eye, is in the picture. */
function project(picture, point) {
  const { forward, right, up } = axesOf(picture);
  const depth = dot(point, forward);
  return [0.5 + dot(point, right) / depth / picture.tanHalfX / 2, 0.5 - dot(point, up) / depth / picture.tanHalfY / 2];
}

/** The ray of the window's camera through a corner of the mesh. */
function windowRay(picture, turn, [x, y]) {
  const { width, height } = windowOf(picture);
  const turned = { ...picture, yaw: picture.yaw + turn.yaw, pitch: picture.pitch + turn.pitch };
  return rayOf(turned, 0.5 + (x * width) / picture.width / 2, 0.5 - (y * height) / picture.height / 2);
}

/** A grid of the nearness that `nearnessAt(s, t)` returns for the centres of cells. */
function gridOf(picture, nearnessAt) {
  const { columns, rows } = cellsOf(picture);
  const place = (index, side) => ((index + 0.5) * kCell) / side;
  const values = Array.from({ length: columns * rows }, (_, i) =>
    nearnessAt(place(i % columns, picture.width), place(Math.floor(i / columns), picture.height)),
  );
  return new DepthGrid(picture, Float32Array.from(values));
}

/** The corners of a bent mesh: their positions in the window, and their places in the picture. */
function bend(picture, depths, view) {
  const mesh = new WarpMesh(picture);
  mesh.bend(picture, depths, { elapsed: 0, ...view });
  return Array.from({ length: mesh.corners.length / 2 }, (_, i) => ({
    corner: [mesh.corners[2 * i], mesh.corners[2 * i + 1]],
    place: [mesh.places[2 * i], mesh.places[2 * i + 1]],
  }));
}

const pixelsBetween = (picture, a, b) => Math.hypot((a[0] - b[0]) * picture.width, (a[1] - b[1]) * picture.height);

// Fault: cells that are not of 16 pixels, or a window with a strip that no triangle covers.
test('covers the window with cells of 16 pixels', () => {
  const picture = { width: 200, height: 100, border: 10 };
  const { width, height } = windowOf(picture);
  const mesh = new WarpMesh(picture);
  const [across, down] = [Math.ceil(width / 16) + 1, Math.ceil(height / 16) + 1];
  assert.equal(mesh.corners.length, 2 * across * down);
  assert.ok(Math.abs(((mesh.corners[2] + 1) / 2) * width - 16) < 1e-3);
  assert.deepEqual([...mesh.corners.slice(0, 2), ...mesh.corners.slice(-2)], [-1, 1, 1, -1]);
  const corner = (i) => [mesh.corners[2 * i], mesh.corners[2 * i + 1]];
  let area = 0;
  for (let i = 0; i < mesh.indices.length; i += 3) {
    const [a, b, c] = [...mesh.indices.slice(i, i + 3)].map(corner);
    area += Math.abs((b[0] - a[0]) * (c[1] - a[1]) - (c[0] - a[0]) * (b[1] - a[1])) / 2;
  }
  assert.ok(Math.abs(area - 4) < 1e-4, `triangles cover ${area} of 4`);
});

// Fault: a picture that jumps when the first step replaces the homography.
test('without a step, it is the homography of a turn', () => {
  const depths = gridOf(kPicture, (s, t) => 0.2 * s + 0.3 * t);
  for (const turn of [kNoTurn, { yaw: 0.3, pitch: -0.1 }, { yaw: -0.02, pitch: 0.2 }]) {
    const matrix = lookMatrix(kPicture, turn);
    for (const { corner: [x, y], place } of bend(kPicture, depths, { turn, displacement: [0, 0, 0] })) {
      const at = (row) => matrix[row] * x + matrix[3 + row] * y + matrix[6 + row];
      assert.ok(pixelsBetween(kPicture, place, [at(0) / at(2), at(1) / at(2)]) < 2e-3);
    }
  }
});

for (const turn of [kNoTurn, { yaw: 0.15, pitch: -0.1 }]) {
  const displacement = [0.4, 0.1, -0.5];

  // Fault: a step in a wrong direction, or of a wrong length.
  test(`a wall three metres deep moves as seen from the new eye, turned by ${turn.yaw}`, () => {
    const depths = gridOf(kPicture, () => 1 / 3);
    for (const { corner, place } of bend(kPicture, depths, { turn, displacement })) {
      const ray = windowRay(kPicture, turn, corner);
      const { forward } = axesOf(kPicture);
      const along = (3 - dot(displacement, forward)) / dot(ray, forward);
      const expected = project(kPicture, plus(displacement, ray, along));
      assert.ok(pixelsBetween(kPicture, place, expected) < 0.01, `${place} is not ${expected}`);
    }
  });

  // Fault: a search for surfaces that stops too early, so that the ground swims under the visitor's feet.
  test(`the ground moves as seen from the new eye, turned by ${turn.yaw}`, () => {
    const nearnessAt = (s, t) => Math.max(0, -rayOf(kPicture, s, t)[1] / 1.7);
    const depths = gridOf(kPicture, nearnessAt);
    let compared = 0;
    for (const { corner, place } of bend(kPicture, depths, { turn, displacement })) {
      const ray = windowRay(kPicture, turn, corner);
      const expected = project(kPicture, plus(displacement, ray, (-1.7 - displacement[1]) / ray[1]));
      // Well below the horizon, and within the grid's outermost centres.
      const isGround = ray[1] < -0.1 && expected[0] > 0.02 && expected[0] < 0.98 && expected[1] > 0.1 && expected[1] < 0.98;
      if (!isGround) continue;
      compared += 1;
      assert.ok(pixelsBetween(kPicture, place, expected) < 0.5, `${place} is not ${expected}`);
    }
    assert.ok(compared > 1500);
  });
}

// Fault: the sky moves with the visitor.
test('what is infinitely far only turns', () => {
  const depths = gridOf(kPicture, () => 0);
  const still = bend(kPicture, depths, { turn: kNoTurn, displacement: [0, 0, 0] });
  const moved = bend(kPicture, depths, { turn: kNoTurn, displacement: [0.5, 0, 0.5] });
  assert.deepEqual(moved, still);
});

// Fault: silhouettes that move with what is behind them, which cuts the nearer thing's edge.
test('a silhouette moves with the nearer surface', () => {
  const picture = { ...kPicture, yaw: 0, pitch: 0 };
  // The search goes downwards, so what begins at the top, as trunks do, is found on both sides.
  const isNear = (s, t) => s > 0.4 && s < 0.6 && t < 0.7;
  const depths = gridOf(picture, (s, t) => (isNear(s, t) ? 0.5 : 0.05));
  const step = 0.2;
  const way = step / picture.tanHalfX / 2;
  const halfCell = [kCell / 2 / picture.width, kCell / 2 / picture.height];
  let compared = 0;
  for (const { corner, place } of bend(picture, depths, { turn: kNoTurn, displacement: [step, 0, 0] })) {
    const far = project(picture, windowRay(picture, kNoTurn, corner));
    const near = [far[0] + 0.5 * way, far[1]];
    const isThing = [-1, 1].every((side) => isNear(near[0] + side * halfCell[0], near[1] + side * halfCell[1]));
    const isBeside = [-1, 1].some((side) => isNear(near[0] + side * halfCell[0], near[1]));
    if (!isThing && !isBeside) continue;
    compared += 1;
    assert.ok(pixelsBetween(picture, place, near) < 0.01, `${place} is not ${near}`);
  }
  assert.ok(compared > 300);
});

/** Somebody two metres deep, who walks to the right before a wall at twenty metres, 1.4 m/s. */
const kWalker = { left: 640, top: 200, right: 768, bottom: 792, nearest: 1.8, farthest: 2.2, velocity: [1.4, 0, 0] };

/** The corners of a mesh after `elapsed` milliseconds; `hides`: something nearer hides the walker. */
function bendWalker(elapsed, { displacement = [0, 0, 0], hides = false, ...changes } = {}) {
  const picture = { ...kPicture, yaw: 0, pitch: 0, space: { moving: [{ ...kWalker, ...changes }] } };
  const isWalker = (s, t) => s * picture.width > 640 && s * picture.width < 768 && t * picture.height > 200;
  const depths = gridOf(picture, (s, t) => (isWalker(s, t) ? (hides ? 1 : 0.5) : 0.05));
  const corners = bend(picture, depths, { turn: kNoTurn, displacement, elapsed });
  return corners.map(({ corner, place: [s, t] }) => {
    const far = project(picture, windowRay(picture, kNoTurn, corner));
    return { at: far[0] * picture.width, y: far[1] * picture.height, source: s * picture.width, down: t * picture.height };
  });
}

/** Pixels that 1.4 m/s are in 100 ms, two metres away. */
const kWay = (0.14 / 2 / kPicture.tanHalfX / 2) * kPicture.width;

// Faults: others who stand still between two pictures; a second copy of them where they were.
test('somebody who walks goes on', () => {
  let walker = 0;
  for (const { at, y, source, down } of bendWalker(100)) {
    if (y < 232) continue;
    // Where the walker is or was, with the cell beside them that has their depth.
    if (at > 624 && at < 784 + kWay) {
      walker += 1;
      assert.ok(Math.abs(source - (at - kWay)) < 0.01, `${source} at ${at}`);
    } else if (at < 608 - 16 || at > 800 + 16 + kWay) {
      assert.ok(Math.abs(source - at) < 0.01, `the wall stays: ${source} at ${at}`);
    }
    assert.ok(Math.abs(down - y) < 0.01);
  }
  assert.ok(walker > 300);
});

// Fault: a walker is moved twice, once with the visitor and once by themselves.
test('a visitor who walks along sees a walker stay', () => {
  for (const { at, y, source } of bendWalker(100, { displacement: [0.14, 0, 0] })) {
    if (y > 232 && at > 656 && at < 752) assert.ok(Math.abs(source - at) < 0.01, `${source} at ${at}`);
  }
});

// Faults: what hides a walker moves with them; at once, the picture is another one.
test('only the walker moves, and not at once', () => {
  for (const [elapsed, changes] of [[100, { hides: true }], [0, {}], [100, { velocity: [0, 0, 0] }]]) {
    for (const { at, source } of bendWalker(elapsed, changes)) assert.ok(Math.abs(source - at) < 0.01);
  }
});

// Fault: a slope counts as a row of silhouettes, so that a floor moves as what is before it.
test('only silhouettes are spread', () => {
  const nearnessAt = (s, t) => 0.2 * s + 0.3 * t;
  const depths = gridOf(kPicture, nearnessAt);
  const [column, row] = [5, 20];
  const centre = [((column + 0.5) * kCell) / kPicture.width, ((row + 0.5) * kCell) / kPicture.height];
  assert.ok(Math.abs(depths.nearness[row * depths.columns + column] - nearnessAt(...centre)) < 1e-6);
  for (const place of [[0.5, 0.4], [0.123, 0.777]]) assert.ok(Math.abs(depths.at(...place) - nearnessAt(...place)) < 1e-6);
  assert.equal(depths.at(-3, 0.4), depths.at(0, 0.4), 'the edge continues');
  assert.equal(depths.at(0.3, 9), depths.at(0.3, 1));
});

// Fault: names that stay where the picture had them while a figure moves.
test('a name stays at its surface', () => {
  const displacement = [0.3, 0, -0.4];
  const turn = { yaw: 0.1, pitch: -0.05 };
  const depths = gridOf(kPicture, () => 0.25);
  for (const { corner: [x, y], place: [s, t] } of bend(kPicture, depths, { turn, displacement })) {
    const place = windowPlace(kPicture, { turn, displacement }, { x: s, y: t }, depths.at(s, t));
    if (place === null) continue; // corners at the window's edge
    assert.ok(Math.hypot(place.x - (1 + x) / 2, place.y - (1 - y) / 2) < 1e-5);
  }
});

// Fault: another warp than the one that `grove bench warp` measures, whose test reads the same file.
for (const { name, picture, turn, displacement, grid, places } of JSON.parse(
  readFileSync(new URL('../cli/bench/warp/golden_meshes.json', import.meta.url), 'utf8'),
)) {
  test(`bends the golden mesh ${name}`, () => {
    const nearness = Float32Array.from(grid, (value) => value / 64);
    const mesh = new WarpMesh(picture);
    mesh.bend(picture, new DepthGrid(picture, nearness), { turn, displacement, elapsed: 0 });
    assert.equal(mesh.places.length, places.length);
    mesh.places.forEach((place, i) => assert.ok(Math.abs(place - places[i]) < 1e-4, `place ${i}: ${place}, not ${places[i]}`));
  });
}

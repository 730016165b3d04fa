import assert from 'node:assert/strict';
import { test } from 'node:test';

import { Prediction } from '../../web/walk/prediction.js';
import { kEyeHeight, walked } from '../../web/walk/walking.js';

const kFrame = 1000 / 60;
const kGround = {
  radius: 30,
  hills: [{ x: 0, z: -4, radius: 6, height: 1.2 }],
  obstacles: [{ x: 0.3, z: -3, radius: 0.6 }, { x: 20, z: 20, radius: 1 }],
};
const kFlat = { radius: 100, hills: [], obstacles: [] };
const kForward = 1;
const kRun = 16;

/** Inputs at these frames; the first one is sent on connection. */
const inputsAt = (...rows) =>
  [[0, 0, 0], ...rows].map(([frame, keys, yaw], i) => ({ number: i + 1, keys, yaw, pitch: 0, time: frame * kFrame }));

/** The visitor's state at `now` by inputs that take effect at `timeOf(input)`. */
function stateAt(ground, inputs, timeOf, now) {
  let state = { position: [0, kEyeHeight, 0], velocity: [0, 0] };
  let time = 0;
  let held = { keys: 0, yaw: 0 };
  for (const input of [...inputs, null]) {
    const until = Math.min(now, input ? timeOf(input) : now);
    if (until > time) state = walked(ground, state, held, (until - time) / 1000);
    time = Math.max(time, until);
    if (!input || timeOf(input) > now) break;
    held = input;
  }
  return state;
}

/**
 * A server behind a line: its picture of the camera at `camera`, which the page has at `arrival`. It draws from where the
 * visitor will be after `lead` milliseconds of the same keys.
 */
function pictureOf(ground, inputs, camera, arrival, up, lead) {
  const timeOf = (input) => input.time + up(input.number);
  const last = inputs.findLast((input) => timeOf(input) <= camera);
  const { position, velocity } = stateAt(ground, inputs, timeOf, camera);
  const eye = last ? walked(ground, { position, velocity }, last, lead / 1000).position : position;
  const space = { eye, visitor: position, velocity, sinceInput: camera - (last ? timeOf(last) : 0), moving: [] };
  return { camera, arrival, lastInput: last?.number ?? 0, space };
}

/**
 * Plays a walk of `frames` frames over a line with a round trip of 150 ms, a picture for every second of them. Returns
 * what each frame shows: the predicted eye, and the eye by the visitor's own time.
 */
function play({ ground = kGround, inputs, frames, up = () => 75, down = () => 75, hasPicture = () => true, lead = 0 }) {
  const prediction = new Prediction();
  prediction.setGround(ground);
  const pictures = [];
  for (let i = 0; i < frames; i += 2) {
    const camera = i * kFrame;
    if (hasPicture(camera)) pictures.push(pictureOf(ground, inputs, camera, camera + down(i), up, lead));
  }
  const waiting = [...inputs];
  const shown = [];
  for (let i = 0; i <= frames; i += 1) {
    const now = i * kFrame;
    while (waiting.length > 0 && waiting[0].time <= now) prediction.inputSent(waiting[0], waiting.shift().time);
    const picture = pictures.findLast(({ arrival }) => arrival <= now);
    if (!picture || picture.lastInput === 0) continue;
    const moved = prediction.moved(picture, now);
    const eye = moved.displacement.map((value, axis) => value + picture.space.eye[axis]);
    const truth = stateAt(ground, inputs, ({ time }) => time, now).position;
    shown.push({ ...moved, now, eye, truth, picture });
  }
  return shown;
}

const distance = (a, b) => Math.hypot(...a.map((value, axis) => value - b[axis]));

const kWalk = inputsAt(
  [20, kForward, 0], [40, kForward, 0.2], [70, kForward | kRun, 0.2], [100, kForward | kRun, -0.9], [130, 8, -0.9], [150, 0, -0.9],
);

// Fault: what is on the screen is as old as the picture, half a metre behind.
test('predicts where a visitor is behind a line of 150 ms', () => {
  const shown = play({ inputs: kWalk, frames: 200 });
  assert.ok(shown.length > 180);
  for (const { now, eye, truth } of shown) assert.ok(distance(eye, truth) < 2e-3, `${eye} is not ${truth} at ${now}`);
  const furthest = Math.max(...shown.map(({ displacement }) => Math.hypot(...displacement)));
  assert.ok(furthest > 0.6, 'the pictures are that far behind');
});

// Fault: every picture makes the view jump by what jitter made wrong, or is followed so slowly that errors add up.
test('corrects a prediction gradually', () => {
  const jitter = (i) => 12 * Math.sin(i * 1.7) + 5 * Math.sin(i * 0.9);
  const repeats = Array.from({ length: 40 }, (_, i) => [20 + 5 * i, kForward, 0.1 * Math.sin(i)]);
  const shown = play({
    ground: kFlat,
    inputs: inputsAt(...repeats),
    frames: 200,
    up: (i) => 90 + jitter(i),
    down: (i) => 70 + jitter(i + 5),
  });
  shown.slice(1).forEach(({ now, eye, truth }, i) => {
    const unlike = eye.map((value, axis) => value - shown[i].eye[axis] - (truth[axis] - shown[i].truth[axis]));
    assert.ok(Math.hypot(...unlike) < 8e-3, `a jump of ${Math.hypot(...unlike)} m at ${now}`);
    assert.ok(distance(eye, truth) < 0.08, `${distance(eye, truth)} m beside the truth at ${now}`);
  });
});

// Fault: a visitor stops at each gap of the line, or walks on for ever without a server.
test('bridges a gap of 300 ms, then stays', () => {
  const inputs = inputsAt([10, kForward, 0]);
  const lost = 60 * kFrame;
  const shown = play({ ground: kFlat, inputs, frames: 160, hasPicture: (camera) => camera <= lost });
  const gapBegins = lost + 75;
  for (const { now, eye, truth } of shown) {
    if (now <= gapBegins + 300) assert.ok(distance(eye, truth) < 2e-3, `at ${now - gapBegins} ms of the gap`);
  }
  const late = shown.filter(({ now }) => now > gapBegins + 400);
  assert.ok(late.length > 20);
  for (const { eye, isMoving, until } of late) {
    assert.ok(distance(eye, late[0].eye) < 1e-6);
    assert.equal(isMoving, false, 'nothing keeps the page painting');
    assert.ok(until <= gapBegins + 360, 'later inputs are not on the screen');
  }
});

// Fault: after a gap the view jumps.
test('returns from a gap without a jump', () => {
  const shown = play({
    ground: kFlat,
    inputs: inputsAt([10, kForward, 0]),
    frames: 160,
    hasPicture: (camera) => camera <= 1000 || camera > 1500,
  });
  shown.slice(1).forEach(({ now, eye }, i) => {
    assert.ok(distance(eye, shown[i].eye) < 0.13, `a jump of ${distance(eye, shown[i].eye)} m at ${now}`);
  });
  const last = shown.at(-1);
  assert.ok(distance(last.eye, last.truth) < 2e-3);
});

// Fault: an old picture of a still world counts as a gap, and the first step waits for the server.
test('a visitor who stood still for long walks at once', () => {
  const inputs = inputsAt([600, kForward, 0]);
  const shown = play({ ground: kFlat, inputs, frames: 612, hasPicture: (camera) => camera < 200 });
  const { time } = inputs[1];
  assert.ok(shown.filter(({ now }) => now < time).every(({ isMoving }) => !isMoving));
  const first = shown.find(({ now, displacement }) => now > time && displacement.some((value) => value !== 0));
  assert.ok(first.now - time <= 2 * kFrame, `after ${first.now - time} ms`);
  assert.ok(first.until > time, 'the input is on the screen');
  assert.ok(distance(shown.at(-1).eye, shown.at(-1).truth) < 2e-3);
});

// Faults: a picture from ahead of the visitor is moved as if it were from where they were; it is moved farther than needed.
test('moves a picture that was drawn ahead by the rest only', () => {
  const shown = play({ inputs: kWalk, frames: 200, lead: 140 });
  for (const { now, eye, truth } of shown) assert.ok(distance(eye, truth) < 2e-3, `${eye} is not ${truth} at ${now}`);
  const ways = shown.map(({ displacement }) => Math.hypot(...displacement)).sort((a, b) => a - b);
  assert.ok(ways[ways.length >> 1] < 0.1, `half of the pictures are moved by ${ways[ways.length >> 1]} m`);
});

// Fault: a visitor at rest sees a picture that is bent by a thousandth of a pixel, and blurred; and a page that never rests.
test('at rest, the picture stays as it is', () => {
  const shown = play({ inputs: kWalk, frames: 260 });
  const { displacement, isMoving } = shown.at(-1);
  assert.deepEqual([displacement, isMoving], [[0, 0, 0], false]);
});

function standing() {
  const prediction = new Prediction();
  prediction.setGround(kFlat);
  prediction.inputSent({ number: 1, keys: kForward, yaw: 0 }, 0);
  const space = (z, sinceInput) => ({ eye: [0, kEyeHeight, z], visitor: [0, kEyeHeight, z], velocity: [0, -2.2], sinceInput, moving: [] });
  return { prediction, space };
}

// Fault: a visitor whom the server has put elsewhere slides there through everything.
test('a teleport is shown at once', () => {
  const { prediction, space } = standing();
  prediction.moved({ space: space(0, 100), lastInput: 1 }, 200);
  const there = { space: space(-40, 150), lastInput: 1 };
  const { displacement } = prediction.moved(there, 216);
  assert.ok(Math.abs(displacement[2] + 2.2 * 0.066) < 1e-3, `${displacement}`);
});

// Faults: a walk by inputs of a former connection, or from a picture whose place in time nobody knows.
test('pictures of unknown inputs, without a space or without a ground stay', () => {
  const { prediction, space } = standing();
  const rest = { displacement: [0, 0, 0], elapsed: 0, until: -Infinity, isMoving: false };
  assert.deepEqual(prediction.moved({ space: space(0, 100), lastInput: 0 }, 200), rest);
  assert.deepEqual(prediction.moved({ space: space(0, 100), lastInput: 7 }, 200), rest);
  assert.deepEqual(prediction.moved({ space: null, lastInput: 1 }, 200), rest);
  assert.notDeepEqual(prediction.moved({ space: space(0, 100), lastInput: 1 }, 200), rest);
  prediction.reset();
  prediction.inputSent({ number: 1, keys: kForward, yaw: 0 }, 300);
  assert.deepEqual(prediction.moved({ space: space(0, 100), lastInput: 1 }, 400), rest);
});

// Faults: others who stop between two pictures, or walk on for ever when no more come; a page that paints for nothing.
test('others go on from picture to picture, for a tenth of a second', () => {
  const { prediction, space } = standing();
  const stays = { ...space(0, 100), velocity: [0, 0], moving: [{}] };
  for (const lastInput of [1, 7]) {
    const picture = { space: { ...stays }, lastInput };
    assert.deepEqual([0, 16, 99, 100, 3000].map((later) => prediction.moved(picture, 200 + later).elapsed), [0, 16, 99, 100, 100]);
    assert.equal(prediction.moved({ space: { ...stays }, lastInput }, 250).elapsed, 0, 'from another picture');
  }
  const unknown = { space: stays, lastInput: 7 };
  assert.deepEqual([200, 299, 300].map((now) => prediction.moved(unknown, now).isMoving), [true, true, false]);
  const alone = { space: { ...stays, moving: [] }, lastInput: 7 };
  assert.deepEqual([200, 250].map((now) => prediction.moved(alone, now).elapsed), [0, 0]);
});

// Fault: a page that remembers every input of a visitor in a still world.
test('remembers a bounded number of inputs, and the one of the picture', () => {
  const { prediction, space } = standing();
  const picture = { space: { ...space(0, 0), velocity: [0, 0] }, lastInput: 2 };
  prediction.inputSent({ number: 2, keys: 0, yaw: 0 }, 10);
  prediction.moved(picture, 20);
  for (let number = 3; number < 3000; number += 1) prediction.inputSent({ number, keys: 0, yaw: 0 }, number * 10);
  prediction.inputSent({ number: 3000, keys: kForward, yaw: 0 }, 30_000);
  assert.ok(prediction.moved(picture, 30_100).displacement[2] < -0.05);
  const next = { ...picture, space: { ...picture.space, sinceInput: 30_000 } };
  assert.ok(prediction.moved(next, 30_100).displacement[2] < -0.05, 'and of one that still shows the same input');
});

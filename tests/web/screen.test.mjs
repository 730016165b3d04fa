import assert from 'node:assert/strict';
import { test } from 'node:test';

import { Screen } from '../../web/picture/screen.js';
import { kNoMovement } from '../../web/walk/prediction.js';

const kPicture = { width: 704, height: 396, border: 10, yaw: 1, pitch: 0, tanHalfX: 1.1, tanHalfY: 0.61875 };

function setUp({ isReady = true } = {}) {
  const log = [];
  const painted = [];
  const open = new Set();
  const state = { look: { yaw: 1, pitch: 0 }, movement: kNoMovement };
  const canvas = {
    width: 16,
    height: 9,
    getContext: () => ({ drawImage: (image, ...place) => log.push([image.name, ...place].join(' ')) }),
  };
  const lateLook = {
    isReady,
    take: (image) => log.push(`take ${image.name}`),
    seen: (picture, { turn, displacement }) => ({
      name: displacement.some(Boolean) ? `moved ${displacement.join()}` : `turned ${turn.yaw.toFixed(2)}`,
    }),
  };
  const screen = new Screen({
    canvas,
    lateLook,
    look: () => state.look,
    move: () => state.movement,
    onPaint: (picture, { turn }) => painted.push([picture, turn.yaw]),
  });
  const image = (name) => {
    const made = { name, close: () => assert.ok(open.delete(name), `${name} closed once`) };
    open.add(name);
    return made;
  };
  return { log, painted, open, state, canvas, lateLook, screen, image };
}

// Fault: a still picture that turns black once WebGL was lost and restored.
test('copies again after a lost context', () => {
  const { log, state, lateLook, screen, image } = setUp();
  lateLook.isEmpty = false;
  state.look = { yaw: 1.2, pitch: 0 };
  screen.show(image('a'), kPicture);
  state.look = { yaw: 1.3, pitch: 0 };
  screen.turn();
  const copies = () => log.filter((line) => line === 'take a').length;
  assert.equal(copies(), 1);
  lateLook.isEmpty = true;
  state.look = { yaw: 1.2, pitch: 0 };
  screen.turn();
  assert.equal(copies(), 2);
});

test('an unchanged view shows the centre of the picture', () => {
  const { log, canvas, screen, image } = setUp();
  screen.show(image('a'), kPicture);
  assert.deepEqual(log, ['a 32 18 640 360 0 0 640 360']);
  assert.deepEqual([canvas.width, canvas.height], [640, 360]);
  assert.equal(screen.isBehind, false);
  screen.turn();
  assert.equal(log.length, 1, 'nothing is painted twice');
});

test('a changed view turns the picture, which is uploaded once', () => {
  const { log, state, screen, image } = setUp();
  screen.show(image('a'), kPicture);
  state.look = { yaw: 1.2, pitch: 0 };
  assert.equal(screen.isBehind, true);
  screen.turn();
  assert.equal(screen.isBehind, false);
  state.look = { yaw: 1.3, pitch: 0 };
  screen.turn();
  assert.deepEqual(log.slice(1), ['take a', 'turned 0.20 0 0', 'turned 0.30 0 0']);
  screen.show(image('b'), kPicture);
  assert.deepEqual(log.slice(4), ['take b', 'turned 0.30 0 0'], 'the next one is turned from the start');
  state.look = { yaw: 1, pitch: 0 };
  screen.turn();
  assert.equal(log.at(-1), 'b 32 18 640 360 0 0 640 360', 'and back');
});

// Fault: names that stay behind while the picture turns.
test('reports every paint with its turn', () => {
  const { painted, state, screen, image } = setUp();
  screen.show(image('a'), kPicture);
  state.look = { yaw: 1.25, pitch: 0 };
  screen.turn();
  screen.turn();
  assert.deepEqual(painted, [[kPicture, 0], [kPicture, 0.25]]);
});

test('keeps one image open at most, and none after a freeze', () => {
  const { open, state, screen, image } = setUp();
  screen.show(image('a'), kPicture);
  screen.show(image('b'), kPicture);
  assert.deepEqual([...open], ['b']);
  screen.freeze();
  screen.freeze();
  assert.equal(open.size, 0);
  state.look = { yaw: 2, pitch: 0 };
  assert.equal(screen.isBehind, false, 'what is frozen does not turn');
});

for (const [what, options, look, picture] of [
  ['without WebGL', { isReady: false }, { yaw: 2, pitch: 0 }, kPicture],
  ['switched off', {}, null, kPicture],
  ['with an older server', {}, { yaw: 2, pitch: 0 }, { width: 704, height: 396 }],
]) {
  test(`${what}, pictures stay unchanged`, () => {
    const { log, state, screen, image } = setUp(options);
    state.look = look;
    screen.show(image('a'), picture);
    assert.equal(log.length, 1);
    assert.match(log[0], /^a /);
    assert.equal(screen.isBehind, false);
  });
}

test('a context lost during a turn leaves the picture', () => {
  const { log, state, lateLook, screen, image } = setUp();
  state.look = { yaw: 1.2, pitch: 0 };
  screen.show(image('a'), kPicture);
  lateLook.isReady = false;
  assert.equal(screen.isBehind, true);
  screen.turn();
  assert.equal(log.at(-1), 'a 32 18 640 360 0 0 640 360');
});

const kStep = Object.freeze({ displacement: [0.1, 0, -0.2], until: 5, isMoving: true });

// Faults: a step that waits for the next picture; a picture that is moved again and again to the same place.
test('a step moves the picture, once per place', () => {
  const { log, state, screen, image } = setUp();
  screen.show(image('a'), kPicture);
  assert.equal(screen.isMoving, false);
  state.movement = kStep;
  assert.equal(screen.isBehind, true);
  screen.turn();
  screen.turn();
  assert.deepEqual(log.slice(1), ['take a', 'moved 0.1,0,-0.2 0 0']);
  assert.deepEqual([screen.isMoving, screen.isTurned], [true, true]);
});

// Fault: a page that goes on painting after the visitor has come to rest, or that stops before.
test('a visitor at rest is not behind', () => {
  const { log, state, screen, image } = setUp();
  state.movement = { ...kNoMovement, isMoving: true };
  screen.show(image('a'), kPicture);
  assert.deepEqual([screen.isBehind, screen.isMoving, screen.isTurned], [true, true, false], 'the first step is tiny');
  state.movement = kStep;
  screen.turn();
  state.movement = { ...kStep, isMoving: false };
  screen.turn();
  assert.deepEqual([screen.isBehind, screen.isMoving], [false, false]);
  state.movement = kNoMovement;
  screen.turn();
  assert.equal(log.at(-1), 'a 32 18 640 360 0 0 640 360', 'at its own eye, the picture is unchanged');
});

// Fault: a picture without depths is bent, or a graphics card that is lost keeps the page painting.
test('without late look nothing moves', () => {
  const { log, state, screen, image } = setUp({ isReady: false });
  state.movement = kStep;
  screen.show(image('a'), kPicture);
  assert.equal(log[0], 'a 32 18 640 360 0 0 640 360');
  assert.deepEqual([screen.isBehind, screen.isMoving], [false, false]);
});

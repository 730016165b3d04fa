import assert from 'node:assert/strict';
import { test } from 'node:test';

import { Decoding } from '../../web/picture/decoding.js';
import { Display } from '../../web/picture/display.js';
import { IndependentDecoder } from '../../web/picture/independent_decoder.js';

/** The page's way from picture to screen, with decoding and painting at the test's command. */
function setUp() {
  const decodes = new Map();
  const open = new Set();
  const log = [];
  let paint = null;
  const screen = {
    isBehind: false,
    isMoving: false,
    isTurned: false,
    show: (image) => {
      log.push(`paint ${image.name}`);
      image.close();
    },
    turn: () => log.push('turn'),
    freeze: () => {},
  };
  const display = new Display({
    screen,
    schedule: (callback) => {
      assert.equal(paint, null, 'one paint at a time is planned');
      paint = callback;
    },
    clock: { now: () => 0 },
    onTurned: () => log.push('turned'),
    onPresented: (picture) => log.push(`presented ${picture.frame}`),
  });
  const decode = ({ picture: name }) => new Promise((resolve, reject) => decodes.set(name, { resolve, reject }));
  const decoding = new Decoding({
    make: { 1: (parts) => new IndependentDecoder({ ...parts, decode }) },
    clock: { now: () => 0 },
    on: {
      image: (image, picture) => display.show(image, picture),
      skipped: (picture) => log.push(`skipped ${picture.frame}`),
      broken: (picture) => log.push(`broken ${picture.frame}`),
      useless: () => assert.fail('JPEG is never given up'),
    },
  });
  const push = (frame, name = `p${frame}`) => decoding.push({ codec: 1, frame, picture: name });
  const finish = async (name) => {
    const bitmap = { name, close: () => assert.ok(open.delete(bitmap), `${name} closed once`) };
    open.add(bitmap);
    decodes.get(name).resolve(bitmap);
    await new Promise(setImmediate);
  };
  const fail = async (name) => {
    decodes.get(name).reject(new Error('not a JPEG'));
    await new Promise(setImmediate);
  };
  const vsync = () => {
    const callback = paint;
    paint = null;
    callback?.();
  };
  return { log, open, screen, display, decoding, push, finish, fail, vsync };
}

test('paints pictures in their order', async () => {
  const { log, open, push, finish, vsync } = setUp();
  push(1);
  await finish('p1');
  vsync();
  push(2);
  await finish('p2');
  vsync();
  vsync();
  assert.deepEqual(log, ['paint p1', 'presented 1', 'paint p2', 'presented 2']);
  assert.equal(open.size, 0);
});

test('a late picture never replaces a newer one', async () => {
  const { log, open, push, finish, vsync } = setUp();
  push(1);
  push(2);
  await finish('p2');
  await finish('p1');
  vsync();
  assert.deepEqual(log, ['paint p2', 'presented 2']);
  assert.equal(open.size, 0, 'the late bitmap is closed');
});

test('paints the newest picture', async () => {
  const { log, open, push, finish, vsync } = setUp();
  for (const frame of [1, 2, 3]) {
    push(frame);
    await finish(`p${frame}`);
  }
  vsync();
  assert.deepEqual(log, ['paint p3', 'presented 3']);
  assert.equal(open.size, 0);
});

test('reports a broken picture and shows the next one', async () => {
  const { log, push, finish, fail, vsync } = setUp();
  push(1);
  await fail('p1');
  push(2);
  await finish('p2');
  vsync();
  assert.deepEqual(log, ['broken 1', 'skipped 1', 'paint p2', 'presented 2']);
});

test('keeps JPEG despite failures', async () => {
  const { log, push, fail } = setUp();
  for (let frame = 1; frame <= 20; frame += 1) {
    push(frame);
    await fail(`p${frame}`);
  }
  assert.equal(log.at(-1), 'skipped 20');
});

test('a new connection resets the count and hides pictures of the former one', async () => {
  const { log, open, display, decoding, push, finish, fail, vsync } = setUp();
  push(70);
  await finish('p70');
  push(71);
  push(72);
  decoding.reset();
  display.reset();
  push(1, 'new 1');
  await finish('p71');
  await fail('p72');
  vsync();
  assert.deepEqual(log, ['turn']);
  await finish('new 1');
  vsync();
  assert.deepEqual(log, ['turn', 'paint new 1', 'presented 1']);
  assert.equal(open.size, 0);
});

test('between pictures, turns the last one to the newest view, once per change', async () => {
  const { log, screen, display, push, finish, vsync } = setUp();
  display.turn();
  vsync();
  assert.deepEqual(log, []);
  screen.isBehind = true;
  display.turn();
  display.turn();
  vsync();
  assert.deepEqual(log, ['turn']);
  display.turn();
  push(1);
  await finish('p1');
  vsync();
  assert.deepEqual(log, ['turn', 'paint p1', 'presented 1'], 'a new picture is painted turned at once');
});

test('times each paint, and marks turned ones', async () => {
  let now = 0;
  let paint = null;
  const told = [];
  const screen = { isTurned: false, isBehind: true, show: () => (now += 3), turn: () => (now += 5) };
  const display = new Display({
    screen,
    schedule: (callback) => (paint = callback),
    clock: { now: () => now },
    onTurned: (time) => told.push(`turned ${time}`),
    onPresented: ({ frame }, time) => told.push(`${frame} in ${time}`),
  });
  display.show({}, { frame: 1 });
  paint();
  screen.isTurned = true;
  display.turn();
  paint();
  assert.deepEqual(told, ['1 in 3', 'turned 5']);
});

// Faults: a walk that is shown with each picture only; a page that paints for ever after it.
test('paints at each frame while the visitor moves, and none at rest', async () => {
  const { log, screen, display, push, finish, vsync } = setUp();
  push(1);
  screen.isMoving = true;
  await finish('p1');
  for (let frame = 0; frame < 3; frame += 1) vsync();
  assert.deepEqual(log.splice(0), ['paint p1', 'presented 1', 'turn', 'turn']);
  screen.isMoving = false;
  for (let frame = 0; frame < 3; frame += 1) vsync();
  assert.deepEqual(log.splice(0), ['turn'], 'the last frame finds the rest');
  screen.isBehind = true;
  display.turn();
  screen.isMoving = true;
  vsync();
  vsync();
  assert.deepEqual(log, ['turn', 'turn'], 'other controls begin it again');
});

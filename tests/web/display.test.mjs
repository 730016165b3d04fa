import assert from 'node:assert/strict';
import { test } from 'node:test';

import { Decoder } from '../../web/decoder.js';
import { Display } from '../../web/display.js';

/** The page's way from frame to screen, with decoding and painting at the test's command. */
function setUp() {
  const decoding = new Map();
  const open = new Set();
  const log = [];
  let paint = null;
  const display = new Display({
    paint: (bitmap) => log.push(`paint ${bitmap.name}`),
    schedule: (callback) => {
      assert.equal(paint, null, 'one paint at a time is planned');
      paint = callback;
    },
    onPresented: (frame) => log.push(`presented ${frame.frame}`),
  });
  const decoder = new Decoder({
    decode: (name) => new Promise((resolve, reject) => decoding.set(name, { resolve, reject })),
    onPicture: (bitmap, frame) => display.show(bitmap, frame),
    onBroken: (frame) => log.push(`broken ${frame.frame}`),
  });
  const push = (frame, name = `p${frame}`) => decoder.push({ frame, picture: name });
  const finish = async (name) => {
    const bitmap = { name, close: () => assert.ok(open.delete(bitmap), `${name} closed once`) };
    open.add(bitmap);
    decoding.get(name).resolve(bitmap);
    await new Promise(setImmediate);
  };
  const fail = async (name) => {
    decoding.get(name).reject(new Error('not a JPEG'));
    await new Promise(setImmediate);
  };
  const vsync = () => {
    const callback = paint;
    paint = null;
    callback?.();
  };
  return { log, open, display, decoder, push, finish, fail, vsync };
}

test('paints frames in their order', async () => {
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

test('a picture decoded late never replaces a newer one', async () => {
  const { log, open, push, finish, vsync } = setUp();
  push(1);
  push(2);
  await finish('p2');
  await finish('p1');
  vsync();
  assert.deepEqual(log, ['paint p2', 'presented 2']);
  assert.equal(open.size, 0, 'the late bitmap is closed');
});

test('the newest wins between two paints', async () => {
  const { log, open, push, finish, vsync } = setUp();
  for (const frame of [1, 2, 3]) {
    push(frame);
    await finish(`p${frame}`);
  }
  vsync();
  assert.deepEqual(log, ['paint p3', 'presented 3']);
  assert.equal(open.size, 0);
});

test('a broken picture is told and the next one shows', async () => {
  const { log, push, finish, fail, vsync } = setUp();
  push(1);
  push(2);
  await fail('p1');
  await finish('p2');
  vsync();
  assert.deepEqual(log, ['broken 1', 'paint p2', 'presented 2']);
});

test('a new connection starts its count anew, and the former one shows nothing more', async () => {
  const { log, open, display, decoder, push, finish, fail, vsync } = setUp();
  push(70);
  await finish('p70');
  push(71);
  push(72);
  decoder.reset();
  display.reset();
  push(1, 'new 1');
  await finish('p71');
  await fail('p72');
  vsync();
  assert.deepEqual(log, []);
  await finish('new 1');
  vsync();
  assert.deepEqual(log, ['paint new 1', 'presented 1']);
  assert.equal(open.size, 0);
});

test('a bitmap is closed even if painting fails', () => {
  let closed = false;
  let run;
  const display = new Display({
    paint: () => {
      throw new Error('context lost');
    },
    schedule: (callback) => (run = callback),
    onPresented: () => assert.fail('nothing was presented'),
  });
  display.show({ close: () => (closed = true) }, { frame: 1 });
  assert.throws(() => run(), /context lost/);
  assert.ok(closed);
});

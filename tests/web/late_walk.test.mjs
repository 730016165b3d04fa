import assert from 'node:assert/strict';
import { readFileSync } from 'node:fs';
import { test } from 'node:test';

import { Receiver } from '../../web/stream/receiver.js';
import { FakeClock } from './fake_clock.mjs';
import { fakeGl } from './fake_gl.mjs';

const golden = JSON.parse(readFileSync(new URL('../stream/protocol/golden_messages.json', import.meta.url), 'utf8'));
const hexOf = (bytes) => Buffer.from(bytes).toString('hex');
const bytesOf = (hex) => Uint8Array.from(Buffer.from(hex, 'hex')).buffer;
const goldenHex = (name) => golden.find((entry) => entry.name === name).hex;
const kFrame = 1000 / 60;
const kForward = 1;

/** A page with a graphics card, and the network's and the screen's end of it. */
async function setUp(context, { protocol = 'grove.v1.5', preferences = {} } = {}) {
  const clock = new FakeClock();
  const { log, gl } = fakeGl();
  const events = [];
  let frame = null;
  const globals = {
    requestAnimationFrame: (callback) => (frame = callback),
    cancelAnimationFrame: () => (frame = null),
    createImageBitmap: async () => ({ close() {} }),
  };
  for (const [name, value] of Object.entries(globals)) {
    const before = globalThis[name];
    globalThis[name] = value;
    context.after(() => (globalThis[name] = before));
  }
  let socket;
  class Wire {
    protocol = protocol;
    readyState = 1;
    sent = [];

    constructor() {
      socket = this;
    }

    send(bytes) {
      this.sent.push(hexOf(bytes));
    }

    close(code) {
      this.closed = code ?? 1000;
    }

    receive(data) {
      this.onmessage({ data });
    }
  }
  const screen = { width: 0, height: 0, getContext: () => ({ drawImage() {} }), addEventListener() {} };
  const receiver = new Receiver({
    scope: { WebSocket: Wire },
    clock,
    canvas: screen,
    makeCanvas: () => ({ ...screen, getContext: () => gl }),
    emit: (event) => events.push(event),
    decodeNearness: (bytes, columns, rows) => {
      if (bytes.length !== 1) throw new Error('bad bytes');
      return new Float32Array(columns * rows).fill(bytes[0] / 128);
    },
    start: { url: 'ws://grove.test/', hello: { name: '', width: 640, height: 360 }, hidden: false, preferences, stored: {} },
  });
  await receiver.start();
  socket.onopen();
  socket.receive(bytesOf(goldenHex('welcome')));
  if (protocol === 'grove.v1.5') socket.receive(groundOf(30));
  const { visit } = events.findLast(({ kind }) => kind === 'state');
  receiver.do({ kind: 'look', yaw: 0.5, pitch: -0.25 });
  let number = 0;
  const press = (keys, yaw = 0.5) =>
    receiver.do({ kind: 'input', visit, input: { number: (number += 1), keys, yaw, pitch: -0.25 }, now: clock.now() });
  return {
    clock,
    drawn: log,
    socket,
    of: (kind) => events.filter((event) => event.kind === kind),
    press,
    turn: (yaw) => {
      receiver.do({ kind: 'look', yaw, pitch: -0.25 });
      press(0, yaw);
    },
    arrive: async (picture) => {
      socket.receive(pictureOf(picture));
      await new Promise(setImmediate);
    },
    isWaiting: () => frame !== null,
    vsync: () => {
      clock.advance(kFrame);
      const callback = frame;
      frame = null;
      callback?.();
    },
  };
}

function groundOf(radius) {
  const view = new DataView(new ArrayBuffer(8));
  view.setUint8(0, 0x8a);
  view.setFloat32(4, radius, true);
  return view.buffer;
}

/** The golden picture with labels: a space of an eye at rest, `space: false`: none. */
function pictureOf({ frame, lastInput, space = true, nearness = '40' }) {
  const hex = goldenHex('picture with labels');
  const header = 2 * (40 + 2 * 10);
  const block = new DataView(new ArrayBuffer(40));
  block.setFloat32(4, 1.7, true);
  block.setFloat32(16, 1.7, true);
  block.setUint16(36, nearness.length / 2, true);
  const buffer = bytesOf(hex.slice(0, header) + (space ? hexOf(block.buffer) + nearness : '') + hex.slice(header));
  const view = new DataView(buffer);
  view.setUint8(2, space ? 3 : 1);
  view.setUint32(12, frame, true);
  view.setUint32(16, lastInput, true);
  return buffer;
}

const kLimits = /^06(..)/;
const flagsOf = ({ sent }) => Number.parseInt(sent.findLast((hex) => kLimits.test(hex)).match(kLimits)[1], 16);

// Faults: a step that waits for the server's picture; a page that paints at rest; a measurement of what nobody sees.
test('a step is on the screen two frames after its key', async (context) => {
  const page = await setUp(context);
  assert.equal(flagsOf(page.socket), 2 | 4);
  page.press(0);
  await page.arrive({ frame: 1, lastInput: 1 });
  page.vsync();
  assert.equal(page.isWaiting(), false, 'nothing moves');
  page.clock.advance(5000);
  page.press(kForward);
  for (let i = 0; i < 3; i += 1) page.vsync();
  assert.ok(page.drawn.length >= 2);
  assert.ok(page.drawn.every(({ indices }) => indices > 0));
  page.clock.advance(100);
  await page.arrive({ frame: 2, lastInput: 2 });
  page.vsync();
  const [input] = page.of('presented').at(-1).inputs;
  assert.ok(input.latency > 150);
  assert.ok(input.screen <= 2 * kFrame, `${input.screen} ms`);
  page.press(0);
  let frames = 0;
  while (page.isWaiting() && frames < 600) {
    page.vsync();
    frames += 1;
  }
  assert.ok(frames > 2 && frames < 100, `paints ${frames} frames until it rests`);
});

// Fault: a table that says that a turn waits for the server's picture, although it has long been on the screen.
test('a turn counts as seen when the picture turns', async (context) => {
  const page = await setUp(context);
  page.press(0);
  await page.arrive({ frame: 1, lastInput: 1 });
  page.vsync();
  page.turn(0.6);
  page.vsync();
  page.clock.advance(100);
  await page.arrive({ frame: 2, lastInput: 2 });
  page.vsync();
  const [input] = page.of('presented').at(-1).inputs;
  assert.ok(input.latency > 100);
  assert.ok(input.screen <= kFrame + 1e-6, `${input.screen} ms`);
});

// Fault: names that stay behind while the picture moves.
test('names move with the picture', async (context) => {
  const page = await setUp(context);
  page.press(0);
  await page.arrive({ frame: 1, lastInput: 1 });
  page.vsync();
  const still = page.of('labels').at(-1).labels.find(({ visitor }) => visitor === 4000000000);
  page.press(kForward);
  for (let i = 0; i < 20; i += 1) page.vsync();
  const moved = page.of('labels').at(-1).labels.find(({ visitor }) => visitor === 4000000000);
  // Left of the middle and below it: from nearby it is farther out.
  assert.ok(moved.place.x < still.place.x - 0.01, `${moved.place.x} from ${still.place.x}`);
});

// Fault: depths that a page cannot read end its connection, or keep the picture from the screen.
test('bad depths cost one movement', async (context) => {
  const page = await setUp(context);
  page.press(kForward);
  await page.arrive({ frame: 1, lastInput: 1, nearness: 'ffff' });
  page.vsync();
  assert.equal(page.of('presented').length, 1);
  assert.deepEqual([page.drawn.length, page.socket.closed, page.isWaiting()], [0, undefined, false]);
  await page.arrive({ frame: 2, lastInput: 1 });
  page.vsync();
  page.vsync();
  assert.ok(page.drawn.length > 0);
});

// Fault: a page that moves pictures for servers or visitors that do not want it.
for (const [what, options, flags] of [
  ['a server of 1.4', { protocol: 'grove.v1.4' }, 2],
  ['a visitor who wants less motion', { preferences: { reducedMotion: true } }, 2],
  ['a visitor without late look', { preferences: { lateLook: false } }, 0],
]) {
  test(`${what} gets pictures that stay`, async (context) => {
    const page = await setUp(context, options);
    assert.equal(flagsOf(page.socket), flags);
    page.press(kForward);
    await page.arrive({ frame: 1, lastInput: 1, space: options.protocol === undefined });
    page.vsync();
    page.press(kForward);
    assert.equal(page.isWaiting(), false);
    assert.deepEqual(page.drawn, []);
  });
}

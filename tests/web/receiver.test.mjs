import assert from 'node:assert/strict';
import { readFileSync } from 'node:fs';
import { test } from 'node:test';

import { Receiver } from '../../web/stream/receiver.js';
import { FakeClock } from './fake_clock.mjs';

const golden = JSON.parse(readFileSync(new URL('../stream/protocol/golden_messages.json', import.meta.url), 'utf8'));
const hexOf = (name) => golden.find((entry) => entry.name === name).hex;
const kHello = { name: 'Ada', width: 1280, height: 720 };
const kInput = { keys: 49, number: 1, yaw: 0.5, pitch: -0.25 };

/** The network's end of the connections of a receiver, whose browser has neither WebCodecs nor WebGL. */
async function setUp({ protocol = 'grove.v1.3', hidden = false } = {}) {
  const sockets = [];
  class Wire {
    protocol = protocol;
    readyState = 0;
    sent = [];

    constructor() {
      sockets.push(this);
    }

    send(bytes) {
      this.sent.push(Buffer.from(bytes).toString('hex'));
    }

    close() {}

    open() {
      this.readyState = 1;
      this.onopen();
    }

    greet() {
      if (this.readyState === 0) this.open();
      this.onmessage({ data: Uint8Array.from(Buffer.from(hexOf('welcome'), 'hex')).buffer });
    }
  }
  const clock = new FakeClock();
  const events = [];
  const canvas = () => ({ getContext: () => null, addEventListener() {} });
  const receiver = new Receiver({
    scope: { WebSocket: Wire },
    clock,
    canvas: canvas(),
    makeCanvas: canvas,
    emit: (event) => events.push(event),
    start: { url: 'ws://grove.test/', hello: kHello, hidden, preferences: {}, stored: {} },
  });
  await receiver.start();
  return { receiver, clock, sockets, of: (kind) => events.filter((event) => event.kind === kind) };
}

// Fault: an input of a lost connection, which the server of the next one takes for one of its own.
test('inputs reach only their own connection', async () => {
  const { receiver, clock, sockets, of } = await setUp();
  sockets[0].greet();
  const { visit } = of('state').at(-1);
  receiver.do({ kind: 'input', visit, input: kInput, now: clock.now() });
  assert.ok(sockets[0].sent.includes(hexOf('input')));
  sockets[0].onclose({ code: 1006, reason: '' });
  receiver.do({ kind: 'retry' });
  sockets[1].greet();
  receiver.do({ kind: 'input', visit, input: kInput, now: clock.now() });
  assert.ok(!sockets[1].sent.includes(hexOf('input')));
  receiver.do({ kind: 'input', visit: of('state').at(-1).visit, input: kInput, now: clock.now() });
  assert.ok(sockets[1].sent.includes(hexOf('input')));
});

// Fault: a page that waits for ever for a picture from a server that does not know the request.
test('without support, a capture fails at once', async () => {
  const able = await setUp();
  able.sockets[0].greet();
  able.receiver.do({ kind: 'capture', number: 7 });
  assert.ok(able.sockets[0].sent.includes(hexOf('capture')));
  assert.deepEqual(able.of('captured'), []);
  const older = await setUp({ protocol: 'grove.v1.2' });
  older.sockets[0].greet();
  older.receiver.do({ kind: 'capture', number: 7 });
  assert.deepEqual(older.of('captured'), [{ kind: 'captured', number: 7, picture: null }]);
});

// Fault: names that nobody learns.
test('the page gets the roster', async () => {
  const { sockets, of } = await setUp({ protocol: 'grove.v1.4' });
  sockets[0].greet();
  sockets[0].onmessage({ data: Uint8Array.from(Buffer.from(hexOf('people'), 'hex')).buffer });
  assert.equal(of('people')[0].othersAreLost, false);
  assert.deepEqual(of('people')[0].people.map(({ name }) => name), ['Ada', '日本 🌲', 'سلمى']);
});

// Fault: a window that grew while the server prepared keeps the size of its greeting.
test('sends the newest size after the welcome', async () => {
  const { receiver, sockets } = await setUp();
  sockets[0].open();
  receiver.do({ kind: 'hello', hello: { ...kHello, width: 1920, height: 1080 } });
  assert.ok(!sockets[0].sent.includes(hexOf('resize')));
  sockets[0].greet();
  assert.ok(sockets[0].sent.includes(hexOf('resize')));
});

// Faults: a hidden page that goes on trying; one that is looked at again and waits for its next turn.
test('reconnects at once when the page becomes visible', async () => {
  const { receiver, clock, sockets } = await setUp();
  sockets[0].greet();
  receiver.do({ kind: 'visibility', hidden: true });
  sockets[0].onclose({ code: 1006, reason: '' });
  clock.advance(600_000);
  assert.equal(sockets.length, 1);
  receiver.do({ kind: 'visibility', hidden: false });
  assert.equal(sockets.length, 2);
});

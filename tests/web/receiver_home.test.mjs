import assert from 'node:assert/strict';
import { test } from 'node:test';

import { ReceiverHome } from '../../web/stream/receiver_home.js';

/** A browser whose worker says this, or fails. */
function setUp(answer) {
  const posted = [];
  class Worker {
    constructor() {
      queueMicrotask(() => (answer ? this.onmessage({ data: answer }) : this.onerror()));
    }

    postMessage(message) {
      posted.push(message.kind);
    }

    terminate() {
      posted.push('terminated');
    }
  }
  const canvas = { transferControlToOffscreen: () => 'offscreen', getContext: () => null };
  const context = { getContext: () => null, addEventListener: () => {} };
  const window = {
    Worker,
    performance: { timeOrigin: 0 },
    document: { createElement: () => context },
    WebSocket: class {},
  };
  const clock = { now: () => 0, setTimeout: () => 0, clearTimeout: () => {} };
  const start = { url: 'ws://a/', hello: { name: '', width: 16, height: 9 }, hidden: false, preferences: {}, stored: {} };
  const events = [];
  return { posted, events, home: new ReceiverHome({ window, clock, canvas, start, on: (event) => events.push(event.kind) }) };
}

test('messages wait until the worker has the canvas', async () => {
  const { posted, home } = setUp({ kind: 'able', able: true });
  home.send({ kind: 'look' });
  assert.equal(await home.open(), 'worker');
  home.send({ kind: 'input' });
  assert.deepEqual(posted, ['start', 'look', 'input']);
});

for (const [what, answer] of [['cannot paint', { kind: 'able', able: false }], ['does not start', null]]) {
  test(`a worker that ${what} leaves the receiver on the page`, async () => {
    const { posted, events, home } = setUp(answer);
    home.send({ kind: 'look', yaw: 0, pitch: 0 });
    assert.equal(await home.open(), 'page');
    assert.deepEqual(posted, ['terminated']);
    assert.ok(events.includes('lateLook'), 'it has begun on the page');
  });
}

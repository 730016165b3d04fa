import assert from 'node:assert/strict';
import { test } from 'node:test';

import { Capture } from '../../web/picture/capture.js';
import { FakeClock } from './fake_clock.mjs';

function setUp() {
  const clock = new FakeClock();
  const asked = [];
  const capture = new Capture({ send: (command) => asked.push(command), clock });
  return { clock, asked, capture };
}

const kPng = new Blob(['screen'], { type: 'image/png' });

test("the server's picture is a JPEG", async () => {
  const { asked, capture } = setUp();
  const taken = capture.take();
  assert.deepEqual(asked, [{ kind: 'capture', number: 1 }]);
  capture.answered({ number: 1, picture: Uint8Array.of(0xff, 0xd8) });
  const { type, size } = await taken;
  assert.deepEqual([type, size], ['image/jpeg', 2]);
});

test('an unreachable server leaves the screen unchanged', async () => {
  for (const refuse of [({ capture }) => capture.answered({ number: 1, picture: null }), ({ clock }) => clock.advance(3000)]) {
    const parts = setUp();
    const taken = parts.capture.take();
    refuse(parts);
    await new Promise(setImmediate);
    assert.deepEqual(parts.asked.at(-1), { kind: 'picture', number: 2 });
    parts.capture.answered({ number: 1, picture: Uint8Array.of(1) });
    parts.capture.answered({ number: 2, picture: kPng });
    assert.equal(await taken, kPng, 'a late answer is not taken for this one');
  }
});

test('a missing picture is a failure', async () => {
  const { capture } = setUp();
  const taken = capture.take();
  capture.answered({ number: 1, picture: null });
  await new Promise(setImmediate);
  capture.answered({ number: 2, picture: null });
  await assert.rejects(taken);
});

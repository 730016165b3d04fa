import assert from 'node:assert/strict';
import { test } from 'node:test';

import { Decoding } from '../../web/picture/decoding.js';
import { FakeClock } from './fake_clock.mjs';

/** Decoders that do what the test tells them. */
function setUp({ refuses = () => {} } = {}) {
  const clock = new FakeClock();
  const log = [];
  const made = [];
  const make = (codec) => (parts) => {
    refuses(codec);
    const decoder = { ...parts, codec, pushed: [], closed: false };
    decoder.push = ({ frame }) => decoder.pushed.push(frame);
    decoder.close = () => (decoder.closed = true);
    made.push(decoder);
    return decoder;
  };
  const decoding = new Decoding({
    make: { 1: make(1), 2: make(2) },
    clock,
    on: {
      image: (image, picture) => log.push(`image ${picture.frame}`),
      skipped: ({ frame }) => log.push(`skipped ${frame}`),
      broken: ({ frame }) => log.push(`broken ${frame}`),
      useless: (codec, error) => log.push(`useless ${codec}: ${error.message}`),
    },
  });
  let frame = 0;
  const push = (codec, independent) => {
    frame += 1;
    const picture = { codec, independent, frame };
    decoding.push(picture);
    return picture;
  };
  /** Decodes, so that the codec has worked once. */
  const decodeOne = (codec) => made.at(-1).onImage({ close: () => {} }, push(codec, true));
  const failOne = (codec, error = new Error('bad bits')) => {
    const picture = push(codec, true);
    made.at(-1).onFailure(error, picture);
  };
  return { clock, log, made, decoding, push, decodeOne, failOne };
}

const named = (name) => Object.assign(new Error(name), { name });

test('after a failure, skips dependent pictures until an independent one', () => {
  const { log, made, push } = setUp();
  push(2, true);
  const second = push(2, false);
  made[0].onFailure(new Error('bad bits'), second);
  push(2, false);
  push(2, false);
  assert.ok(made[0].closed);
  assert.deepEqual(log, ['broken 2', 'skipped 2', 'skipped 3', 'skipped 4'], 'one request; all are acknowledged');
  push(2, true);
  push(2, false);
  assert.deepEqual(made[1].pushed, [5, 6]);
});

test('requests an independent picture if the stream starts with a dependent one', () => {
  const { log, made, push } = setUp();
  push(2, false);
  push(2, false);
  assert.deepEqual(log, ['broken 1', 'skipped 1', 'skipped 2']);
  assert.equal(made.length, 0);
});

test('a new codec gets a new decoder, and the former one is closed', () => {
  const { log, made, push } = setUp();
  push(2, true);
  push(1, true);
  push(2, true);
  assert.deepEqual(made.map(({ codec, closed }) => [codec, closed]), [[2, true], [1, true], [2, false]]);
  assert.deepEqual(log, []);
});

test('gives up a codec that fails repeatedly, not one that fails occasionally', () => {
  const { clock, log, decodeOne, failOne, push } = setUp();
  push(2, true);
  decodeOne(2);
  for (let i = 0; i < 5; i += 1) {
    clock.advance(11_000);
    failOne(2);
  }
  assert.ok(!log.some((line) => line.startsWith('useless')), log.join());
  failOne(2);
  assert.equal(log.at(-2), 'useless 2: bad bits');
  push(2, true);
  assert.equal(log.at(-1), 'skipped 9', 'what is still on its way is acknowledged');
});

test('gives up a codec sooner if it never worked', () => {
  const { log, failOne } = setUp();
  failOne(2);
  failOne(2);
  assert.equal(log.at(-2), 'useless 2: bad bits');
});

test('does not retry a codec that the browser refuses', () => {
  const { log, failOne } = setUp();
  failOne(2, named('NotSupportedError'));
  assert.deepEqual(log, ['useless 2: NotSupportedError', 'skipped 1']);
});

test('a decoder that cannot be created counts as failed', () => {
  const { log, push } = setUp({
    refuses: (codec) => {
      if (codec === 2) throw new TypeError('no such thing');
    },
  });
  push(2, true);
  push(2, true);
  assert.deepEqual(log, ['broken 1', 'skipped 1', 'useless 2: no such thing', 'skipped 2']);
});

test('a decoder reclaimed from a background page is not a failure', () => {
  const { log, decodeOne, made, push } = setUp();
  push(2, true);
  for (let i = 0; i < 5; i += 1) {
    decodeOne(2);
    made.at(-1).onFailure(named('QuotaExceededError'), null);
  }
  assert.ok(!log.some((line) => line.startsWith('useless')), log.join());
  push(2, false);
  assert.equal(log.at(-2), 'broken 7');
});

test('replaces a decoder that holds pictures back by software, then by another codec', () => {
  const { log, made, push, failOne } = setUp();
  push(2, true);
  assert.equal(made[0].software, false);
  failOne(2, named('HoldsBack'));
  assert.equal(log.at(-2), 'broken 2');
  push(2, true);
  assert.equal(made.at(-1).software, true);
  failOne(2, named('HoldsBack'));
  assert.equal(log.at(-2), 'useless 2: HoldsBack');
});

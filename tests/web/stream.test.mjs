import assert from 'node:assert/strict';
import { test } from 'node:test';

import { Stream } from '../../web/stream/stream.js';

function setUp({ adapts = true, isSpatial = true } = {}) {
  const log = [];
  const failed = new Set();
  const connection = {
    adapts,
    isSpatial,
    acknowledge: ({ frame }) => log.push(`ack ${frame}`),
    sendOffer: (codecs) => log.push(`offer ${codecs}`),
    sendBroken: (frame) => log.push(`broken ${frame}`),
    sendLimits: (limits) => log.push({ ...limits }),
  };
  const codecs = {
    offer: (preference) => (preference === 'jpeg' || failed.has(2) ? [1] : [2, 1]),
    drop: (codec) => failed.add(codec),
  };
  const lateLook = { isReady: true, hindrance: 'no fast WebGL' };
  const reports = [];
  let decoding;
  const stream = new Stream({
    connection,
    codecs,
    clock: { now: () => 30 },
    makeDecoding: (on) => {
      decoding = { on, reset: () => log.push('reset'), push: ({ frame }) => log.push(`push ${frame}`) };
      return decoding;
    },
    display: { show: (image, { frame, decode }) => log.push(`show ${frame} decoded in ${decode}`) },
    lateLook,
    onCodecFailed: (words) => reports.push(words),
  });
  return { log, reports, connection, lateLook, stream, decoding };
}

const kFree = { hidden: false, border: true, nearness: true, framesPerSecond: 0, kilobitsPerSecond: 0, lines: 0 };

test('sends its limits on connection, then only changes', () => {
  const { log, stream, lateLook } = setUp();
  stream.begin();
  stream.tellLimits();
  stream.setHidden(false);
  assert.deepEqual(log.splice(0), ['reset', kFree]);
  stream.setHidden(true);
  stream.setPreferences({ lines: 480, framesPerSecond: 20 });
  stream.setHidden(false);
  const chosen = { ...kFree, lines: 480, framesPerSecond: 20 };
  assert.deepEqual(log.splice(0), [{ ...kFree, hidden: true }, { ...chosen, hidden: true }, chosen]);
  lateLook.isReady = false;
  stream.tellLimits();
  assert.deepEqual(log.splice(0), [{ ...chosen, border: false, nearness: false }], 'a border is of use to late look only');
  stream.begin();
  assert.deepEqual(log.splice(0), ['reset', { ...chosen, border: false, nearness: false }], 'the next server knows nothing yet');
});

test('a hidden page reports it after the welcome', () => {
  const { log, connection, stream } = setUp({ adapts: false });
  stream.setHidden(true);
  assert.deepEqual(log, []);
  connection.adapts = true;
  stream.begin();
  assert.deepEqual(log, ['reset', { ...kFree, hidden: true }]);
});

test('offers a chosen codec', () => {
  const { log, stream } = setUp();
  assert.deepEqual(stream.offer, [2, 1]);
  stream.setPreferences({ codec: 'jpeg' });
  stream.setPreferences({ codec: 'jpeg' });
  assert.deepEqual(log, ['offer 1', kFree]);
  assert.deepEqual(stream.offer, [1]);
});

test('a failing codec is removed from the offer and reported', () => {
  const { log, reports, decoding } = setUp();
  decoding.on.useless(2, new Error('bad bits'));
  assert.deepEqual(log, ['offer 1']);
  assert.deepEqual(reports, ['H.264 does not work here (bad bits); offering JPEG']);
});

test('reports broken and skipped pictures to the server', () => {
  const { log, stream, decoding } = setUp();
  stream.receive({ frame: 3 });
  decoding.on.broken({ frame: 3 });
  decoding.on.skipped({ frame: 3 });
  assert.deepEqual(log, ['push 3', 'broken 3', 'ack 3']);
});

test('reports the state of late look', () => {
  const { stream, lateLook } = setUp();
  assert.equal(stream.lateLookWord, 'on');
  stream.setPreferences({ lateLook: false });
  assert.equal(stream.lateLookWord, 'off');
  stream.setPreferences({ lateLook: true });
  lateLook.isReady = false;
  assert.equal(stream.lateLookWord, 'off: no fast WebGL');
  assert.equal(stream.turns, false);
});

// Faults: an older server that gets a flag it does not know; pictures that move for a visitor who asked for stillness.
test('pictures walk with a server of 1.5, unless motion is to be reduced', () => {
  const { log, connection, stream } = setUp();
  assert.equal(stream.walks, true);
  stream.setPreferences({ reducedMotion: true });
  assert.deepEqual(log.splice(0), [{ ...kFree, nearness: false }], 'it still turns');
  assert.deepEqual([stream.turns, stream.walks, stream.lateLookWord], [true, false, 'turning only']);
  stream.setPreferences({ reducedMotion: false });
  connection.isSpatial = false;
  stream.begin();
  assert.deepEqual(log.splice(1), ['reset', { ...kFree, nearness: false }]);
  assert.deepEqual([stream.turns, stream.walks], [true, false]);
});

test('decoding time starts at arrival', () => {
  const { log, decoding } = setUp();
  decoding.on.image({}, { frame: 3, arrived: 25.5 });
  assert.deepEqual(log, ['show 3 decoded in 4.5']);
});

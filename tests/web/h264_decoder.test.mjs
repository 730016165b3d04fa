import assert from 'node:assert/strict';
import { test } from 'node:test';

import { H264Decoder, codecName } from '../../web/picture/h264_decoder.js';
import { FakeClock } from './fake_clock.mjs';

const kDelimiter = [0, 0, 0, 1, 0x09, 0xf0];
const parameters = (level) => [0, 0, 0, 1, 0x67, 0x42, 0xc0, level, 0x8c];
const kIndependent = Uint8Array.from([...kDelimiter, ...parameters(0x1f), 0, 0, 1, 0x65, 0x88]);
const kDependent = Uint8Array.of(0, 0, 0, 1, 0x41, 0x9a);

/** A browser's VideoDecoder that hands out a picture once `held` newer ones went in, when the test says `work`. */
function setUp({ held = 0 } = {}) {
  const clock = new FakeClock();
  const log = [];
  const frames = { open: 0 };
  let browser;
  class VideoDecoder {
    state = 'unconfigured';
    queue = [];
    inside = [];

    constructor({ output, error }) {
      this.output = output;
      this.error = error;
      this.held = held;
      browser = this;
    }

    get decodeQueueSize() {
      return this.queue.length;
    }

    configure({ codec, codedWidth, codedHeight, optimizeForLatency, hardwareAcceleration }) {
      assert.ok(optimizeForLatency);
      log.push(`configure ${codec} ${codedWidth}x${codedHeight} ${hardwareAcceleration}`);
    }

    decode({ type, timestamp }) {
      this.queue.push(timestamp);
      log.push(type);
    }

    close() {
      this.state = 'closed';
    }

    /** Takes what waits, one by one, and hands out what it does not hold back. */
    work(count = Infinity) {
      for (; this.queue.length > 0 && count > 0; count -= 1) {
        this.inside.push(this.queue.shift());
        if (this.inside.length <= this.held) continue;
        frames.open += 1;
        this.output({ timestamp: this.inside.shift(), close: () => (frames.open -= 1) });
      }
    }
  }
  const decoder = new H264Decoder({
    window: { VideoDecoder, EncodedVideoChunk: Object },
    clock,
    software: false,
    onImage: (image, picture) => {
      log.push(`image ${picture.frame}`);
      image.close();
    },
    onFailure: (error, picture) => log.push(`${error.name} at ${picture?.frame}: ${error.message}`),
    onHeld: (picture) => log.push(`held ${picture.frame}`),
  });
  let frame = 0;
  const push = (picture = kDependent, size = { width: 640, height: 360 }) => {
    frame += 1;
    decoder.push({ frame, independent: picture !== kDependent, picture, ...size });
  };
  return { clock, log, frames, browser, decoder, push };
}

test('reads the codec name from the stream', () => {
  assert.equal(codecName(kIndependent), 'avc1.42C01F');
  assert.equal(codecName(kDependent), null);
  for (let length = 0; length < kIndependent.length; length += 1) codecName(kIndependent.subarray(0, length));
  assert.equal(codecName(Uint8Array.of(0, 0, 1, 0x67, 0x42, 0xc0)), null, 'cut short');
});

test('decodes independent and dependent pictures, and reconfigures for another size', () => {
  const { log, browser, push, frames } = setUp();
  push(kIndependent);
  push();
  push(kIndependent);
  push(kIndependent, { width: 320, height: 180 });
  browser.work();
  assert.deepEqual(log, [
    'configure avc1.42C01F 640x360 no-preference',
    'key',
    'delta',
    'key',
    'configure avc1.42C01F 320x180 no-preference',
    'key',
    'image 1',
    'image 2',
    'image 3',
    'image 4',
  ]);
  assert.equal(frames.open, 0);
});

test('refuses an independent picture without parameter sets', () => {
  const { log, push } = setUp();
  push(Uint8Array.of(0, 0, 0, 1, 0x65, 0x88));
  assert.deepEqual(log, ['Error at 1: an independent picture has no parameter sets']);
});

test('an error reports the newest lost picture', () => {
  const { log, browser, push } = setUp();
  push(kIndependent);
  push();
  browser.error(new Error('bad bits'));
  assert.equal(log.at(-1), 'Error at 2: bad bits');
});

test('a closed decoder reports nothing and closes late pictures', () => {
  const { clock, log, frames, browser, decoder, push } = setUp();
  push(kIndependent);
  decoder.close();
  browser.work();
  browser.error(new Error('closed'));
  clock.advance(60_000);
  assert.deepEqual(log.slice(2), []);
  assert.equal(frames.open, 0);
});

test('drops pictures that queue up before a decoder', () => {
  const { log, push } = setUp();
  push(kIndependent);
  for (let i = 0; i < 30; i += 1) push();
  assert.equal(log.at(-1), 'Error at 31: the decoder does not keep up');
});

test('detects a decoder that holds pictures back within two seconds', () => {
  const { clock, log, browser, push } = setUp({ held: 1 });
  push(kIndependent);
  browser.work();
  for (let i = 0; i < 40 && !log.at(-1).startsWith('HoldsBack'); i += 1) {
    clock.advance(33);
    push();
    browser.work();
  }
  clock.advance(250);
  assert.match(log.at(-1), /^HoldsBack/);
  assert.ok(clock.now() < 2000, `after ${clock.now()} ms`);
});

test('detects it without new pictures, too', () => {
  const { clock, log, browser, push } = setUp({ held: 1 });
  push(kIndependent);
  push();
  browser.work();
  clock.advance(250);
  assert.equal(log.at(-1), 'held 2');
  clock.advance(500);
  assert.match(log.at(-1), /^HoldsBack at 2: the decoder holds 1 pictures back/);
});

test('keeps a slow decoder', () => {
  const { clock, log, browser, push } = setUp();
  push(kIndependent);
  push();
  push();
  browser.work(2); // the third is always taken before the second is out
  let testing = 0;
  for (let i = 0; i < 400; i += 1) {
    clock.advance(16);
    push();
    browser.held = 1;
    browser.work(1);
    if (browser.queue.length === 0) {
      // Given nothing more, it hands out what it has.
      testing += 1;
      browser.held = 0;
      clock.advance(16);
      const last = browser.inside.splice(0);
      for (const timestamp of last) browser.output({ timestamp, close: () => {} });
    }
  }
  assert.ok(testing > 0, 'it was tested');
  browser.held = 0;
  browser.work();
  assert.equal(log.filter((line) => /^(key|delta)$/.test(line)).length, 403, 'what was kept from it came after all');
  assert.ok(!log.some((line) => /HoldsBack|Error/.test(line)), log.slice(-3).join());
});

test('allows a slow first picture', () => {
  const { clock, log, browser, push } = setUp();
  push(kIndependent);
  clock.advance(2_900);
  browser.work();
  assert.equal(log.at(-1), 'image 1');
  assert.ok(!log.some((line) => line.startsWith('HoldsBack')));
});

test('tolerates occasional pauses', () => {
  const { clock, log, browser, push } = setUp();
  push(kIndependent);
  browser.work();
  for (let i = 0; i < 10; i += 1) {
    push();
    clock.advance(400);
    browser.work();
  }
  assert.equal(log.filter((line) => line.startsWith('held')).length, 10);
  assert.ok(!log.some((line) => line.startsWith('HoldsBack')));
});

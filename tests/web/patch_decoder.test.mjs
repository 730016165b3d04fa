import assert from 'node:assert/strict';
import { afterEach, beforeEach, test } from 'node:test';

import { patchDecoder, patchesOf } from '../../web/picture/patch_decoder.js';

/** A picture of patches `[left, top, text]`, whose JPEGs are texts here. */
function bytesOf(patches) {
  return Uint8Array.from(
    patches.flatMap(([left, top, text]) => {
      const header = new DataView(new ArrayBuffer(8));
      header.setUint16(0, left, true);
      header.setUint16(2, top, true);
      header.setUint32(4, text.length, true);
      return [...new Uint8Array(header.buffer), ...new TextEncoder().encode(text)];
    }),
  );
}

const wait = () => new Promise((resolve) => setTimeout(resolve, 5));
const textOf = (jpeg) => new TextDecoder().decode(jpeg);

/** Canvases are lists of what was drawn; an image of a canvas is a copy of its list. */
function setUp() {
  const log = [];
  const open = new Set();
  const decoder = patchDecoder({
    decode: async ({ picture }) => ({ shows: textOf(picture), close: () => {} }),
    makeCanvas: () => {
      const canvas = { drawn: [] };
      canvas.getContext = () => ({ canvas, drawImage: ({ shows }, x, y) => canvas.drawn.push(`${shows}@${x},${y}`) });
      return canvas;
    },
    onImage: ({ shows }, { frame }) => log.push(`${frame}: ${shows}`),
    onFailure: (error, { frame }) => log.push(`${frame} failed: ${error.message}`),
  });
  globalThis.createImageBitmap = async (of) => {
    if (of.drawn) return { shows: of.drawn.join(' '), close: () => {} };
    const shows = await of.text();
    if (shows === 'damaged') throw new Error('not a JPEG');
    open.add(shows);
    return { shows, close: () => open.delete(shows) };
  };
  let frame = 0;
  const push = (independent, ...patches) => {
    frame += 1;
    return decoder.push({ frame, independent, width: 64, height: 48, picture: bytesOf(patches) });
  };
  return { decoder, log, open, push };
}

let original;
beforeEach(() => (original = globalThis.createImageBitmap));
afterEach(() => (globalThis.createImageBitmap = original));

test('reads patches from anywhere in a message', () => {
  const message = Uint8Array.from([9, 9, 9, ...bytesOf([[16, 32, 'ab'], [0, 300, 'c']])]);
  const patches = patchesOf(message.subarray(3));
  assert.deepEqual(patches.map(({ left, top, jpeg }) => [left, top, textOf(jpeg)]), [[16, 32, 'ab'], [0, 300, 'c']]);
  assert.deepEqual(patchesOf(new Uint8Array(0)), []);
});

test('reads no patch that is cut off', () => {
  const whole = bytesOf([[0, 0, 'abc']]);
  for (let length = 1; length < whole.length; length += 1) {
    assert.throws(() => patchesOf(whole.subarray(0, length)), /cut off/, `${length} bytes`);
  }
});

// Faults: a picture without the patches before it, or of an older whole picture.
test('draws patches over the last whole picture and the patches before', async () => {
  const { log, open, push } = setUp();
  await push(true, [0, 0, 'old']);
  await push(true, [0, 0, 'whole']);
  await push(false, [16, 0, 'a'], [32, 16, 'b']);
  await push(false);
  await push(false, [16, 0, 'c']);
  await push(true, [0, 0, 'new']);
  await push(false, [0, 0, 'd']);
  assert.deepEqual(log, [
    '1: old',
    '2: whole',
    '3: whole@0,0 a@16,0 b@32,16',
    '4: whole@0,0 a@16,0 b@32,16',
    '5: whole@0,0 a@16,0 b@32,16 c@16,0',
    '6: new',
    '7: new@0,0 d@0,0',
  ]);
  assert.equal(open.size, 0, 'parts are closed');
});

test('keeps the order of pictures that arrive while others are decoded', async () => {
  const { log, push } = setUp();
  await Promise.all([push(true, [0, 0, 'whole']), push(false, [0, 0, 'a']), push(false, [0, 0, 'b'])]);
  assert.deepEqual(log.filter((line) => !line.startsWith('1')), ['2: whole@0,0 a@0,0', '3: whole@0,0 a@0,0 b@0,0']);
});

test('reports pictures that cannot be decoded', async () => {
  const { log, push } = setUp();
  await push(true, [0, 0, 'whole']);
  await push(false, [0, 0, 'damaged']);
  assert.deepEqual(log, ['1: whole', '2 failed: not a JPEG']);
});

test('says nothing after its end', async () => {
  const { decoder, log, push } = setUp();
  const pushed = [push(true, [0, 0, 'whole']), push(false, [0, 0, 'damaged'])];
  decoder.close();
  await Promise.all(pushed);
  await wait();
  assert.deepEqual(log, []);
});

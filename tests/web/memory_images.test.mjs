import assert from 'node:assert/strict';
import { test } from 'node:test';

import { MemoryImages } from '../../web/picture/memory_images.js';

function frame({ width = 4, height = 2, bytes = width * height * 4, copied = Promise.resolve() } = {}) {
  const made = { displayWidth: width, displayHeight: height, closed: false };
  made.allocationSize = ({ format }) => (format === 'RGBA' ? bytes : 0);
  made.copyTo = async (target) => {
    await copied;
    target.fill(7);
  };
  made.close = () => (made.closed = true);
  return made;
}

const makeData = (width, height) => ({ width, height, data: new Uint8ClampedArray(width * height * 4) });

// Faults: a frame that stays open, of which decoders have few; a copy of nothing.
test('a frame is copied into memory and closed', async () => {
  const images = new MemoryImages(makeData);
  const source = frame();
  let shown;
  await images.pass(source, (image) => (shown = image));
  assert.ok(source.closed);
  assert.ok(shown.imageData.data.every((value) => value === 7));
});

// Fault: memory of the size of a picture for each frame, which the browser has to collect thirty times a second.
test('reuses the memory of closed pictures', async () => {
  const images = new MemoryImages(makeData);
  const shown = [];
  for (let i = 0; i < 3; i += 1) {
    await images.pass(frame(), (image) => shown.push(image));
    if (i === 1) shown[0].close();
  }
  assert.notEqual(shown[1].imageData, shown[0].imageData);
  assert.equal(shown[2].imageData, shown[0].imageData);
  await images.pass(frame({ width: 8 }), (image) => shown.push(image));
  assert.equal(shown[3].imageData.width, 8);
});

// Fault: raw planes of a browser that cannot convert, shown as if they were colours.
test('passes on frames that the browser cannot convert', async () => {
  const images = new MemoryImages(makeData);
  const source = frame({ bytes: 12 });
  let shown;
  await images.pass(source, (image) => (shown = image));
  assert.equal(shown, source);
  assert.ok(!source.closed);
  const bitmap = { close: () => {} };
  await images.pass(bitmap, (image) => (shown = image));
  assert.equal(shown, bitmap);
});

// Fault: a picture that goes back in time, because its copy took longer than the next one's.
test('does not show an outdated copy', async () => {
  const images = new MemoryImages(makeData);
  let finish;
  const slow = images.pass(frame({ copied: new Promise((resolve) => (finish = resolve)) }), () => shown.push('slow'));
  const shown = [];
  await images.pass(frame(), () => shown.push('fast'));
  finish();
  await slow;
  assert.deepEqual(shown, ['fast']);
});

import assert from 'node:assert/strict';
import { readFileSync } from 'node:fs';
import { test } from 'node:test';

import { deflateDecoder, planesOf } from './deflate_decoder.mjs';

const kDeflate = 3;
const golden = JSON.parse(readFileSync(new URL('../stream/encode/deflate_picture.json', import.meta.url), 'utf8'));
const bytes = Uint8Array.from(Buffer.from(golden.bytes, 'hex'));
const picture = (fields) => ({ codec: kDeflate, independent: true, width: 4, height: 2, picture: bytes, ...fields });

// Fault: a decoder that reads other bytes than the encoder in C++ writes; both tests have this picture.
test('decodes pictures of DeflateEncoder', async () => {
  assert.deepEqual([...(await planesOf(bytes))], golden.planes);
  await assert.rejects(planesOf(bytes.slice(0, 10)));
});

// Faults: a decoder that is none for the page, because it calls nothing, or after its end.
test('the decoder has the interface of the page', async () => {
  const images = [];
  const failures = [];
  let closed = 0;
  const decoder = deflateDecoder({
    onImage: (image) => images.push(image),
    onFailure: (error, failed) => failures.push(failed),
    makeImage: (planes) => ({ planes: [...planes], close: () => (closed += 1) }),
  });
  await decoder.push(picture());
  assert.deepEqual(
    images.map(({ planes }) => planes),
    [golden.planes],
  );
  const damaged = picture({ picture: bytes.slice(0, 10) });
  await decoder.push(damaged);
  assert.deepEqual(failures, [damaged]);
  const last = decoder.push(picture());
  decoder.close();
  await last;
  assert.equal(images.length, 1);
  assert.equal(closed, 1);
});

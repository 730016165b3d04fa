import assert from 'node:assert/strict';
import { test } from 'node:test';

import { Codecs } from '../../web/stream/codecs.js';
import { Codec } from '../../web/stream/protocol.js';

const { jpeg, h264, jpegPatches } = Codec;

class Storage {
  #items = new Map();
  getItem = (key) => this.#items.get(key) ?? null;
  setItem = (key, value) => this.#items.set(key, value);
}

function windowWith(isConfigSupported, sessionStorage = new Storage()) {
  return {
    VideoDecoder: isConfigSupported && { isConfigSupported },
    sessionStorage,
    setTimeout: (callback) => setTimeout(callback, 5),
  };
}

async function offered(window, preference = 'auto') {
  const codecs = new Codecs(window);
  await codecs.ask();
  return codecs.offer(preference);
}

test('offers decodable codecs, the best first', async () => {
  assert.deepEqual(await offered(windowWith(async () => ({ supported: true }))), [h264, jpegPatches, jpeg]);
});

for (const [what, answer] of [
  ['has no decoder, as on plain http', undefined],
  ['decodes small pictures only', async ({ codec }) => ({ supported: codec !== 'avc1.42E028' })],
  ['does not know the question', async () => Promise.reject(new TypeError('what?'))],
  ['throws at once', () => { throw new TypeError('what?'); }],
  ['never answers', () => new Promise(() => {})],
]) {
  test(`a browser that ${what} gets JPEG`, async () => {
    assert.deepEqual(await offered(windowWith(answer)), [jpegPatches, jpeg]);
  });
}

// Fault: a server that takes JPEG, to save work, for a visitor who chose H.264.
test('offers only a codec that is requested by name', async () => {
  const window = windowWith(async () => ({ supported: true }));
  assert.deepEqual(await offered(window, 'h264'), [h264]);
  assert.deepEqual(await offered(window, 'jpeg'), [jpegPatches, jpeg]);
});

test('does not offer a failed codec again in this tab, even after a reload', async () => {
  const window = windowWith(async () => ({ supported: true }));
  const codecs = new Codecs(window);
  await codecs.ask();
  codecs.drop(h264);
  assert.deepEqual(codecs.offer('auto'), [jpegPatches, jpeg]);
  assert.deepEqual(codecs.offer('h264'), [jpegPatches, jpeg]);
  assert.deepEqual(await offered(window), [jpegPatches, jpeg]);
});

// Fault: a browser that cannot put patches together never gets a picture.
test('offers whole JPEGs if patches failed', async () => {
  const codecs = new Codecs(windowWith(undefined));
  await codecs.ask();
  codecs.drop(jpegPatches);
  assert.deepEqual(codecs.offer('auto'), [jpeg]);
  assert.deepEqual(codecs.offer('jpeg'), [jpeg]);
});

test('works without storage and with malformed storage', async () => {
  const supported = async () => ({ supported: true });
  const none = windowWith(supported, undefined);
  const codecs = new Codecs(none);
  await codecs.ask();
  codecs.drop(h264);
  assert.deepEqual(codecs.offer('auto'), [jpegPatches, jpeg]);
  assert.deepEqual(await offered(windowWith(supported, { getItem: () => '{7' })), [h264, jpegPatches, jpeg]);
  assert.deepEqual(await offered(windowWith(supported, { getItem: () => '7' })), [h264, jpegPatches, jpeg]);
});

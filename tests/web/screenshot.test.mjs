import assert from 'node:assert/strict';
import { test } from 'node:test';

import { Screenshot, pictureName, saveFile, takePicture } from '../../web/picture/screenshot.js';

test('the file name contains the time', () => {
  assert.equal(pictureName(new Date(2026, 2, 1, 7, 4, 9)), 'grove-2026-03-01-070409.png');
  assert.equal(pictureName(new Date(2026, 2, 1, 7, 4, 9), 'image/jpeg'), 'grove-2026-03-01-070409.jpg');
});

test('a picture is taken of a canvas of the page or of a worker', async () => {
  assert.equal(await takePicture({ toBlob: (give) => give('png') }), 'png');
  assert.equal(await takePicture({ convertToBlob: async ({ type }) => type }), 'image/png');
  await assert.rejects(takePicture({ toBlob: (give) => give(null) }));
});

/** A window whose browser can do so much. */
function browser({ downloads, shares }) {
  const done = [];
  const link = { click: () => done.push(link.download ? `download ${link.download}` : `open ${link.href}`) };
  if (downloads) link.download = '';
  return {
    done,
    document: { createElement: () => link },
    navigator: shares ? { canShare: () => true, share: ({ files }) => done.push(`share ${files[0].name}`) } : {},
    URL: { createObjectURL: () => 'blob:1', revokeObjectURL: () => done.push('revoked') },
    setTimeout: () => {},
  };
}

test('the file is downloaded, else shared, else opened', async () => {
  const cases = [
    [{ downloads: true, shares: true }, 'download a.png', /saved: a\.png/],
    [{ downloads: false, shares: true }, 'share a.png', /shared/],
    [{ downloads: false, shares: false }, 'open blob:1', /opened/],
  ];
  for (const [can, deed, words] of cases) {
    const window = browser(can);
    assert.match(await saveFile(window, { name: 'a.png' }), words);
    assert.deepEqual(window.done, [deed]);
  }
});

async function shoot(take, save) {
  const said = [];
  await new Screenshot({ take, save, say: (text) => said.push(text) }).shoot();
  return said;
}

test('reports the outcome, except a cancellation', async () => {
  const take = async () => new Blob(['x'], { type: 'image/png' });
  assert.deepEqual(await shoot(take, async ({ type }) => `as ${type}`), ['as image/png']);
  const fail = () => Promise.reject(new Error('no picture'));
  assert.deepEqual(await shoot(fail, null), ['The picture could not be saved.']);
  const abort = Object.assign(new Error('no'), { name: 'AbortError' });
  assert.deepEqual(await shoot(take, () => Promise.reject(abort)), []);
});

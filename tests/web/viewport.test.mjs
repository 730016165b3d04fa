import assert from 'node:assert/strict';
import { test } from 'node:test';

import { fitStream } from '../../web/picture/viewport.js';

for (const [window, ratio, wanted, coarse = false] of [
  [[1280, 720], 1, [1280, 720]],
  [[800, 500], 2, [1600, 1000]],
  [[1280, 720], 2, [1920, 1080]],
  [[2560, 1440], 1, [1920, 1080]],
  [[390, 844], 3, [499, 1080]],
  [[3440, 1440], 1, [1920, 804]],
  [[1000, 600], 1.25, [1250, 750]],
  [[4000, 20], 1, [1920, 16]],
  [[0, 0], 1, [16, 16]],
  // Phones, upright and lying; a small one that has fewer pixels than its bound; tablets are as other screens.
  [[390, 844], 3, [591, 1280], true],
  [[932, 430], 3, [1280, 591], true],
  [[500, 500], 2, [720, 720], true],
  [[640, 360], 1, [640, 360], true],
  [[1180, 820], 2, [1554, 1080], true],
]) {
  test(`${window.join(' x ')} at ${ratio}${coarse ? ' by touch' : ''} asks for ${wanted.join(' x ')}`, () => {
    assert.deepEqual(fitStream(...window, ratio, coarse), { width: wanted[0], height: wanted[1] });
  });
}

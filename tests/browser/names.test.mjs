import assert from 'node:assert/strict';
import { after, afterEach, before, beforeEach, test } from 'node:test';

import { Guests, Server, Visitor, launchBrowser } from './helpers.mjs';

let server;
let browser;
const guests = new Guests();

async function arrive(name, options) {
  const visitor = await Visitor.arrive(browser, `${server.url}?name=${encodeURIComponent(name)}`, options);
  guests.add(visitor);
  await visitor.until('picture', 'shown');
  return visitor;
}

/** Comes, walks ahead for so long (ms), and stands. */
async function walkAhead(name, milliseconds) {
  const visitor = await arrive(name);
  await visitor.page.keyboard.down('KeyW');
  await visitor.page.waitForTimeout(milliseconds);
  await visitor.page.keyboard.up('KeyW');
  return visitor;
}

before(async () => {
  browser = await launchBrowser();
});

// Where one arrives depends on how many came before.
beforeEach(async () => {
  server = await Server.start({ options: ['--scene', 'tests/browser/meadow.toml'] });
});

afterEach(async () => {
  await server?.end();
});

after(async () => {
  await browser?.close();
});

/** The names on the screen: text, whether anything but text is in it, and the rectangle (CSS pixels). */
function tags({ page }) {
  return page.evaluate(() =>
    [...document.querySelectorAll('#names span')].map((tag) => {
      const { left, right, top, bottom } = tag.getBoundingClientRect();
      const isText = [...tag.childNodes].every((node) => node.nodeType === Node.TEXT_NODE);
      return { text: tag.textContent, isText, opacity: Number(tag.style.opacity), left, right, top, bottom };
    }),
  );
}

async function untilTagged(visitor, count) {
  await visitor.page.waitForFunction((many) => document.querySelectorAll('#names span').length === many, count);
  // Whoever walked stands still, and no name moves any more.
  await visitor.page.waitForTimeout(1500);
  return tags(visitor);
}

/** The picture in the window's pixels, for difference of figures. */
function pixels({ page }) {
  return page.evaluate(() => {
    const { innerWidth: width, innerHeight: height } = window;
    const scratch = new OffscreenCanvas(width, height).getContext('2d');
    scratch.drawImage(document.querySelector('canvas'), 0, 0, width, height);
    const { data } = scratch.getImageData(0, 0, width, height);
    return { width, luma: Array.from({ length: width * height }, (_, i) => data[4 * i] + data[4 * i + 1] + data[4 * i + 2]) };
  });
}

function isSame(a, b) {
  return a.luma.every((value, i) => Math.abs(value - b.luma[i]) <= 90);
}

/** The picture once nothing has changed for three seconds: trees become sharp while a visitor stands still. */
async function settledPixels(visitor) {
  let last = await pixels(visitor);
  for (let same = 0; same < 3; ) {
    await visitor.page.waitForTimeout(1000);
    const now = await pixels(visitor);
    same = isSame(last, now) ? same + 1 : 0;
    last = now;
  }
  return last;
}

/** Where a picture first differs from another, from above: the row, and the middle of what differs within some rows of it. */
function topOfDifference(a, b) {
  const differs = (i) => Math.abs(a.luma[i] - b.luma[i]) > 90;
  const first = a.luma.findIndex((_, i) => differs(i));
  assert.ok(first >= 0, 'nobody is to be seen');
  const y = Math.floor(first / a.width);
  const columns = Array.from({ length: 6 * a.width }, (_, i) => y * a.width + i).filter(differs).map((i) => i % a.width);
  return { y, x: columns.reduce((sum, x) => sum + x, 0) / columns.length };
}

// Faults: boxes for letters that the server has no glyphs of; a name beside its figure, or at another frame's place.
test('names of any script appear above their figures, as text', async () => {
  const ada = await arrive('Ada');
  const alone = await settledPixels(ada);
  assert.deepEqual(await tags(ada), [], 'one does not read his own name');
  for (const name of ['日本 🌲', 'سلمى', '<b>Зоя</b>']) {
    const other = await walkAhead(name, 1700);
    const [tag] = await untilTagged(ada, 1);
    assert.equal(tag.text, name);
    assert.ok(tag.isText);
    assert.ok(tag.opacity > 0.9, `opacity ${tag.opacity}`);
    const head = topOfDifference(alone, await pixels(ada));
    assert.ok(Math.abs((tag.left + tag.right) / 2 - head.x) < 8, `${name} at ${tag.left} to ${tag.right}, head ${head.x}`);
    assert.ok(tag.bottom < head.y + 6 && tag.bottom > head.y - 24, `${name} ends at ${tag.bottom}, head ${head.y}`);
    await guests.leave(other);
    await untilTagged(ada, 0);
  }
});

// Faults: names written over each other; one that hides the name of somebody nearer.
test('the names of a crowd do not overlap', async () => {
  const ada = await arrive('Ada');
  const names = ['Maximiliane von Hohenstein', 'Ελένη Παπαδοπούλου', 'नमस्ते', 'דוד המלך', '김하늘', 'Ólafur Grímsson'];
  for (const [i, name] of names.entries()) await walkAhead(name, 3600 - 400 * i);
  const shown = (await untilTagged(ada, names.length)).filter(({ opacity }) => opacity > 0);
  assert.deepEqual(shown.map(({ text }) => text).sort(), [...names].sort());
  for (const [i, a] of shown.entries()) {
    for (const b of shown.slice(i + 1)) {
      const apart = a.right <= b.left || b.right <= a.left || a.bottom <= b.top || b.bottom <= a.top;
      assert.ok(apart, `${a.text} overlaps ${b.text}`);
    }
  }
  for (const { left, right } of shown) assert.ok(left >= -0.5 && right <= 640.5, 'within the window');
});

import assert from 'node:assert/strict';
import { mkdtempSync, readFileSync, rmSync, writeFileSync } from 'node:fs';
import { tmpdir } from 'node:os';
import { join } from 'node:path';
import { after, before, test } from 'node:test';
import { fileURLToPath } from 'node:url';

import { Server, Visitor, launchBrowser, statistics } from './helpers.mjs';

const kClearing = fileURLToPath(new URL('clearing.toml', import.meta.url));

let folder;
let server;
let browser;

before(async () => {
  folder = mkdtempSync(join(tmpdir(), 'grove-private-'));
  const scene = join(folder, 'clearing.toml');
  // A finer fire takes longer to make than one of the next pages to open.
  writeFileSync(scene, readFileSync(kClearing, 'utf8').replace('grid = 32', 'grid = 64'));
  server = await Server.start({ options: ['--private', '--scene', scene] });
  browser = await launchBrowser();
});

after(async () => {
  await browser?.close();
  await server?.end();
  rmSync(folder, { recursive: true, force: true });
});

/** Keeps every title that the page's notice ever has, in `titles`. */
function keepTitles() {
  window.titles = [];
  const keep = () => {
    const title = document.querySelector('[data-notice="title"]')?.textContent;
    if (title && title !== window.titles.at(-1)) window.titles.push(title);
  };
  new MutationObserver(keep).observe(document, { subtree: true, childList: true, characterData: true });
}

test('who waits for a world of his own is told his place, moves up and gets in', async () => {
  const arrive = (name) => Visitor.arrive(browser, `${server.url}?name=${name}`, {}, keepTitles);
  const visitors = await Promise.all(['Ada', 'Bob', 'Cem', 'Dot'].map(arrive));
  const told = await Promise.all(
    visitors.map(async (visitor) => {
      await visitor.until('connection', 'open');
      await visitor.frames(3);
      return visitor.page.evaluate(() => window.titles);
    }),
  );
  const waited = told.map((titles) => titles.slice(1, -1).map((title) => Number(title.match(/^Place (\d) in line$/)[1])));
  for (const [index, places] of waited.entries()) {
    assert.deepEqual([told[index].at(0), told[index].at(-1)], ['Grove', 'Your world is being prepared']);
    // Two moves may be told between two looks at the page: it need not be told each place.
    assert.deepEqual(places, [...new Set(places)].sort().reverse(), `places told: ${places}`);
  }
  assert.ok(waited.some((places) => places.length === 0), `the first waits for nobody: ${JSON.stringify(told)}`);
  assert.ok(waited.flat().includes(2), `nobody waited: ${JSON.stringify(told)}`);
  for (const visitor of visitors) {
    const { deviation } = statistics(await visitor.picture());
    assert.ok(deviation > 10, `the picture is uniform: deviation ${deviation}`);
    assert.ok(await visitor.page.locator('#notice').isHidden(), 'the notice covers the world');
    await visitor.leave();
  }
});

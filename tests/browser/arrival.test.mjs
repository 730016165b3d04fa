import assert from 'node:assert/strict';
import { mkdtempSync, readFileSync, rmSync, writeFileSync } from 'node:fs';
import { tmpdir } from 'node:os';
import { join } from 'node:path';
import { after, before, test } from 'node:test';
import { fileURLToPath } from 'node:url';

import { Server, Visitor, freePort, kPatience, launchBrowser, statistics } from './helpers.mjs';

const kClearing = fileURLToPath(new URL('clearing.toml', import.meta.url));
/** Of a thousand triangles: the page takes what there is of cores, and finer light fields only get what is left. */
const kModel = fileURLToPath(new URL('../models/gltf/lantern_tree.gltf', import.meta.url));
const kTree = `
[[object]]
type = "lightfield"
name = "lantern tree"
model = "${kModel}"
subdivision = 3
size = 64
lightings = 1
`;

let folder;
let starting;
let browser;
let url;
let isReady = false;

before(async () => {
  folder = mkdtempSync(join(tmpdir(), 'grove-arrival-'));
  // A machine that never ran Grove.
  process.env.GROVE_CACHE = join(folder, 'cache');
  const scene = join(folder, 'scene.toml');
  writeFileSync(scene, readFileSync(kClearing, 'utf8').replace('grid = 32', 'grid = 64') + kTree);
  browser = await launchBrowser();
  const port = await freePort();
  url = `http://127.0.0.1:${port}/`;
  starting = Server.start({ port, options: ['--scene', scene], coarse: true });
  starting.then(() => (isReady = true), () => {});
});

after(async () => {
  await browser?.close();
  await (await starting)?.end();
  rmSync(folder, { recursive: true, force: true });
});

async function untilThePageIsThere() {
  const end = performance.now() + kPatience;
  for (;;) {
    const answer = await fetch(url).catch(() => null);
    if (answer?.ok) return;
    if (performance.now() > end) throw new Error('no page comes');
    await new Promise((resolve) => setTimeout(resolve, 20));
  }
}

/** Keeps every title that the page's notice ever has, and every line on what gets finer. */
function keepWords() {
  window.titles = [];
  window.finer = [];
  const keep = (list, text) => {
    if (text && text !== list.at(-1)) list.push(text);
  };
  new MutationObserver(() => {
    keep(window.titles, document.querySelector('[data-notice="title"]')?.textContent);
    keep(window.finer, document.querySelector('#refining')?.textContent);
  }).observe(document, { subtree: true, childList: true, characterData: true });
}

test('an early visitor sees progress, the world, and its refinement', async () => {
  await untilThePageIsThere();
  assert.ok(!isReady, 'the page is there before the world');
  const visitor = await Visitor.arrive(browser, url, {}, keepWords);
  await visitor.until('connection', 'open');
  await visitor.frames(3);
  assert.ok(await visitor.page.locator('#notice').isHidden(), 'the notice covers the world');
  const { deviation } = statistics(await visitor.picture());
  assert.ok(deviation > 10, `the picture is uniform: deviation ${deviation}`);
  // Without a reload, or the titles would have begun anew.
  const titles = await visitor.page.evaluate(() => window.titles);
  assert.deepEqual(titles, ['Grove', 'The world is being prepared']);
  await visitor.page.waitForFunction(() => window.finer.some((text) => /100/.test(text)));
  assert.match(await visitor.page.evaluate(() => window.finer[0]), /^Improving the detail: \d+\s%/);
  assert.ok(await visitor.page.locator('#refining').isHidden(), 'all is done, and it says nothing more');
  await visitor.frames(3);
  await visitor.leave();
});

// Takes the README's pictures from the real page: `npm run pictures`.
import { mkdir } from 'node:fs/promises';
import { fileURLToPath } from 'node:url';

import { launchBrowser, Server, Visitor } from './helpers.mjs';

const kFolder = fileURLToPath(new URL('./pictures/', import.meta.url));
const kSize = { viewport: { width: 1280, height: 720 } };

async function take(visitor, name) {
  await visitor.frames(5);
  await visitor.page.screenshot({ path: `${kFolder}${name}.jpg`, type: 'jpeg', quality: 88 });
}

async function hold(visitor, code, milliseconds) {
  await visitor.page.keyboard.down(code);
  await visitor.page.waitForTimeout(milliseconds);
  await visitor.page.keyboard.up(code);
}

await mkdir(kFolder, { recursive: true });
const server = await Server.start();
const browser = await launchBrowser();
try {
  const ada = await Visitor.arrive(browser, `${server.url}?name=Ada`, kSize);
  await ada.page.waitForTimeout(12_000); // the hint has gone
  await take(ada, 'clearing');

  // Ben walks ahead into Ada's view, Cleo stays beside her, and turns to the two.
  const ben = await Visitor.arrive(browser, `${server.url}?name=Ben`, { viewport: { width: 320, height: 180 } });
  await hold(ben, 'KeyW', 1700);
  await hold(ben, 'KeyE', 500);
  await hold(ben, 'KeyW', 600);
  await hold(ben, 'KeyQ', 1500);
  const cleo = await Visitor.arrive(browser, `${server.url}?name=Cleo`, { viewport: { width: 320, height: 180 } });
  await hold(cleo, 'KeyW', 900);
  await ada.page.keyboard.press('o');
  await ada.page.waitForTimeout(1500);
  await take(ada, 'visitors');
} finally {
  await browser.close();
  await server.end();
}

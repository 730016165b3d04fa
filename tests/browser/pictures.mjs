// Takes the documents' pictures from the real page: `npm run pictures`.
import { mkdir } from 'node:fs/promises';
import { fileURLToPath } from 'node:url';

import { groveFrom, launchBrowser, Server, Visitor } from './helpers.mjs';

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

/** Four visitors' views side by side, as the paper's Figure 5.3. */
async function takeTogether(browser, visitors, name) {
  const views = [];
  for (const visitor of visitors) {
    await visitor.page.evaluate(() => {
      for (const element of document.querySelectorAll('main > :not(canvas, #names)')) element.style.visibility = 'hidden';
    });
    await visitor.frames(5);
    views.push((await visitor.page.locator('canvas').screenshot({ type: 'png' })).toString('base64'));
  }
  const page = await browser.newPage(kSize);
  const images = views.map((view) => `<img src="data:image/png;base64,${view}">`).join('');
  await page.setContent(
    `<style>body{margin:0;display:grid;grid-template-columns:1fr 1fr;gap:4px;background:#111}img{width:100%}</style>${images}`,
  );
  await page.screenshot({ path: `${kFolder}${name}.jpg`, type: 'jpeg', quality: 88 });
  await page.close();
}

/** The operator's page, once its charts have something to show. */
async function takeOperator(browser) {
  const page = await browser.newPage({ viewport: { width: 1400, height: 900 }, colorScheme: 'dark' });
  await page.goto(`${server.operatorUrl}operator`);
  await page.waitForTimeout(90_000);
  await page.screenshot({ path: `${kFolder}operator.jpg`, type: 'jpeg', quality: 88, fullPage: true });
  await page.close();
}

/** What a visitor sees who stands at a place of the built-in world. */
async function takeFrom(browser, place, name) {
  const server = await Server.start({ options: ['--scene', groveFrom(...place)] });
  try {
    const visitor = await Visitor.arrive(browser, server.url, kSize);
    await visitor.page.waitForTimeout(18_000); // the hint has gone, and trees are sharp
    await take(visitor, name);
    await visitor.page.close();
  } finally {
    await server.end();
  }
}

await mkdir(kFolder, { recursive: true });
const server = await Server.start();
const browser = await launchBrowser();
try {
  const ada = await Visitor.arrive(browser, `${server.url}?name=Ada`, kSize);
  await ada.page.waitForTimeout(18_000); // the hint has gone
  await take(ada, 'grove');

  // Ben and Cleo walk ahead into Ada's view, Dan to the west glade; each turns to something else.
  const small = { viewport: { width: 638, height: 358 } };
  const ben = await Visitor.arrive(browser, `${server.url}?name=Ben`, small);
  await hold(ben, 'KeyW', 1700);
  await hold(ben, 'KeyE', 500);
  await hold(ben, 'KeyW', 600);
  await hold(ben, 'KeyQ', 1500);
  const cleo = await Visitor.arrive(browser, `${server.url}?name=Cleo`, small);
  await hold(cleo, 'KeyW', 900);
  const dan = await Visitor.arrive(browser, `${server.url}?name=Dan`, small);
  await hold(dan, 'KeyQ', 500);
  await hold(dan, 'KeyW', 4200);
  await hold(dan, 'KeyE', 1800);
  await ada.page.keyboard.press('o');
  await ada.page.waitForTimeout(2500);
  await take(ada, 'visitors');
  await ada.page.keyboard.press('o');
  await ada.page.waitForTimeout(500);
  await takeTogether(browser, [ada, ben, cleo, dan], 'players');
  await takeOperator(browser);
  await server.end();
  await takeFrom(browser, [-8.2, 3, 38], 'under_an_oak');
  await takeFrom(browser, [-11.4, -3.2, 55], 'in_a_spruce');
  await takeFrom(browser, [10, 18, 33], 'stones');
  await takeFrom(browser, [0, 14, 180], 'forest');
  await takeFrom(browser, [2, 1.5, 50], 'fire');
  await takeFrom(browser, [-2.6, 6.9, 43], 'herd');
} finally {
  await browser.close();
  await server.end();
}

import assert from 'node:assert/strict';
import { after, before, test } from 'node:test';

import { Guests, Server, Visitor, difference, launchBrowser, statistics } from './helpers.mjs';

let server;
let browser;
const guests = new Guests();

async function arrive(name, options) {
  const visitor = await Visitor.arrive(browser, `${server.url}?name=${name}`, options);
  guests.add(visitor);
  await visitor.until('connection', 'open');
  await visitor.frames(3);
  return visitor;
}

before(async () => {
  server = await Server.start({ options: ['--scene', 'tests/browser/clearing.toml'] });
  browser = await launchBrowser();
});

after(async () => {
  await browser?.close();
  await server?.end();
});

/** Turns by dragging until the yaw is about `yaw` (radians), the shorter way. */
async function turnTo(visitor, yaw) {
  const { page } = visitor;
  for (let i = 0; i < 40; i += 1) {
    const now = Number((await visitor.state()).yaw);
    const rest = Math.atan2(Math.sin(yaw - now), Math.cos(yaw - now));
    if (Math.abs(rest) < 0.02) return;
    // To the left is positive yaw; a drag must stay in the window.
    const way = Math.max(-250, Math.min(250, -rest / 0.0023));
    const middle = page.viewportSize().width / 2;
    await page.mouse.move(middle, 100);
    await page.mouse.down();
    await page.mouse.move(middle + way, 100, { steps: 4 });
    await page.mouse.up();
    await visitor.frames(2);
  }
  assert.fail(`the view does not reach yaw ${yaw}`);
}

test('two visitors have different, moving pictures', async () => {
  const ada = await arrive('Ada');
  const bob = await arrive('Bob');
  for (const visitor of [ada, bob]) {
    const { mean, deviation } = statistics(await visitor.picture());
    assert.ok(mean > 25 && mean < 235, `mean brightness ${mean}`);
    assert.ok(deviation > 10, `the picture is uniform: deviation ${deviation}`);
  }
  const idle = difference(await ada.meanPicture(5), await ada.meanPicture(5));
  const apart = difference(await ada.meanPicture(5), await bob.meanPicture(5));
  assert.ok(apart > 1.5 * idle && apart > 2, `cameras differ by ${apart}, an idle one by ${idle}`);

  await ada.frames(20);
  await bob.frames(20);
});

test("one visitor's gust moves the smoke that another sees", async () => {
  const ada = await arrive('Ada');
  const bob = await arrive('Bob');
  const idle = [];
  for (let i = 0; i < 4; i += 1) idle.push(await bob.meanPicture(8));
  const noise = Math.max(...idle.slice(1).map((picture) => difference(picture, idle[0])));

  await ada.page.mouse.click(320, 180);
  await ada.until('pointer', 'locked');
  await ada.page.mouse.down();
  let gust = 0;
  for (let i = 0; i < 5 && gust <= 1.5 * noise; i += 1) {
    gust = Math.max(gust, difference(await bob.meanPicture(8), idle[0]));
  }
  await ada.page.mouse.up();
  assert.ok(gust > 1.5 * noise, `with the gust ${gust}, without ${noise}`);
});

test("one sees the other's figure, until they leave", async () => {
  const ada = await arrive('Ada');
  const bob = await arrive('Bob');
  const first = Number((await ada.state()).yaw);
  // Visitors arrive side by side, so one of the two sides shows the other.
  const views = [];
  for (const side of [Math.PI / 2, -Math.PI / 2]) {
    await turnTo(ada, first + side);
    views.push({ side, with: await ada.meanPicture(5), idle: 0 });
    views.at(-1).idle = difference(views.at(-1).with, await ada.meanPicture(5));
  }
  await guests.leave(bob);
  await ada.until('visitors', '1');
  const changes = [];
  for (const view of views) {
    await turnTo(ada, first + view.side);
    changes.push(difference(view.with, await ada.meanPicture(5)) / Math.max(view.idle, 1));
  }
  assert.ok(Math.max(...changes) > 2, `changes on both sides, in multiples of an idle view: ${changes}`);
});

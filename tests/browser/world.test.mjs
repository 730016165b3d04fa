import assert from 'node:assert/strict';
import { after, afterEach, before, test } from 'node:test';

import { Server, Visitor, difference, idleDifference, launchBrowser, pause, statistics } from './helpers.mjs';

let server;
let browser;
let guests = [];

async function arrive(name, options) {
  const visitor = await Visitor.arrive(browser, `${server.url}?name=${name}`, options);
  guests.push(visitor);
  await visitor.until('connection', 'open');
  await visitor.frames(3);
  return visitor;
}

before(async () => {
  server = await Server.start();
  browser = await launchBrowser();
});

afterEach(async () => {
  const leaving = guests;
  guests = [];
  for (const visitor of leaving) await visitor.leave();
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

test('two visitors see the same world from two places, and it lives', async () => {
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

/** Means of red, green and blue in a part of a 160 x 90 picture, and how much neighbouring pixels differ. */
function look(picture, { left, top, right, bottom }) {
  const sum = [0, 0, 0];
  let rough = 0;
  for (let y = top; y < bottom; y += 1) {
    for (let x = left; x < right; x += 1) {
      for (let channel = 0; channel < 3; channel += 1) sum[channel] += picture[(y * 160 + x) * 4 + channel];
      rough += Math.abs(picture[(y * 160 + x) * 4 + 1] - picture[(y * 160 + x + 1) * 4 + 1]);
    }
  }
  const count = (right - left) * (bottom - top);
  return { red: sum[0] / count, green: sum[1] / count, blue: sum[2] / count, rough: rough / count };
}

test('a grove of light fields stands around the clearing', async () => {
  const ada = await arrive('Ada');
  await ada.page.waitForTimeout(500);
  const picture = await ada.picture();
  const oak = look(picture, { left: 10, top: 14, right: 42, bottom: 34 });
  const sky = look(picture, { left: 58, top: 2, right: 74, bottom: 14 });
  assert.ok(oak.green > oak.blue + 8, `leaves are green: ${JSON.stringify(oak)}`);
  assert.ok(oak.green < 0.75 * sky.green, `and darker than the sky behind them: ${JSON.stringify(sky)}`);
  assert.ok(oak.rough > 2 * sky.rough, 'and not smooth');

  // Every light field has come: the backend made pictures, and none failed.
  const { counters, stages } = await (await fetch(`${server.url}statistics.json`)).json();
  assert.ok(counters['view cache misses'] > 5, JSON.stringify(counters));
  assert.equal(stages.Renderer.failures, 0);
});

test('walking changes what one sees, by letters and by arrows', async () => {
  const ada = await arrive('Ada');
  const idle = await idleDifference(ada);
  for (const [key, back] of [['KeyW', 'KeyS'], ['ArrowUp', 'ArrowDown']]) {
    const before = await ada.picture();
    await ada.page.keyboard.down(key);
    await pause(1200);
    await ada.page.keyboard.up(key);
    await ada.frames(3);
    const walked = difference(before, await ada.picture());
    assert.ok(walked > 1.5 * idle && walked > 2, `${key}: ${walked}, idle ${idle}`);
    await ada.page.keyboard.down(back);
    await pause(1200);
    await ada.page.keyboard.up(back);
  }
});

test('a click takes the pointer and the mouse looks', async () => {
  const ada = await arrive('Ada');
  await ada.page.mouse.click(320, 180);
  await ada.until('pointer', 'locked');
  const before = await ada.state();
  await ada.page.mouse.move(420, 130, { steps: 8 });
  await ada.frames(4);
  const after = await ada.state();
  assert.ok(Number(after.yaw) < Number(before.yaw), 'right turns right');
  assert.ok(Number(after.pitch) > Number(before.pitch), 'up looks up');
  await ada.page.evaluate(() => document.exitPointerLock());
  await ada.until('pointer', 'free');
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
  guests = [ada];
  await bob.leave();
  await ada.until('visitors', '1');
  const changes = [];
  for (const view of views) {
    await turnTo(ada, first + view.side);
    changes.push(difference(view.with, await ada.meanPicture(5)) / Math.max(view.idle, 1));
  }
  assert.ok(Math.max(...changes) > 3, `changes on both sides, in multiples of an idle view: ${changes}`);
});

test('a finger on the right looks around, one on the left walks', async () => {
  const ada = await arrive('Ada', { viewport: { width: 640, height: 360 }, hasTouch: true, isMobile: true });
  const idle = await idleDifference(ada);
  const touch = await ada.context.newCDPSession(ada.page);
  const fingers = (type, points) => touch.send('Input.dispatchTouchEvent', { type, touchPoints: points });

  const before = await ada.picture();
  const from = await ada.state();
  await fingers('touchStart', [{ x: 500, y: 180 }]);
  for (let x = 500; x >= 350; x -= 15) await fingers('touchMove', [{ x, y: 180 }]);
  await fingers('touchEnd', []);
  await ada.frames(4);
  const turned = Number((await ada.state()).yaw) - Number(from.yaw);
  assert.ok(turned > 0.3, `turned left by ${turned}`);
  const looked = difference(before, await ada.picture());
  assert.ok(looked > 1.5 * idle && looked > 2, `${looked}, idle ${idle}`);

  const standing = await ada.picture();
  await fingers('touchStart', [{ x: 120, y: 240 }]);
  await fingers('touchMove', [{ x: 120, y: 190 }]);
  await pause(1200);
  assert.ok(await ada.page.isVisible('#stick'));
  await fingers('touchEnd', []);
  await ada.frames(3);
  const walked = difference(standing, await ada.picture());
  assert.ok(walked > 1.5 * idle && walked > 2, `${walked}, idle ${idle}`);
  assert.ok(await ada.page.isHidden('#stick'));
});

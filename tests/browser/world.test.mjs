import assert from 'node:assert/strict';
import { after, before, test } from 'node:test';

import { Guests, Server, Visitor, coarseGrove, difference, idleDifference, launchBrowser, pause } from './helpers.mjs';

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
  server = await Server.start({ options: ['--scene', coarseGrove()] });
  browser = await launchBrowser();
});

after(async () => {
  await browser?.close();
  await server?.end();
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
  const { counters, stages } = await (await fetch(`${server.operatorUrl}statistics.json`)).json();
  assert.ok(counters['view cache misses'] > 5, JSON.stringify(counters));
  assert.equal(stages.Renderer.failures, 0);
});

test('letters and arrows walk', async () => {
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

test('a click locks the pointer and the mouse turns the view', async () => {
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

test('the right finger turns, the left one walks', async () => {
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

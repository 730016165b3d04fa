import assert from 'node:assert/strict';
import { after, before, test } from 'node:test';

import { Server, Visitor, coarseGrove, freePort, launchBrowser } from './helpers.mjs';

let browser;
let server;

before(async () => {
  browser = await launchBrowser();
  server = await Server.start({ options: ['--scene', coarseGrove()] });
});

after(async () => {
  await browser?.close();
  await server?.end();
});

async function arrive(options) {
  const visitor = await Visitor.arrive(browser, server.url, options);
  await visitor.until('connection', 'open');
  await visitor.frames(2);
  return visitor;
}

test('the stream follows the size of the window', async () => {
  const ada = await arrive();
  await ada.until('streamSize', '640x360');
  await ada.page.setViewportSize({ width: 800, height: 400 });
  await ada.until('streamSize', '800x400');
  const shown = await ada.page.evaluate(() => {
    const { width, height, clientWidth, clientHeight } = document.querySelector('canvas');
    return { width, height, clientWidth, clientHeight };
  });
  assert.deepEqual(shown, { width: 800, height: 400, clientWidth: 800, clientHeight: 400 });
  await ada.leave();
});

test('a dense screen gets more pixels, up to a bound', async () => {
  const dense = await arrive({ viewport: { width: 400, height: 300 }, deviceScaleFactor: 2 });
  await dense.until('streamSize', '800x600');
  await dense.page.setViewportSize({ width: 1280, height: 720 });
  await dense.until('streamSize', '1920x1080');
  await dense.leave();
});

test('the overlay shows finite figures, by key and by button', async () => {
  const ada = await arrive();
  const overlay = ada.page.locator('#overlay');
  assert.ok(await overlay.isHidden());
  for (const toggle of [
    () => ada.page.keyboard.press('o'),
    () => ada.page.keyboard.press('F3'),
    () => ada.page.getByRole('button', { name: 'Statistics' }).click(),
  ]) {
    await toggle();
    await overlay.waitFor({ state: 'visible' });
    await ada.page.waitForFunction(() =>
      [...document.querySelectorAll('[data-rows=stream] dd')].every((figure) => /^[0-9]|^H\.264$/.test(figure.textContent)),
    );
    const figures = await ada.page.$$eval('#overlay dd', (all) =>
      Object.fromEntries(all.map((figure) => [figure.dataset.figure, figure.textContent])),
    );
    assert.match(figures.version, /^\d+\.\d+\.\d+$/);
    for (const [name, figure] of Object.entries(figures)) {
      assert.doesNotMatch(figure, /NaN|Infinity|undefined|null/, name);
    }
    assert.ok(parseFloat(figures.latency) >= 0 && parseFloat(figures.rate) > 0, JSON.stringify(figures));
    await toggle();
    await overlay.waitFor({ state: 'hidden' });
  }
  assert.ok(Number.isFinite(Number((await ada.state()).latencyMs)));
  await ada.leave();
});

test('the overlay shows what sharing saves, with explanations', async () => {
  const ada = await arrive();
  await ada.page.keyboard.press('o');
  await ada.page.getByText('All statistics').click();
  await ada.page.locator('[data-rows=savings]').waitFor({ state: 'visible' });
  const lines = await ada.page.$$eval('[data-rows=savings] > div:not([hidden])', (all) =>
    all.map((line) => ({ text: [...line.children].map((part) => part.textContent).join(' '), title: line.title })),
  );
  const whole = lines.map(({ text }) => text).join(', ');
  assert.match(whole, /^Shared work \u03b1 (< |> )?\d+ %, /);
  assert.match(whole, /For everybody [\d,.]+ ms, For you [\d,.]+ ms, One more visitor [\d,.]+ cores/);
  assert.match(whole, /Room for (1 visitor|\d+ visitors), Without sharing (none|at most \d+)/);
  assert.doesNotMatch(whole, /NaN|Infinity|undefined|null|Sharing off/);
  for (const { text, title } of lines) assert.ok(title.length > 20, `${text} is explained`);
  await ada.leave();
});

test('the overlay starts with four figures and expands', async () => {
  const ada = await arrive();
  await ada.page.keyboard.press('o');
  const terms = () => ada.page.locator('#overlay dt').filter({ visible: true }).allTextContents();
  assert.deepEqual(await terms(), ['Frame rate', 'Latency', 'Picture quality', 'Limited by']);
  await ada.page.getByText('All statistics').click();
  await ada.page.getByText('Round trip').waitFor();
  assert.ok((await terms()).length > 20);
  await ada.page.getByText('All statistics').click();
  assert.equal((await terms()).length, 4);
  await ada.leave();
});

test('buttons have tooltips with their keys', async () => {
  const ada = await arrive();
  const tips = await ada.page.$$eval('#tools button', (all) => all.map((button) => button.title));
  assert.deepEqual(tips, ['Statistics (O or F3)', 'Visitors (V)', 'Screenshot (C)', 'Settings (P)', 'Full screen (F)']);
  await ada.leave();
});

test('every button has a name, and the keyboard reaches it', async () => {
  const ada = await arrive();
  const names = [];
  for (let i = 0; i < 7; i += 1) {
    await ada.page.keyboard.press('Tab');
    names.push(await ada.page.evaluate(() => document.activeElement.getAttribute('aria-label')));
  }
  const wanted = ['Statistics', 'Visitors', 'Screenshot', 'Settings', 'Full screen'];
  assert.ok(wanted.every((name) => names.includes(name)), names.join(', '));
  await ada.leave();
});

test('reconnects after a restart of the server', async () => {
  const port = await freePort();
  const options = ['--scene', coarseGrove()];
  let mortal = await Server.start({ port, options });
  const ada = await Visitor.arrive(browser, mortal.url);
  try {
    await ada.until('connection', 'open');
    await ada.frames(3);
    await mortal.end('SIGKILL');
    await ada.until('connection', 'lost');
    await ada.page.getByText('Connection lost').waitFor();
    assert.match(await ada.page.getByRole('status').textContent(), /Connection lost.*Trying to reconnect/s);

    mortal = await Server.start({ port, options });
    await ada.until('connection', 'open');
    await ada.frames(5);
    await ada.page.getByText('Connection lost').waitFor({ state: 'hidden' });
  } finally {
    await mortal.end();
  }
  // The browser itself reports each refused connection.
  await ada.leave(/WebSocket connection to .* failed/);
});

test('a full server is explained', async () => {
  // The scene that is served if none is named; its fine light fields would take minutes.
  const small = await Server.start({ options: ['--max-visitors', '1'], coarse: true });
  try {
    const ada = await Visitor.arrive(browser, small.url);
    await ada.until('connection', 'open');
    await ada.frames(2);
    const bob = await Visitor.arrive(browser, small.url);
    await bob.until('connection', 'full');
    await bob.page.getByText('The world is full (1 visitor).').waitFor();
    await ada.frames(5);
    await ada.leave();

    await bob.page.getByRole('button', { name: 'Try again now' }).click();
    await bob.until('connection', 'open');
    await bob.frames(2);
    await bob.leave();
  } finally {
    await small.end();
  }
});

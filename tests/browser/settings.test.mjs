import assert from 'node:assert/strict';
import { readFile } from 'node:fs/promises';
import { after, before, test } from 'node:test';
import { fileURLToPath } from 'node:url';

import { kPatience, Server, Visitor, launchBrowser, statistics } from './helpers.mjs';

const kClearing = fileURLToPath(new URL('clearing.toml', import.meta.url));
const kForward = 1;

let browser;
let server;

before(async () => {
  browser = await launchBrowser();
  server = await Server.start({ options: ['--scene', kClearing] });
});

after(async () => {
  await browser?.close();
  await server?.end();
});

async function arrive(options, script) {
  const visitor = await Visitor.arrive(browser, server.url, options, script);
  await enter(visitor);
  return visitor;
}

async function enter(visitor) {
  await visitor.until('connection', 'open');
  await visitor.until('picture', 'shown');
}

const panelOf = (visitor) => visitor.page.locator('#settings');
const focused = (visitor) => visitor.page.evaluate(() => document.activeElement.id);

async function tabTo(visitor, id) {
  for (let i = 0; i < 60; i += 1) {
    if ((await focused(visitor)) === id) return;
    await visitor.page.keyboard.press('Tab');
  }
  assert.fail(`Tab never reaches ${id}`);
}

/** Keeps the keys of every input that the page sends, in `window.sentKeys`. */
function keepInputs() {
  delete window.Worker; // whose socket no script reaches
  window.sentKeys = [];
  const send = WebSocket.prototype.send;
  WebSocket.prototype.send = function keep(data) {
    const bytes = new Uint8Array(data);
    if (bytes[0] === 0x02) window.sentKeys.push(bytes[1]);
    send.call(this, data);
  };
}

/** The keys of controls that the page tells the server while this key is down. */
async function sentWhile(visitor, key) {
  await visitor.page.evaluate(() => (window.sentKeys.length = 0));
  await visitor.page.keyboard.down(key);
  // The state at rest is sent once a second, too.
  const sent = await visitor.page.waitForFunction(() => window.sentKeys.find((keys) => keys !== 0));
  const keys = await sent.jsonValue();
  await visitor.page.keyboard.up(key);
  return keys;
}

test('the panel opens and closes by button and by key, and the keyboard alone can use it', async () => {
  const ada = await arrive();
  const panel = panelOf(ada);
  const button = ada.page.getByRole('button', { name: 'Settings', exact: true });
  await button.click();
  await panel.waitFor({ state: 'visible' });
  assert.equal(await button.getAttribute('aria-expanded'), 'true');
  await ada.page.getByRole('button', { name: 'Close settings' }).click();
  await panel.waitFor({ state: 'hidden' });

  await ada.page.locator('#world').focus();
  await ada.page.keyboard.press('p');
  await panel.waitFor({ state: 'visible' });
  assert.equal(await focused(ada), 'settings-title', 'the focus goes in');
  await tabTo(ada, 'setting-lines');
  await ada.page.keyboard.press('ArrowDown');
  await tabTo(ada, 'setting-fps');
  const back = ada.page.getByRole('button', { name: /^Walk back, second key/ });
  await back.focus();
  for (const key of ['Space', 'Space', 'Enter', 'KeyK']) await ada.page.keyboard.press(key);
  assert.equal(await back.textContent(), 'K', 'a taken space bar does not press the button');
  await panelOf(ada).getByText('Walk back: K.').waitFor();
  await ada.page.keyboard.press('Escape');
  await panel.waitFor({ state: 'hidden' });
  assert.equal(await focused(ada), 'world', 'and returns');
  assert.equal(await ada.page.evaluate(() => JSON.parse(localStorage['grove.settings']).lines), 1080);

  await ada.page.keyboard.press('p');
  await panel.waitFor({ state: 'visible' });
  await ada.page.keyboard.press('p');
  await panel.waitFor({ state: 'hidden' });
  await ada.leave();
});

test('the panel frees the pointer, and a click into the world closes it', async () => {
  const ada = await arrive({ viewport: { width: 1000, height: 600 } });
  await ada.page.mouse.click(200, 300);
  await ada.until('pointer', 'locked');
  await ada.page.keyboard.press('p');
  await ada.until('pointer', 'free');
  await panelOf(ada).waitFor({ state: 'visible' });
  // Chromium grants no new lock within a second or so of the last one.
  await ada.page.waitForTimeout(1500);
  await ada.page.mouse.click(200, 300);
  await ada.until('pointer', 'locked');
  await panelOf(ada).waitFor({ state: 'hidden' });
  await ada.leave();
});

test('choices survive a reload and can be reset', async () => {
  const ada = await arrive({}, keepInputs);
  const field = (label) => ada.page.getByLabel(label, { exact: true });
  await ada.page.keyboard.press('p');
  await field('Name').pressSequentially('Wasd Ada ');
  assert.equal(await ada.page.evaluate(() => window.sentKeys.some((keys) => keys !== 0)), false, 'typing walks');
  await field('Sensitivity').fill('2');
  await field('Invert up and down').check();
  await field('Codec').selectOption('jpeg');
  await field('Maximum frame rate').selectOption('20');
  await ada.page.waitForFunction(() => /JPEG, 640 × 360/.test(document.querySelector('[data-stream]').textContent));
  await ada.page.reload();
  await enter(ada);
  await ada.page.keyboard.press('p');
  const read = async () => [
    await field('Name').inputValue(),
    await field('Sensitivity').inputValue(),
    await field('Invert up and down').isChecked(),
    await field('Codec').inputValue(),
    await field('Maximum frame rate').inputValue(),
  ];
  assert.deepEqual(await read(), ['Wasd Ada', '2', true, 'jpeg', '20']);
  await ada.page.getByRole('button', { name: 'Reset to defaults' }).click();
  assert.deepEqual(await read(), ['', '1', false, 'auto', '0']);
  await ada.leave();
});

test('a chosen key walks, the former one does not, and the hint shows it', async () => {
  const ada = await arrive({}, keepInputs);
  assert.equal(await sentWhile(ada, 'KeyW'), kForward);
  await ada.page.keyboard.press('p');
  const forward = ada.page.getByRole('button', { name: /^Walk forward, key:/ });
  await forward.click();
  await ada.page.keyboard.press('Escape');
  assert.equal(await forward.textContent(), 'W', 'Escape keeps it');
  await forward.click();
  await ada.page.keyboard.press('F5');
  await panelOf(ada).getByText('The browser needs this key').waitFor();
  await ada.page.keyboard.press('KeyF');
  await panelOf(ada).getByText('Walk forward: F. Full screen now has W.').waitFor();
  await ada.page.keyboard.press('Escape');
  await panelOf(ada).waitFor({ state: 'hidden' });
  assert.equal(await sentWhile(ada, 'KeyF'), kForward);
  assert.match(await ada.page.locator('.for-mouse').textContent(), /FASD or arrows/);
  assert.equal(await ada.page.locator('#fullscreen').getAttribute('aria-keyshortcuts'), 'W');
  await ada.leave();
});

test('sensitivity and inversion change the turn of a drag', async () => {
  const ada = await arrive();
  const direction = async () => {
    await ada.frames(3);
    const { yaw, pitch } = await ada.state();
    return { yaw: Number(yaw), pitch: Number(pitch) };
  };
  const drag = async () => {
    const before = await direction();
    await ada.page.mouse.move(100, 100);
    await ada.page.mouse.down();
    await ada.page.mouse.move(140, 120, { steps: 4 });
    await ada.page.mouse.up();
    const now = await direction();
    return { yaw: now.yaw - before.yaw, pitch: now.pitch - before.pitch };
  };
  const plain = await drag();
  await ada.page.evaluate(() => localStorage.setItem('grove.settings', '{"sensitivity": 2, "invertY": true}'));
  await ada.page.reload();
  await enter(ada);
  const changed = await drag();
  assert.ok(plain.yaw < -0.05 && plain.pitch < -0.02, JSON.stringify(plain));
  assert.ok(Math.abs(changed.yaw - 2 * plain.yaw) < 0.01, JSON.stringify([plain, changed]));
  assert.ok(Math.abs(changed.pitch + 2 * plain.pitch) < 0.01, JSON.stringify([plain, changed]));
  await ada.leave();
});

// Faults: a screenshot as small as the stream of a slow line; one that is empty, or that only a button takes.
test('a screenshot is a JPEG of the full window however small the stream is, by button and by key', async () => {
  const small = () => localStorage.setItem('grove.settings', JSON.stringify({ lines: 360 }));
  const ada = await arrive({ viewport: { width: 1280, height: 720 } }, small);
  await ada.until('streamSize', '640x360');
  for (const shoot of [() => ada.page.keyboard.press('c'), () => ada.page.locator('#screenshot').click()]) {
    const [download] = await Promise.all([ada.page.waitForEvent('download'), shoot()]);
    assert.match(download.suggestedFilename(), /^grove-\d{4}-\d\d-\d\d-\d{6}\.jpg$/);
    const file = await readFile(await download.path());
    const { size, pixels } = await ada.page.evaluate(async (base64) => {
      const bytes = Uint8Array.from(atob(base64), (character) => character.charCodeAt(0));
      const bitmap = await createImageBitmap(new Blob([bytes]));
      const context = new OffscreenCanvas(64, 36).getContext('2d');
      context.drawImage(bitmap, 0, 0, 64, 36);
      const pixels = Array.from(context.getImageData(0, 0, 64, 36).data);
      return { size: [bitmap.width, bitmap.height], pixels };
    }, file.toString('base64'));
    assert.deepEqual(size, [1280, 720]);
    assert.ok(statistics(pixels).deviation > 10, 'the picture is uniform');
    await ada.page.getByRole('status').getByText(`Picture saved: ${download.suggestedFilename()}`).waitFor();
  }
  await ada.leave();
});

test('every control has an accessible name', async () => {
  const ada = await arrive();
  await ada.page.keyboard.press('p');
  await panelOf(ada).waitFor({ state: 'visible' });
  const session = await ada.context.newCDPSession(ada.page);
  const { nodes } = await session.send('Accessibility.getFullAXTree');
  const roles = ['button', 'combobox', 'textbox', 'checkbox', 'slider', 'dialog', 'table'];
  const controls = nodes.filter((node) => !node.ignored && roles.includes(node.role.value));
  const names = controls.map((node) => `${node.role.value}: ${node.name?.value ?? ''}`);
  assert.deepEqual(names.filter((name) => name.endsWith(': ')), []);
  assert.ok(names.includes('button: Look up, key: page up') && names.includes('slider: Sensitivity'), names.join('\n'));
  assert.ok(names.includes('dialog: Settings') && names.includes('combobox: Codec'), names.join('\n'));
  assert.ok(controls.length >= 40, `${controls.length} controls`);
  await ada.leave();
});

for (const [width, height] of [[360, 640], [390, 844], [844, 390]]) {
  test(`a phone of ${width} x ${height} reaches and reads everything`, async () => {
    const ada = await arrive({ viewport: { width, height }, hasTouch: true, isMobile: true });
    const covers = await ada.page.evaluate(() => {
      const line = document.querySelector('#line');
      line.textContent = 'Your browser is busy: 1080 lines, 30 frames/s';
      line.hidden = false;
      const { right, bottom } = line.getBoundingClientRect();
      return [...document.querySelectorAll('#tools button')].some((button) => {
        const { left, top } = button.getBoundingClientRect();
        return left < right && top < bottom && button.getBoundingClientRect().bottom > line.getBoundingClientRect().top;
      });
    });
    assert.equal(covers, false, 'the words on who is short cover a button');
    await ada.page.locator('#figures').tap();
    const page = await ada.page.evaluate(() => {
      const box = (element) => element.getBoundingClientRect();
      const overlay = box(document.querySelector('#overlay'));
      const hint = box(document.querySelector('#hint'));
      return {
        small: [...document.querySelectorAll('#tools button, #blow')].filter((button) => {
          const { left, right, top, bottom, width: w, height: h } = box(button);
          const shown = document.elementFromPoint((left + right) / 2, (top + bottom) / 2)?.closest('button');
          const isOut = left < 0 || right > innerWidth || top < 0 || bottom > innerHeight;
          return w < 44 || h < 44 || isOut || shown !== button;
        }).map((button) => button.id),
        covered: [...document.querySelectorAll('#tools button')].some((button) => {
          const { left, top } = box(button);
          return left < overlay.right && top < overlay.bottom && box(button).bottom > overlay.top;
        }),
        share: (overlay.width * overlay.height) / (innerWidth * innerHeight),
        hint: hint.left >= 0 && hint.right <= innerWidth && hint.bottom <= innerHeight && hint.top > overlay.bottom,
      };
    });
    const { share, ...rest } = page;
    assert.deepEqual(rest, { small: [], covered: false, hint: true });
    assert.ok(share < 0.4, `the figures cover ${share} of the screen`);

    await ada.page.locator('#settings-button').tap();
    await panelOf(ada).waitFor({ state: 'visible' });
    const panel = await ada.page.evaluate(() => {
      const sheet = document.querySelector('#settings .sheet');
      const controls = [...document.querySelectorAll('#settings :is(button, select, input)')];
      const small = controls.filter((control) => {
        control.scrollIntoView({ block: 'nearest' });
        const target = control.type === 'checkbox' ? control.labels[0] : control;
        const { left, right, top, bottom, height: h, width: w } = target.getBoundingClientRect();
        const shown = document.elementFromPoint((left + right) / 2, (top + bottom) / 2);
        return w < 44 || h < 44 || left < 0 || right > innerWidth || bottom > innerHeight || !target.contains(shown);
      });
      const { width: w, height: h } = document.querySelector('#settings').getBoundingClientRect();
      return {
        small: small.map((control) => control.outerHTML),
        wide: sheet.scrollWidth > sheet.clientWidth,
        modal: document.querySelector('#settings').matches(':modal'),
        w,
        h,
      };
    });
    assert.deepEqual(panel, { small: [], wide: false, modal: true, w: width, h: height });
    await ada.page.getByRole('button', { name: 'Close settings' }).tap();
    await panelOf(ada).waitFor({ state: 'hidden' });
    await ada.leave();
  });
}

test('unsupported features are shown with the reason', async () => {
  const poor = await arrive({}, () => {
    delete window.Worker;
    delete window.VideoDecoder;
    HTMLCanvasElement.prototype.getContext = new Proxy(HTMLCanvasElement.prototype.getContext, {
      apply: (real, canvas, kind) => (/webgl/.test(kind[0]) ? null : Reflect.apply(real, canvas, kind)),
    });
  });
  await poor.page.keyboard.press('p');
  const option = poor.page.locator('option[value=h264]');
  assert.ok(await option.isDisabled());
  assert.match(await option.textContent(), /this browser has no WebCodecs/);
  assert.ok(await poor.page.getByLabel('Instant turning').isDisabled());
  await panelOf(poor).getByText('Needs WebGL').waitFor();
  await poor.leave();
});

test('a page that cannot start explains it', async () => {
  const tell = async (prepare, words) => {
    const context = await browser.newContext();
    const page = await context.newPage();
    page.setDefaultTimeout(kPatience);
    await prepare(page);
    await page.goto(server.url);
    await page.getByRole('status').getByText('Grove cannot start here').waitFor();
    await page.getByText(words).waitFor();
    await context.close();
  };
  const broken = { contentType: 'text/javascript', body: 'not ( script' };
  await tell((page) => page.route('**/main.js', (route) => route.fulfill(broken)), 'too old for this page');
  // A browser without WebSocket has none in a worker either.
  const noSocket = () => ['WebSocket', 'Worker'].forEach((name) => delete window[name]);
  await tell((page) => page.addInitScript(noSocket), 'does not support WebSocket');
});

import assert from 'node:assert/strict';
import { after, before, test } from 'node:test';

import { Server, Visitor, launchBrowser } from './helpers.mjs';

let server;
let browser;

before(async () => {
  server = await Server.start({ options: ['--scene', 'tests/browser/clearing.toml'] });
  browser = await launchBrowser();
});

after(async () => {
  await browser?.close();
  await server?.end();
});

/** In the page: listens to all that is sent to the loudspeakers. */
function listenIn() {
  const { connect } = AudioNode.prototype;
  window.heard = [];
  AudioNode.prototype.connect = function connectHeard(to, ...rest) {
    if (to instanceof AudioDestinationNode) {
      const analyser = new AnalyserNode(this.context, { fftSize: 32768 });
      window.heard.push(analyser);
      connect.call(this, analyser);
    }
    return connect.call(this, to, ...rest);
  };
}

/** Loudness of each sound: root of the mean square of the last samples; nothing while the page plays none. */
function loudness({ page }) {
  return page.evaluate(() =>
    window.heard.map((analyser) => {
      if (analyser.context.state !== 'running') return 0;
      const samples = new Float32Array(analyser.fftSize);
      analyser.getFloatTimeDomainData(samples);
      return Math.sqrt(samples.reduce((sum, value) => sum + value * value, 0) / samples.length);
    }),
  );
}

async function arrive() {
  const ada = await Visitor.arrive(browser, `${server.url}?name=Ada`, {}, listenIn);
  await ada.until('picture', 'shown');
  return ada;
}

// Faults: a page that sounds before anybody has touched it, which browsers complain about; a switch that does nothing.
test('there is no sound before the first click, then wind and fire, until it is switched off', async () => {
  const ada = await arrive();
  assert.deepEqual(await loudness(ada), []);
  await ada.page.locator('#settings-button').click();
  await ada.page.waitForTimeout(2500);
  const [wind, fire] = await loudness(ada);
  assert.ok(wind > 0.0003, `wind ${wind}`);
  assert.ok(fire > 0.0003, `fire ${fire}`);
  const sound = ada.page.getByLabel('Wind and fire');
  await sound.uncheck();
  await ada.page.waitForTimeout(300);
  assert.deepEqual(await loudness(ada), [0, 0]);
  await sound.check();
  await ada.page.waitForTimeout(1000);
  assert.ok((await loudness(ada))[0] > 0.0003, 'on again');
  await ada.leave();
});

test('switched off, there is no sound', async () => {
  const ada = await Visitor.arrive(browser, server.url, {}, () => {
    localStorage.setItem('grove.settings', JSON.stringify({ sound: false }));
    window.AudioContext = class {
      constructor() {
        throw new Error('a context was made');
      }
    };
  });
  await ada.until('picture', 'shown');
  await ada.page.locator('#figures').click();
  await ada.page.keyboard.press('KeyW');
  await ada.frames(5);
  await ada.leave();
});

test('the fire is louder nearby, and a gust is louder than wind', async () => {
  const ada = await arrive();
  await ada.page.mouse.click(320, 180);
  await ada.page.waitForTimeout(2500);
  const [wind, fire] = await loudness(ada);
  await ada.page.keyboard.down('KeyW');
  await ada.page.waitForTimeout(2800);
  await ada.page.keyboard.up('KeyW');
  await ada.page.keyboard.down('Space');
  await ada.page.waitForTimeout(2500);
  const [gust, near] = await loudness(ada);
  await ada.page.keyboard.up('Space');
  assert.ok(near > 1.5 * fire, `fire ${fire}, nearby ${near}`);
  assert.ok(gust > 2 * wind, `wind ${wind}, gust ${gust}`);
  await ada.leave();
});

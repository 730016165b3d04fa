import assert from 'node:assert/strict';
import { readFileSync } from 'node:fs';
import { createRequire } from 'node:module';
import { after, before, test } from 'node:test';

import { Server, Visitor, launchBrowser } from './helpers.mjs';

const kAxe = readFileSync(createRequire(import.meta.url).resolve('axe-core/axe.min.js'), 'utf8');
const kPhone = { viewport: { width: 390, height: 844 }, hasTouch: true, isMobile: true };

let browser;
let server;

before(async () => {
  browser = await launchBrowser();
  server = await Server.start({ options: ['--scene', 'tests/browser/clearing.toml'] });
});

after(async () => {
  await browser?.close();
  await server?.end();
});

async function arrive(options) {
  const visitor = await Visitor.arrive(browser, server.url, options);
  await visitor.until('connection', 'open');
  // No number of frames: beside somebody else a phone's narrow view misses the fire, and what does not change is not sent.
  await visitor.until('picture', 'shown');
  return visitor;
}

/** Whatever axe-core knows of that hinders somebody: missing names, faint letters, roles that do not fit. */
async function findings({ page }) {
  await page.evaluate(kAxe);
  const { violations } = await page.evaluate(() => window.axe.run());
  return violations.flatMap(({ id, help, nodes }) => nodes.map(({ html }) => `${id}: ${help}: ${html}`));
}

for (const [device, options] of [['desktop', {}], ['phone', kPhone]]) {
  test(`nothing hinders anybody in the world (${device})`, async () => {
    const ada = await arrive(options);
    assert.deepEqual(await findings(ada), []);
    await ada.leave();
  });

  test(`nor in the statistics (${device})`, async () => {
    const ada = await arrive(options);
    await ada.page.locator('#figures').click();
    await ada.page.getByText('All statistics').click();
    await ada.page.locator('[data-rows=savings]').waitFor({ state: 'visible' });
    assert.deepEqual(await findings(ada), []);
    await ada.leave();
  });

  test(`nor in the list of visitors (${device})`, async () => {
    const ada = await arrive(options);
    await ada.page.locator('#people-button').click();
    await ada.page.locator('#people').waitFor({ state: 'visible' });
    assert.deepEqual(await findings(ada), []);
    await ada.leave();
  });

  test(`nor in the settings (${device})`, async () => {
    const ada = await arrive(options);
    await ada.page.locator('#settings-button').click();
    await ada.page.getByRole('dialog').waitFor({ state: 'visible' });
    assert.deepEqual(await findings(ada), []);
    await ada.leave();
  });
}

for (const colorScheme of ['light', 'dark']) {
  test(`nor on the operator's page (${colorScheme})`, async () => {
    const ada = await arrive();
    const operator = await Visitor.arrive(browser, `${server.operatorUrl}operator`, { colorScheme });
    await operator.until('state', 'live');
    await operator.page.getByRole('row', { name: /^Simulation Tick/ }).waitFor();
    await operator.page.getByText('in private mode, at least').waitFor();
    assert.deepEqual(await findings(operator), []);
    await operator.leave();
    await ada.leave();
  });
}

test('nor on a missing page', async () => {
  const lost = await Visitor.arrive(browser, `${server.url}no/such/page`);
  assert.deepEqual(await findings(lost), []);
  await lost.leave(/status of 404/);
});

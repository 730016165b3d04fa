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

async function arrive(name, options, script) {
  const visitor = await Visitor.arrive(browser, `${server.url}?name=${encodeURIComponent(name)}`, options, script);
  await visitor.until('picture', 'shown');
  return visitor;
}

const rows = ({ page }) => page.locator('#people li').allTextContents();

test('the list of visitors follows arrivals and departures', async () => {
  const ada = await arrive('Ada');
  assert.equal(await ada.page.locator('#people-button').getAttribute('title'), 'Visitors (V)');
  await ada.page.keyboard.press('v');
  await ada.page.getByText('You are alone here').waitFor();
  assert.deepEqual(await rows(ada), ['Ada (you)']);
  const other = await arrive('<i>\u65e5\u672c</i>');
  await ada.page.getByText('2 visitors').waitFor();
  assert.deepEqual(await rows(ada), ['Ada (you)', '<i>\u65e5\u672c</i>']);
  await other.leave();
  await ada.page.getByText('You are alone here').waitFor();
  await ada.page.locator('#people-button').click();
  assert.ok(await ada.page.locator('#people').isHidden());
  await ada.leave();
});

for (const [where, script] of [
  ['by the clipboard', () => {}],
  ['by selection, where there is none', () => Object.defineProperty(navigator, 'clipboard', { value: undefined })],
]) {
  test(`the link to the world is copied ${where}`, async () => {
    const ada = await arrive('Ada', { permissions: ['clipboard-read', 'clipboard-write'] }, script);
    await ada.page.locator('#people-button').click();
    await ada.page.getByRole('button', { name: 'Copy link to this world' }).click();
    await ada.page.getByText('Link copied').waitFor();
    const reader = await ada.context.newPage();
    await reader.goto(`${server.url}not_found`);
    await reader.bringToFront();
    const copied = await reader.evaluate(() => Navigator.prototype.__lookupGetter__('clipboard').call(navigator).readText());
    assert.equal(copied, server.url);
    await ada.leave(/404/);
  });
}

test('without clipboard access the link is shown', async () => {
  const ada = await arrive('Ada', {}, () => {
    Object.defineProperty(navigator, 'clipboard', { value: { writeText: () => Promise.reject(new Error('refused')) } });
  });
  await ada.page.locator('#people-button').click();
  await ada.page.locator('[data-copy]').click();
  await ada.page.getByText(`The link is ${server.url}`).waitFor();
  await ada.leave();
});

import assert from 'node:assert/strict';
import { after, before, test } from 'node:test';

import { Server, Visitor, freePort, launchBrowser, startProcess } from './helpers.mjs';

const kScene = ['--scene', 'tests/browser/clearing.toml'];

let port;
let owner;
let servers = [];
let browser;

before(async () => {
  port = await freePort();
  owner = await startProcess('world', port, kScene);
  const options = [...kScene, '--join', `127.0.0.1:${port}`];
  servers = [await Server.start({ options }), await Server.start({ options })];
  browser = await launchBrowser();
});

after(async () => {
  await browser?.close();
  for (const server of servers) await server.end();
  await owner?.kill();
});

async function arrive(server, name) {
  const visitor = await Visitor.arrive(browser, `${server.url}?name=${name}`);
  await visitor.until('picture', 'shown');
  await visitor.page.keyboard.press('v');
  return visitor;
}

const lists = ({ page }, names) =>
  page.waitForFunction(
    (wanted) => [...document.querySelectorAll('#people li')].map((row) => row.textContent).join() === wanted,
    names.join(),
  );

test("the operator's page shows the link to the owner, its rates and its round trip", async () => {
  const operator = await Visitor.arrive(browser, `${servers[0].operatorUrl}operator`);
  const row = operator.page.getByRole('row', { name: /^the owner of this world connected . [\d.,]+ [\d.,]+ (< )?[\d.]+ .$/ });
  await row.waitFor();
  await operator.leave();
});

test('visitors of two servers share a world that outlives its owner', async () => {
  const ada = await arrive(servers[0], 'Ada');
  const bob = await arrive(servers[1], 'Bob');
  await lists(ada, ['Ada (you)', 'Bob']);
  await lists(bob, ['Bob (you)', 'Ada']);
  await owner.kill();
  for (const { page } of [ada, bob]) await page.locator('#people [data-lost]').waitFor({ state: 'visible' });
  await lists(ada, ['Ada (you)']); // ten seconds later others are gone
  owner = await startProcess('world', port, kScene);
  for (const { page } of [ada, bob]) await page.locator('#people [data-lost]').waitFor({ state: 'hidden' });
  await lists(ada, ['Ada (you)', 'Bob']);
  await lists(bob, ['Bob (you)', 'Ada']);
  assert.match(servers[0].log, /is back/);
  await ada.leave();
  await lists(bob, ['Bob (you)']);
  await bob.leave();
});

import assert from 'node:assert/strict';
import { after, before, test } from 'node:test';

import { Server, Visitor, coarseGrove, freePort, launchBrowser, startProcess } from './helpers.mjs';

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

const open = (url, options) => Visitor.arrive(browser, `${url}operator`, options);

/** The text of each big figure. */
const figures = (operator) =>
  operator.page.$$eval('#figures [data-figure]', (all) =>
    Object.fromEntries(all.map((figure) => [figure.dataset.figure, figure.textContent])),
  );

const overflow = (operator) =>
  operator.page.evaluate(() => document.documentElement.scrollWidth - document.documentElement.clientWidth);

test('without visitors it says so and shows what is known', async () => {
  const operator = await open(server.operatorUrl);
  await operator.until('state', 'live');
  await operator.page.getByText('No visitors').waitFor();
  assert.deepEqual(await figures(operator), { visitors: '0', fps: '–', alpha: '–', beta: '–', cores: '–', fit: '–' });
  assert.match(await operator.page.locator('#resident').textContent(), /uses [\d.,]+ [MG]B/);
  await operator.page.getByRole('row', { name: /^Simulation Tick/ }).waitFor();
  assert.match(await operator.page.getByRole('heading', { level: 1 }).textContent(), /^Grove \d+\.\d+\.\d+$/);
  await operator.leave();
});

test('figures appear with the first visitor, finite and with units', async () => {
  const operator = await open(server.operatorUrl, { viewport: { width: 1400, height: 900 } });
  await operator.until('state', 'live');
  const ada = await Visitor.arrive(browser, server.url);
  await ada.until('connection', 'open');
  await ada.frames(2);
  await operator.page.waitForFunction(() =>
    ['visitors', 'fps', 'alpha', 'cores', 'fit'].every((name) =>
      /\d/.test(document.querySelector(`[data-figure=${name}]`).textContent),
    ),
  );
  const { visitors, alpha, cores } = await figures(operator);
  assert.equal(visitors, '1');
  assert.match(alpha, /^(> |< )?[01]\.\d\d$/);
  assert.ok(parseFloat(cores) > 0, cores);
  await operator.page.getByText('in private mode, at least').waitFor();
  for (const name of [/^lightfield/, /^all together/, /^Encoder/]) {
    await operator.page.getByRole('row', { name }).first().waitFor();
  }
  await operator.page.waitForFunction(() => document.querySelector('#charts [data-chart=line]').getAttribute('d'));
  await operator.page.waitForFunction(() => !document.querySelector('#notice').textContent.trim());
  assert.doesNotMatch(await operator.page.locator('body').innerText(), /NaN|Infinity|undefined|null|\[object/);
  assert.ok(!(await operator.page.content()).includes('NaN'), 'no path or width of a picture either');
  await ada.leave();
  await operator.leave();
});

test('fits every width, in the dark and in the light', async () => {
  for (const colorScheme of ['dark', 'light']) {
    const operator = await open(server.operatorUrl, { viewport: { width: 360, height: 640 }, colorScheme });
    await operator.until('state', 'live');
    for (const width of [360, 800, 1400]) {
      await operator.page.setViewportSize({ width, height: 640 });
      assert.equal(await overflow(operator), 0, `${width}`);
    }
    const [ground, ink] = await operator.page.evaluate(() => {
      const style = getComputedStyle(document.body);
      return [style.backgroundColor, style.color].map((colour) => Number(colour.match(/\d+/)[0]));
    });
    assert.ok(colorScheme === 'dark' ? ground < 60 && ink > 190 : ground > 190 && ink < 60, `${ground}, ${ink}`);
    await operator.leave();
  }
});

test('headings, tables and regions have names', async () => {
  const operator = await open(server.operatorUrl);
  await operator.until('state', 'live');
  const { page } = operator;
  for (const name of ['One frame of one visitor', 'The last two minutes', 'Stages', 'Memory']) {
    await page.getByRole('heading', { name }).waitFor();
  }
  await page.getByRole('region', { name: 'Stages' }).first().waitFor();
  await page.getByRole('columnheader', { name: 'failures' }).waitFor();
  await page.getByRole('rowheader', { name: 'Simulation Tick' }).waitFor();
  assert.equal(await page.getByRole('link', { name: /trace for Perfetto/ }).getAttribute('href'), '/trace.json');
  await operator.leave();
});

test('a dead server leaves grey figures, and is found again', async () => {
  const [port, operatorPort] = [await freePort(), await freePort()];
  const options = ['--operator', `127.0.0.1:${operatorPort}`, '--scene', coarseGrove()];
  let mortal = await Server.start({ port, options });
  const operator = await open(mortal.operatorUrl);
  try {
    await operator.until('state', 'live');
    await mortal.end('SIGKILL');
    await operator.until('state', 'lost');
    assert.match(await operator.page.getByRole('status').textContent(), /cannot be reached.*figures are from .*Trying again/s);
    assert.equal((await figures(operator)).visitors, '0', 'its last words');
    assert.ok(Number(await operator.page.$eval('main', (main) => getComputedStyle(main).opacity)) < 0.7, 'are grey');

    mortal = await Server.start({ port, options });
    await operator.until('state', 'live');
    await operator.page.getByText('cannot be reached').first().waitFor({ state: 'hidden' });
  } finally {
    await mortal.end();
  }
  // The browser itself reports each refused connection.
  await operator.leave(/Failed to load resource/);
});

test('the figures of a node appear and disappear with it', async () => {
  const scene = ['--scene', 'tests/browser/clearing.toml'];
  const port = await freePort();
  const node = await startProcess('node', port, ['--objects', 'fluid', ...scene]);
  const server = await Server.start({ options: ['--nodes', `127.0.0.1:${port}`, ...scene] });
  try {
    const operator = await open(server.operatorUrl, { viewport: { width: 360, height: 640 } });
    const { page } = operator;
    for (const id of ['stages', 'memory']) {
      const names = page.locator(`#${id} tbody .group`);
      await names.nth(1).waitFor();
      assert.deepEqual(await names.allTextContents(), ['this server', `the node at 127.0.0.1:${port}`]);
    }
    await page.locator('#stages .group', { hasText: 'the node at' }).locator('~ tr', { hasText: 'Simulation Tick' }).waitFor();
    await page.locator('#memory .group', { hasText: 'the node at' }).locator('~ tr', { hasText: 'simulations' }).waitFor();
    assert.equal(await overflow(operator), 0);
    await node.kill();
    await page.locator('#stages .group').first().waitFor({ state: 'detached' });
    await page.getByRole('row', { name: /the node at .* lost/ }).waitFor();
    await operator.leave();
  } finally {
    await node.kill();
    await server.end();
  }
});

import assert from 'node:assert/strict';
import { connect, createServer } from 'node:net';
import { after, before, test } from 'node:test';

import { Server, Visitor, launchBrowser } from './helpers.mjs';

/** For the whole page, headers included. */
const kMost = 60 * 1024;
/** For its reload: one answer that nothing has changed. */
const kMostAgain = 1024;

/**
 * A line to the server that counts what http takes of it; websockets pass uncounted. The browser's own figures leave out
 * what its workers load.
 */
class Line {
  bytes = 0;
  /** Address and headers of each request. */
  requests = [];
  #sockets = new Set();
  #listener;

  static async to(url) {
    const line = new Line();
    line.#listener = createServer((browser) => line.#join(browser, connect(Number(url.port), url.hostname)));
    await new Promise((resolve) => line.#listener.listen(0, '127.0.0.1', resolve));
    line.url = `http://127.0.0.1:${line.#listener.address().port}/`;
    return line;
  }

  #join(browser, server) {
    let isHttp = true;
    browser.on('data', (chunk) => {
      const request = isHttp ? chunk.toString('latin1') : '';
      isHttp &&= !/^upgrade: websocket/im.test(request);
      if (isHttp) this.requests.push(request);
    });
    server.on('data', (chunk) => (this.bytes += isHttp ? chunk.length : 0));
    for (const [from, to] of [[browser, server], [server, browser]]) {
      this.#sockets.add(from);
      from.on('error', () => to.destroy());
      from.pipe(to);
    }
  }

  reset() {
    this.bytes = 0;
    this.requests = [];
  }

  get paths() {
    return this.requests.map((request) => request.split(' ')[1]);
  }

  close() {
    this.#listener.close();
    for (const socket of this.#sockets) socket.destroy();
  }
}

let browser;
let server;
let line;

before(async () => {
  browser = await launchBrowser();
  server = await Server.start({ options: ['--scene', 'tests/browser/clearing.toml'] });
  line = await Line.to(new URL(server.url));
});

after(async () => {
  await browser?.close();
  line?.close();
  await server?.end();
});

/** Somebody who has never been here. */
async function arrive(options) {
  line.reset();
  const visitor = await Visitor.arrive(browser, line.url, options);
  await visitor.until('connection', 'open');
  await visitor.until('receiver', 'worker');
  await visitor.frames(2);
  return visitor;
}

function checkWeight() {
  assert.ok(line.bytes > 10_000 && line.bytes <= kMost, `${line.bytes} bytes for ${line.paths.join(' ')}`);
  assert.ok(line.requests.length <= 12, line.paths.join(' '));
  for (const part of ['/main.js', '/receiver_worker.js', '/style.css']) {
    assert.ok(line.paths.some((path) => path.endsWith(part)), `${part} is counted: ${line.paths.join(' ')}`);
  }
}

test('the page takes at most 60 KB and few requests', async () => {
  const ada = await arrive();
  checkWeight();
  assert.ok(line.requests.every((request) => /^accept-encoding: .*\bbr\b/im.test(request)), line.requests[0]);
  await ada.leave();
});

/** As by plain http from another machine, for which browsers ask without Brotli. */
test('also with gzip', async () => {
  const ada = await arrive({ extraHTTPHeaders: { 'Accept-Encoding': 'gzip' } });
  checkWeight();
  assert.match(line.requests[0], /^accept-encoding: gzip\r/im);
  await ada.leave();
});

test('a reload takes almost nothing from the network', async () => {
  const ada = await arrive();
  line.reset();
  await ada.page.reload();
  await ada.until('connection', 'open');
  await ada.frames(2);
  assert.deepEqual(line.paths, ['/'], 'all else is kept');
  assert.ok(line.bytes <= kMostAgain, `${line.bytes} bytes`);
  await ada.leave();
});

test('the page for a missing address links home', async () => {
  const ada = await Visitor.arrive(browser, `${server.url}no/such/page`);
  await ada.page.getByRole('heading', { name: 'There is no such page' }).waitFor();
  const ground = await ada.page.evaluate(() => getComputedStyle(document.documentElement).backgroundColor);
  assert.equal(ground, 'rgb(18, 17, 14)', "the page's");
  await ada.page.getByRole('link', { name: 'Enter the grove' }).click();
  await ada.until('connection', 'open');
  await ada.leave(/status of 404/);
});

import assert from 'node:assert/strict';
import { readFileSync } from 'node:fs';
import { after, before, test } from 'node:test';

import { Guests, Server, Visitor, difference, keepWebGl, launchBrowser, pause, statistics } from './helpers.mjs';

let server;
let browser;
const guests = new Guests();

before(async () => {
  server = await Server.start({ options: ['--scene', 'tests/browser/clearing.toml'] });
  browser = await launchBrowser();
});

after(async () => {
  await browser?.close();
  await server?.end();
});

/** `expected`: what the page may complain about. */
async function arrive({ script, options, query = '', expected = null } = {}) {
  const visitor = await Visitor.arrive(browser, `${server.url}${query}`, options, script);
  guests.add(visitor, expected);
  await visitor.until('connection', 'open');
  await visitor.frames(3);
  return visitor;
}

// A script reaches no worker: each that changes what the receiver uses also keeps it on the page.

/** Lets a test make the page's decoder fail, and count the decoders. */
function breakableDecoder() {
  delete window.Worker;
  window.decoders = [];
  window.VideoDecoder = class extends window.VideoDecoder {
    #tell;

    constructor(init) {
      super(init);
      this.#tell = init.error;
      window.decoders.push(this);
    }

    break() {
      this.close();
      this.#tell(new DOMException('bad bits', 'EncodingError'));
    }
  };
}

/** A browser that promises every codec and keeps no promise. */
function lyingDecoder() {
  delete window.Worker;
  window.VideoDecoder = class {
    static isConfigSupported = async (config) => ({ supported: true, config });
    state = 'unconfigured';
    decodeQueueSize = 0;
    #error;

    constructor({ error }) {
      this.#error = error;
    }

    configure() {
      this.state = 'closed';
      queueMicrotask(() => this.#error(new DOMException('Unsupported configuration', 'NotSupportedError')));
    }

    decode() {}
    close() {}
  };
}

/** A decoder that hands out a picture only when another comes, as some graphics cards do. */
function withholdingDecoder() {
  delete window.Worker;
  window.VideoDecoder = class extends window.VideoDecoder {
    constructor({ output, error }) {
      let held = null;
      super({
        output: (frame) => {
          if (held) output(held);
          held = frame;
        },
        error,
      });
    }
  };
}

/** Turns by a drag of so many pixels to the right, and waits until that can be seen. */
async function drag({ page }, way) {
  await page.mouse.move(320, 100);
  await page.mouse.down();
  await page.mouse.move(320 + way, 100, { steps: Math.min(4, Math.abs(way)) });
  await page.mouse.up();
  await page.evaluate(() => new Promise((done) => requestAnimationFrame(() => requestAnimationFrame(done))));
}

const kNoH264 = /^H\.264 does not work here/;

test('on localhost the stream is H.264', async () => {
  const ada = await arrive();
  assert.equal((await ada.state()).codec, 'H.264');
  await ada.frames(20);
  assert.equal((await ada.state()).codec, 'H.264');
});

test('paints in a worker, or on the page without one', async () => {
  const ada = await arrive();
  assert.equal((await ada.state()).receiver, 'worker');
  const bob = await arrive({ script: () => delete window.Worker });
  assert.equal((await bob.state()).receiver, 'page');
  for (const visitor of [ada, bob]) assert.ok(statistics(await visitor.picture()).deviation > 10);
});

test('without a decoder, as on plain http, the stream is JPEG', async () => {
  const ada = await arrive({
    script: () => {
      delete window.Worker;
      delete window.VideoDecoder;
    },
  });
  assert.equal((await ada.state()).codec, 'JPEG');
});

// Faults: smoke that stands still, a picture of patches only, whole pictures although nothing else moves.
test('without H.264, only what moves is sent while one stands', async () => {
  const ada = await arrive({
    script: () => {
      delete window.Worker;
      delete window.VideoDecoder;
      delete window.ImageDecoder;
      window.decoded = [];
      const make = window.createImageBitmap.bind(window);
      window.createImageBitmap = async (of) => {
        const image = await make(of);
        if (of instanceof Blob) window.decoded.push(image.width * image.height);
        return image;
      };
    },
  });
  await ada.frames(40);
  const decoded = await ada.page.evaluate(() => window.decoded);
  const whole = Math.max(...decoded);
  const parts = decoded.slice(-20);
  assert.ok(parts.filter((pixels) => pixels < whole / 2).length > 10, `${parts} of ${whole}`);
  const before = statistics(await ada.picture());
  await ada.frames(10);
  const after = statistics(await ada.picture());
  assert.ok(before.deviation > 10 && Math.abs(after.mean - before.mean) < 10, JSON.stringify([before, after]));
});

test('a browser with a broken codec gets JPEG', async () => {
  const ada = await arrive({ script: lyingDecoder, expected: kNoH264 });
  assert.equal((await ada.state()).codec, 'JPEG');
  assert.equal(ada.complaints.length, 1);
  await ada.page.reload();
  await ada.until('codec', 'JPEG');
  assert.equal(ada.complaints.length, 1);
});

test('gives up a decoder that holds pictures back', async () => {
  const ada = await arrive({ script: withholdingDecoder, expected: kNoH264 });
  await ada.until('codec', 'JPEG');
  await ada.frames(3);
});

test('replaces a failing decoder, and gives up a broken one', async () => {
  const ada = await arrive({ script: breakableDecoder, expected: kNoH264 });
  await ada.page.evaluate(() => window.decoders.at(-1).break());
  await ada.frames(5);
  assert.equal((await ada.state()).codec, 'H.264');
  assert.deepEqual(await ada.page.evaluate(() => window.decoders.map(({ state }) => state)), ['closed', 'configured']);
  for (let i = 2; i < 4; i += 1) {
    await ada.page.waitForFunction((count) => window.decoders.length === count, i);
    await ada.page.evaluate(() => window.decoders.at(-1).break());
    await ada.frames(5);
  }
  await ada.until('codec', 'JPEG');
  assert.match(ada.complaints[0], /^H\.264 does not work here \(bad bits\); offering JPEG$/);
});

test('a hidden page gets nothing, and a picture once visible', async () => {
  let received = 0;
  const ada = new Visitor();
  ada.context = await browser.newContext({ viewport: { width: 640, height: 360 } });
  ada.page = await ada.context.newPage();
  ada.page.on('websocket', (socket) => socket.on('framereceived', () => (received += 1)));
  await ada.page.goto(server.url);
  guests.add(ada);
  await ada.until('connection', 'open');
  await ada.frames(5);
  const look = (hidden) =>
    ada.page.evaluate((value) => {
      Object.defineProperty(document, 'hidden', { configurable: true, get: () => value });
      document.dispatchEvent(new Event('visibilitychange'));
    }, hidden);
  await look(true);
  await pause(1000); // what was on its way
  received = 0;
  await pause(2500);
  assert.equal(received, 0);
  assert.equal((await ada.state()).connection, 'open', 'silence was agreed on');
  await look(false);
  await ada.frames(3);
});

test('the last picture turns with the view before the next arrives', async () => {
  const ada = await arrive({ script: keepWebGl });
  server.signal('SIGSTOP');
  try {
    // What is still on its way comes first.
    await ada.until('connection', 'silent');
    const before = await ada.state();
    const still = await ada.picture();
    await drag(ada, -80);
    const turned = await ada.picture();
    assert.equal((await ada.state()).frames, before.frames, 'no picture came');
    const change = difference(still, turned);
    assert.ok(change > 4, `the picture moves: ${change}`);

    await drag(ada, 80);
    assert.equal(difference(still, await ada.picture()), 0, 'and back');
    // A pixel's turn goes the way of all turned pictures: the colours are the same.
    await drag(ada, 1);
    const nudged = await ada.picture();
    assert.notDeepEqual(nudged, still);
    assert.ok(Math.abs(statistics(nudged).mean - statistics(still).mean) < 0.5);
  } finally {
    server.signal('SIGCONT');
  }
  await ada.until('connection', 'open');
});

test('a lost graphics context keeps the picture', async () => {
  const ada = await arrive({ script: keepWebGl });
  await ada.page.keyboard.press('o');
  const lateLook = (word) =>
    ada.page.waitForFunction((text) => document.querySelector('[data-figure=lateLook]').textContent === text, word);
  await lateLook('on');
  await ada.page.evaluate(() => window.webGl.loseContext());
  await lateLook('off: no fast WebGL');
  await drag(ada, -80);
  await ada.frames(3);
  assert.ok(statistics(await ada.picture()).deviation > 10);
  await ada.page.evaluate(() => window.webGl.restoreContext());
  await lateLook('on');
  await drag(ada, 80);
  await ada.frames(3);
  assert.ok(statistics(await ada.picture()).deviation > 10);
});

test('reports a silent server within three seconds, until it speaks', async () => {
  const ada = await arrive();
  const notice = ada.page.getByRole('heading', { name: 'The server is not responding' });
  server.signal('SIGSTOP');
  try {
    await notice.waitFor({ timeout: 3000 });
  } finally {
    server.signal('SIGCONT');
  }
  await notice.waitFor({ state: 'hidden' });
  await ada.frames(3);
  assert.equal((await ada.state()).connection, 'open');
});

test('a phone requests no more pixels than it has', async () => {
  const phone = { viewport: { width: 844, height: 390 }, deviceScaleFactor: 3, isMobile: true, hasTouch: true };
  const ada = await arrive({ options: phone });
  const [width, height] = (await ada.state()).streamSize.split('x').map(Number);
  assert.ok(width <= 1280 && height <= 720, `${width} x ${height}`);
  assert.ok(Math.abs(height / width - 390 / 844) < 0.01, `${width} x ${height}`);
});

test('latency is measured and exported as a table', async () => {
  const ada = await arrive({ query: '?latency=1' });
  await ada.page.keyboard.press('o');
  await ada.page.getByText('All statistics').click();
  const save = ada.page.getByRole('button', { name: 'Save as CSV' });
  const [download] = await Promise.all([ada.page.waitForEvent('download'), save.click()]);
  const [header, ...rows] = readFileSync(await download.path(), 'utf8').trim().split('\n');
  assert.equal(header, 'number,sent_ms,presented_ms,latency_ms,frame,width,height,codec,screen_ms');
  assert.ok(rows.length > 0);
  for (const row of rows) assert.match(row, /^\d+,[\d.]+,[\d.]+,[\d.]+,\d+,640,360,H\.264,[\d.]+$/);
  assert.match(await ada.page.locator('[data-latency=words]').textContent(), /^p50 \d+, p95 \d+, p99 \d+ ms of \d+ inputs$/);
});

// Measures what a visitor gets whose browser shares the server's machine: `npm run own-machine -- --help`.
import { parseArgs } from 'node:util';

import { Server, Visitor, launchBrowser, pause } from './helpers.mjs';

const kHelp = `Usage: npm run own-machine --prefix tests/browser -- [OPTIONS]

Serves the default scene and visits it by a headless Chromium without a graphics card on the same machine, at 1280 x 720:
standing for 60 s, walking for 20 s, and four pages that walk for 20 s. Waits first until the light fields are fine.

  --json             Print one JSON document: for standing, walking and four_tabs
                       lines_min  the smallest height of a streamed picture, after the first 3 s
                       fps        pictures presented a second, after the first 3 s; of four tabs, the worst one's.
                                  A view in which nothing moves is sent no pictures; in the default scene smoke moves.
                       p95_ms     from sending an input to presenting the first picture that shows it: of 100 inputs, 95
                                  take no longer; of four tabs, the worst one's. The page sends its controls every 50 ms,
                                  changed or not.
                       culprit    what most often limited the stream, as the server says
  --seconds N        Each of the three takes N seconds (4 to 600), for a trial
  --screenshot PATH  Write the page as it is after standing there, as a PNG
  --help             Print this
`;
const kSize = { viewport: { width: 1280, height: 720 } };
/** The stream finds its size in so long; milliseconds, as all below. */
const kSettling = 3000;
const kSampling = 100;
/** Q turns by 1.6 radians a second: so pressed, one walks a circle of a few metres. */
const kTurn = 60;
const kBetweenTurns = 250;

function options() {
  const { values } = parseArgs({
    options: {
      json: { type: 'boolean' },
      seconds: { type: 'string' },
      screenshot: { type: 'string' },
      help: { type: 'boolean' },
    },
  });
  const { seconds } = values;
  if (seconds !== undefined && !(/^\d+$/.test(seconds) && Number(seconds) >= 4 && Number(seconds) <= 600)) {
    throw new Error(`--seconds ${seconds}: not a whole number from 4 to 600`);
  }
  return { ...values, seconds: seconds && Number(seconds) };
}

/** Runs in the page: keeps its state now and then, beginning with the first picture. */
function sample(interval) {
  window.samples = [];
  const { dataset } = document.documentElement;
  setInterval(() => {
    if (dataset.picture !== 'shown') return;
    const { frames, lines, limitedBy } = dataset;
    window.samples.push({ time: performance.now(), frames: Number(frames), lines: Number(lines), limitedBy });
  }, interval);
}

/** As each test of latency: it begins with the first picture. */
async function enter(browser, url, seconds) {
  const visitor = await Visitor.arrive(browser, `${url}?latency=${seconds}`, kSize);
  await visitor.page.evaluate(sample, kSampling);
  await visitor.until('picture', 'shown');
  return visitor;
}

async function walk({ page }, seconds) {
  const end = performance.now() + seconds * 1000;
  await page.keyboard.down('KeyW');
  while (performance.now() < end) {
    await page.keyboard.down('KeyQ');
    await pause(kTurn);
    await page.keyboard.up('KeyQ');
    await pause(kBetweenTurns);
  }
  await page.keyboard.up('KeyW');
}

function mostFrequent(values) {
  const counts = new Map();
  for (const value of values) counts.set(value, (counts.get(value) ?? 0) + 1);
  return [...counts].sort(([, a], [, b]) => b - a)[0][0];
}

/** What the page has sampled in so many seconds from its first picture. */
async function readingOf({ page }, seconds) {
  await page.waitForFunction(() => document.querySelector('[data-latency=start]').disabled === false);
  const [samples, words] = await page.evaluate(() => [
    window.samples,
    document.querySelector('[data-latency=words]').textContent,
  ]);
  const begin = samples[0].time;
  const counted = samples.filter(({ time }) => time >= begin + kSettling && time <= begin + seconds * 1000);
  const p95 = words.match(/p95 (\d+)/);
  if (counted.length < 2 || !p95) throw new Error(`too little came to measure: ${counted.length} samples, "${words}"`);
  const [first, last] = [counted[0], counted.at(-1)];
  return {
    lines: Math.min(...counted.map(({ lines }) => lines)),
    fps: ((last.frames - first.frames) * 1000) / (last.time - first.time),
    p95: Number(p95[1]),
    limits: counted.map(({ limitedBy }) => limitedBy ?? 'nothing'),
  };
}

/** `act(visitor)` is what each of `count` visitors does. */
async function measure(browser, url, { count = 1, seconds, act, after = () => {} }) {
  const visitors = await Promise.all(Array.from({ length: count }, () => enter(browser, url, seconds)));
  await Promise.all(visitors.map((visitor) => act(visitor, seconds)));
  const readings = await Promise.all(visitors.map((visitor) => readingOf(visitor, seconds)));
  await after(visitors[0]);
  for (const visitor of visitors) await visitor.leave();
  return {
    lines_min: Math.min(...readings.map(({ lines }) => lines)),
    fps: Number(Math.min(...readings.map(({ fps }) => fps)).toFixed(1)),
    p95_ms: Math.max(...readings.map(({ p95 }) => p95)),
    culprit: mostFrequent(readings.flatMap(({ limits }) => limits)),
  };
}

function table(results) {
  return Object.entries(results)
    .map(([name, each]) => `${name}: ${Object.entries(each).map((pair) => pair.join(' ')).join(', ')}`)
    .join('\n');
}

async function main() {
  const { json, seconds, screenshot, help } = options();
  if (help) {
    process.stdout.write(kHelp);
    return;
  }
  const server = await Server.start();
  let browser;
  try {
    browser = await launchBrowser();
    const { url } = server;
    const results = {
      standing: await measure(browser, url, {
        seconds: seconds ?? 60,
        act: (visitor, time) => pause(time * 1000),
        after: ({ page }) => screenshot && page.screenshot({ path: screenshot }),
      }),
      walking: await measure(browser, url, { seconds: seconds ?? 20, act: walk }),
      four_tabs: await measure(browser, url, { count: 4, seconds: seconds ?? 20, act: walk }),
    };
    process.stdout.write(`${json ? JSON.stringify(results) : table(results)}\n`);
  } finally {
    await browser?.close();
    await server.end();
  }
}

main().catch((error) => {
  process.stderr.write(`own-machine: ${error.message}\n`);
  process.exitCode = 1;
});

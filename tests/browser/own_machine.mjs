import { parseArgs } from 'node:util';

import { Server, Visitor, launchBrowser, pause } from './helpers.mjs';

const kHelp = `Measures what a visitor gets whose browser shares the machine with the server, without a graphics card.

  npm run own-machine --prefix tests/browser -- [--json] [--seconds N] [--picture FILE]

  --json          print one JSON document on stdout
  --seconds N     length of each part; 60 standing and 20 each for the others if not given
  --picture FILE  a picture of the page at the end of standing, PNG

Three parts, each in a 1280x720 window: one visitor stands, one walks, four tabs walk. After the first 3 seconds of each:
lines_min is the smallest height of a picture on the screen, fps the pictures painted a second (of several tabs the
worst; smoke moves, so there is something to send while standing), p95_ms the time from input to picture as the page
measures it, culprit what the page named most of the time.`;

const kSettleSeconds = 3;
const kWindow = { viewport: { width: 1280, height: 720 } };

/** Runs in the page: collects what it shows from now on. */
function beginCounting() {
  const root = document.documentElement.dataset;
  const counted = { since: performance.now(), frames: Number(root.frames), lines: Infinity, limits: {} };
  const sample = () => {
    counted.lines = Math.min(counted.lines, Number(root.lines));
    const limit = root.limitedBy ?? 'nothing';
    counted.limits[limit] = (counted.limits[limit] ?? 0) + 1;
  };
  sample();
  counted.timer = setInterval(sample, 50);
  window.counted = counted;
}

/** Runs in the page: what was collected. */
function endCounting() {
  const { since, frames, lines, limits, timer } = window.counted;
  clearInterval(timer);
  const seconds = (performance.now() - since) / 1000;
  const words = document.querySelector('[data-latency=words]').textContent;
  return {
    lines,
    fps: (Number(document.documentElement.dataset.frames) - frames) / seconds,
    p95: Number(words.match(/p95 (\d+)/)?.[1] ?? NaN),
    limits,
  };
}

/** Walks to and fro while turning a little, so that the view stays within the grove. */
async function walk(page, seconds) {
  const end = Date.now() + seconds * 1000;
  for (let i = 0; Date.now() < end; i += 1) {
    const key = i % 2 === 0 ? 'w' : 's';
    await page.keyboard.down(key);
    await page.keyboard.down(i % 4 < 2 ? 'ArrowLeft' : 'ArrowRight');
    await pause(Math.min(2000, end - Date.now()));
    await page.keyboard.up(i % 4 < 2 ? 'ArrowLeft' : 'ArrowRight');
    await page.keyboard.up(key);
  }
}

async function measure(browser, url, { tabs, seconds, walks, picture }) {
  const test = seconds - 1;
  const visitors = await Promise.all(
    Array.from({ length: tabs }, () => Visitor.arrive(browser, `${url}?latency=${test + kSettleSeconds}`, kWindow)),
  );
  const pages = visitors.map((visitor) => visitor.page);
  await Promise.all(visitors.map((visitor) => visitor.until('picture', 'shown')));
  const move = (time) => (walks ? Promise.all(pages.map((page) => walk(page, time))) : pause(time * 1000));
  await move(kSettleSeconds);
  await Promise.all(pages.map((page) => page.evaluate(beginCounting)));
  await move(seconds);
  const counted = await Promise.all(pages.map((page) => page.evaluate(endCounting)));
  if (picture) await pages[0].screenshot({ path: picture });
  await Promise.all(visitors.map((visitor) => visitor.context.close()));
  return summary(counted);
}

function summary(counted) {
  const limits = {};
  for (const each of counted) {
    for (const [name, count] of Object.entries(each.limits)) limits[name] = (limits[name] ?? 0) + count;
  }
  const [culprit] = Object.entries(limits).sort((a, b) => b[1] - a[1])[0];
  return {
    lines_min: Math.min(...counted.map((each) => each.lines)),
    fps: Number(Math.min(...counted.map((each) => each.fps)).toFixed(1)),
    p95_ms: Math.max(...counted.map((each) => each.p95)),
    culprit,
  };
}

function options() {
  const { values } = parseArgs({
    options: {
      help: { type: 'boolean' },
      json: { type: 'boolean' },
      seconds: { type: 'string' },
      picture: { type: 'string' },
    },
  });
  const seconds = values.seconds === undefined ? undefined : Number(values.seconds);
  if (seconds !== undefined && !(seconds >= 5 && seconds <= 600)) throw new Error('--seconds takes 5 to 600');
  return { ...values, seconds };
}

async function run({ seconds, picture }) {
  const server = await Server.start();
  const browser = await launchBrowser();
  try {
    return {
      standing: await measure(browser, server.url, { tabs: 1, seconds: seconds ?? 60, picture }),
      walking: await measure(browser, server.url, { tabs: 1, seconds: seconds ?? 20, walks: true }),
      four_tabs: await measure(browser, server.url, { tabs: 4, seconds: seconds ?? 20, walks: true }),
    };
  } finally {
    await browser.close();
    await server.end();
  }
}

let asked;
try {
  asked = options();
} catch (error) {
  console.error(`own-machine: ${error.message}`);
  process.exit(2);
}
if (asked.help) {
  console.log(kHelp);
} else {
  const report = await run(asked);
  console.log(asked.json ? JSON.stringify(report) : JSON.stringify(report, null, 2));
}

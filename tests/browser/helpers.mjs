import assert from 'node:assert/strict';
import { spawn } from 'node:child_process';
import { mkdtempSync, readFileSync, rmSync, writeFileSync } from 'node:fs';
import { createServer } from 'node:net';
import { tmpdir } from 'node:os';
import { join } from 'node:path';
import { afterEach } from 'node:test';
import { fileURLToPath } from 'node:url';

import { chromium } from 'playwright-core';

const kRoot = fileURLToPath(new URL('../..', import.meta.url));
const kBinary = process.env.GROVE_BINARY ?? `${kRoot}/build/release/grove`;
const kBrowser = process.env.CHROMIUM ?? '/usr/bin/chromium';
/** For a loaded machine; no test measures time. Milliseconds. */
export const kPatience = 60_000;

/** A view without news for so long (ms) is still. */
const kStillness = 2000;

/** Without a graphics card, Chromium remarks on how slow it is. */
const kDriver = /GL Driver Message \(OpenGL, Performance/;

/** The first server on a machine bakes the light fields of its world. Milliseconds. */
const kPreparation = 600_000;

/** A file with the built-in scene, changed. Gone when the test's process ends. */
function changedGrove(change) {
  const folder = mkdtempSync(join(tmpdir(), 'grove-scene-'));
  process.on('exit', () => rmSync(folder, { recursive: true, force: true }));
  const scene = join(folder, 'grove.toml');
  const text = readFileSync(`${kRoot}/server/world/scenes/grove.toml`, 'utf8');
  const changed = change(text);
  assert.notEqual(changed, text);
  writeFileSync(scene, changed);
  return scene;
}

/**
 * The built-in scene, its light fields as coarse as those that a visitor sees before the fine ones are ready: these take
 * minutes to bake.
 */
export function coarseGrove() {
  return changedGrove((text) =>
    text.replaceAll(/^size = \d+\nsubdivision = \d+\n/gm, '').replaceAll(/^plant = /gm, 'subdivision = 4\nsize = 128\nplant = '),
  );
}

/** The built-in scene, whose visitors arrive elsewhere. Metres, and degrees counter-clockwise from north. */
export function groveFrom(x, z, yaw) {
  return changedGrove((text) =>
    text.replace(/^spawn = .*$/m, `spawn = [${x}, 0, ${z}]`).replace(/^spawn_yaw_degrees = .*$/m, `spawn_yaw_degrees = ${yaw}`),
  );
}

/** A port that was free a moment ago. */
export async function freePort() {
  const probe = createServer();
  await new Promise((resolve) => probe.listen(0, '127.0.0.1', resolve));
  const { port } = probe.address();
  await new Promise((resolve) => probe.close(resolve));
  return port;
}

/** A running `grove serve`. */
export class Server {
  #process;
  /** What it has said so far. */
  log = '';

  constructor(process) {
    this.#process = process;
  }

  /** Starts the server and waits until it says that it listens, and, unless it may be `coarse`, that all is fine. */
  static async start({ port, options = [], coarse = false } = {}) {
    const address = `127.0.0.1:${port ?? (await freePort())}`;
    const process = spawn(kBinary, ['serve', '--listen', address, ...options], { cwd: kRoot });
    const server = new Server(process);
    let output = '';
    let look = () => {};
    const isFine = () =>
      coarse || !server.log.includes('sketching the light fields') || server.log.includes('as fine as');
    process.stderr.on('data', (chunk) => {
      server.log += chunk;
      look();
    });
    await new Promise((resolve, reject) => {
      const timer = setTimeout(() => reject(new Error(`the server did not start in time:\n${server.log}`)), kPreparation);
      process.on('error', reject);
      process.on('exit', (code) => reject(new Error(`the server ended with ${code}:\n${server.log}`)));
      look = () => {
        const listening = output.match(/listening on (https?:\/\/.*)\n/);
        if (!listening || !isFine()) return;
        server.url = `${listening[1]}/`;
        clearTimeout(timer);
        resolve();
      };
      process.stdout.on('data', (chunk) => {
        output += chunk;
        look();
      });
    });
    [, server.operatorUrl] = output.match(/operator's page at (https?:.*\/)operator/);
    return server;
  }

  signal(name) {
    this.#process.kill(name);
  }

  /** Ends it with this signal; resolves when it is gone. */
  async end(signal = 'SIGTERM') {
    if (this.#process.exitCode !== null || this.#process.signalCode !== null) return;
    const gone = new Promise((resolve) => this.#process.once('exit', resolve));
    this.#process.kill(signal);
    const timer = setTimeout(() => this.#process.kill('SIGKILL'), kPatience);
    await gone;
    clearTimeout(timer);
  }
}

/** A running `grove world` or `grove node`, which ends with `kill()`, without a word to anybody. */
export async function startProcess(command, port, options) {
  const process = spawn(kBinary, [command, '--listen', `127.0.0.1:${port}`, ...options], { cwd: kRoot });
  const ended = new Promise((resolve) => process.on('exit', resolve));
  await new Promise((resolve, reject) => {
    process.stdout.once('data', resolve);
    process.on('error', reject);
    process.on('exit', (code) => reject(new Error(`grove ${command} ended with ${code}`)));
  });
  return {
    kill: async () => {
      process.kill('SIGKILL');
      await ended;
    },
  };
}

/** A running `grove shape`: a line to a server. `profile` as in `grove shape --help`. */
export async function startLine(server, profile) {
  const options = ['--listen', '127.0.0.1:0', '--to', new URL(server.url).host, profile];
  const process = spawn(kBinary, ['shape', ...options], { cwd: kRoot });
  const ended = new Promise((resolve) => process.on('exit', resolve));
  const url = await new Promise((resolve, reject) => {
    let output = '';
    process.stdout.on('data', (chunk) => {
      output += chunk;
      const listening = output.match(/(127\.0\.0\.1:\d+)/);
      if (listening) resolve(`http://${listening[1]}/`);
    });
    process.on('error', reject);
    process.on('exit', (code) => reject(new Error(`grove shape ended with ${code}`)));
  });
  return {
    url,
    end: async () => {
      process.kill();
      await ended;
    },
  };
}

/** Without these, WebGL and the canvas are computed by the page's own thread. */
const kGraphics = ['--use-angle=gl-egl', '--ignore-gpu-blocklist', '--enable-gpu'];

/**
 * A headless Chromium with an empty profile of its own. `graphics`: a process of its own computes WebGL and the canvas, by
 * Mesa, as a graphics card does: painting takes no time of the page. See keepWebGl().
 */
export function launchBrowser({ graphics = false } = {}) {
  return chromium.launch({
    executablePath: kBrowser,
    args: [
      '--no-sandbox',
      ...(graphics ? kGraphics : ['--disable-gpu']),
      '--disable-quic',
      '--no-first-run',
      '--disable-background-networking',
      '--disable-component-update',
      '--disable-sync',
    ],
  });
}

/**
 * A script for Visitor.arrive(): a browser without a graphics card that claims one, and what its WebGL gave, for the test
 * to take away. The receiver stays on the page, because a script reaches no worker.
 */
export function keepWebGl() {
  delete window.Worker;
  const { getParameter } = WebGLRenderingContext.prototype;
  WebGLRenderingContext.prototype.getParameter = function name(parameter) {
    const value = getParameter.call(this, parameter);
    return /swiftshader|llvmpipe/i.test(value) ? 'a graphics card' : value;
  };
  const { getContext } = HTMLCanvasElement.prototype;
  HTMLCanvasElement.prototype.getContext = function keep(kind, options) {
    const context = getContext.call(this, kind, { ...options, failIfMajorPerformanceCaveat: false });
    if (kind === 'webgl') window.webGl ??= context.getExtension('WEBGL_lose_context');
    return context;
  };
}

/** One visitor: a page in a context of its own, with everything its console complained about. */
export class Visitor {
  complaints = [];

  /** `script` runs in the page before its own. */
  static async arrive(browser, url, options = {}, script = () => {}) {
    const visitor = new Visitor();
    visitor.context = await browser.newContext({ viewport: { width: 640, height: 360 }, ...options });
    await visitor.context.addInitScript(script);
    visitor.page = await visitor.context.newPage();
    visitor.page.setDefaultTimeout(kPatience);
    visitor.page.on('pageerror', (error) => visitor.complaints.push(String(error)));
    visitor.page.on('console', (message) => {
      if (!['error', 'warning'].includes(message.type()) || kDriver.test(message.text())) return;
      visitor.complaints.push(message.text());
    });
    await visitor.page.goto(url);
    return visitor;
  }

  /** The page's data-* state. */
  state() {
    return this.page.evaluate(() => ({ ...document.documentElement.dataset }));
  }

  /** Waits until the state's `name` is `value`. */
  async until(name, value) {
    await this.page.waitForFunction(([n, v]) => document.documentElement.dataset[n] === v, [name, value]);
  }

  /** Waits for this many more presented frames. */
  async frames(count = 1) {
    const { frames } = await this.state();
    const goal = Number(frames) + count;
    await this.page.waitForFunction((most) => Number(document.documentElement.dataset.frames) >= most, goal);
  }

  /** The stream's picture in small: RGBA, row by row. */
  picture() {
    return this.meanPicture(1, 0);
  }

  /**
   * The mean of several pictures, each this many frames after the one before; of a view in which nothing moves, no frames
   * come, and one is as good as another.
   */
  meanPicture(count, framesBetween = 2) {
    return this.page.evaluate(
      async ([pictures, between, stillness]) => {
        const [width, height] = [160, 90];
        const scratch = new OffscreenCanvas(width, height).getContext('2d', { willReadFrequently: true });
        scratch.imageSmoothingQuality = 'high';
        const presented = () => Number(document.documentElement.dataset.frames);
        const sum = new Float64Array(width * height * 4);
        let isStill = false;
        for (let i = 0; i < pictures; i += 1) {
          const goal = presented() + between;
          const end = performance.now() + stillness;
          while (!isStill && presented() < goal) {
            await new Promise((resolve) => requestAnimationFrame(resolve));
            isStill = performance.now() >= end;
          }
          scratch.drawImage(document.querySelector('canvas'), 0, 0, width, height);
          scratch.getImageData(0, 0, width, height).data.forEach((value, index) => (sum[index] += value));
        }
        return Array.from(sum, (value) => value / pictures);
      },
      [count, framesBetween, kStillness],
    );
  }

  /** Leaves; the page must not have complained, except about what the test expects. */
  async leave(expected = null) {
    await this.context.close();
    assert.deepEqual(this.complaints.filter((text) => !expected?.test(text)), []);
  }
}

/** The visitors of a test, who leave when it ends. */
export class Guests {
  #present = [];

  constructor() {
    afterEach(async () => {
      const leaving = this.#present;
      this.#present = [];
      for (const { visitor, expected } of leaving) await visitor.leave(expected);
    });
  }

  /** `expected` as Visitor.leave() takes it. */
  add(visitor, expected = null) {
    this.#present.push({ visitor, expected });
  }

  /** One leaves before the end. */
  async leave(visitor) {
    this.#present = this.#present.filter((guest) => guest.visitor !== visitor);
    await visitor.leave();
  }
}

/** Mean and standard deviation of the colour channels, 0 to 255. */
export function statistics(pixels) {
  const values = pixels.filter((_, index) => index % 4 !== 3);
  const mean = values.reduce((sum, value) => sum + value, 0) / values.length;
  const variance = values.reduce((sum, value) => sum + (value - mean) ** 2, 0) / values.length;
  return { mean, deviation: Math.sqrt(variance) };
}

/** Root of the mean squared difference of two pictures, 0 to 255. */
export function difference(a, b) {
  assert.equal(a.length, b.length);
  return Math.sqrt(a.reduce((sum, value, index) => sum + (value - b[index]) ** 2, 0) / (a.length * 0.75));
}

/** How much pictures of one idle visitor differ by themselves: the largest difference to the first. */
export async function idleDifference(visitor, pictures = 5, framesBetween = 4) {
  const first = await visitor.picture();
  let largest = 0;
  for (let i = 0; i < pictures; i += 1) {
    await visitor.frames(framesBetween);
    largest = Math.max(largest, difference(first, await visitor.picture()));
  }
  return largest;
}

/** Waits; only for things that are allowed to take any time. */
export const pause = (milliseconds) => new Promise((resolve) => setTimeout(resolve, milliseconds));

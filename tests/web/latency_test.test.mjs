import assert from 'node:assert/strict';
import { test } from 'node:test';

import { LatencyTest } from '../../web/panels/latency_test.js';
import { FakeClock } from './fake_clock.mjs';

function setUp() {
  const clock = new FakeClock();
  const log = [];
  const latency = new LatencyTest({
    clock,
    sendInput: () => log.push(clock.now()),
    onChange: () => log.push(latency.isRunning ? 'begun' : 'ended'),
  });
  return { clock, log, latency };
}

const kPicture = { frame: 7, width: 1280, height: 720, codec: 2 };

test('sends inputs while it runs, changed or not', () => {
  const { clock, log, latency } = setUp();
  clock.advance(1000);
  latency.start(0.2);
  latency.start(100);
  clock.advance(60_000);
  assert.deepEqual(log, ['begun', 1000, 1050, 1100, 1150, 'ended']);
});

test('ends for any query string', () => {
  const { clock, log, latency } = setUp();
  latency.start(1e9);
  clock.advance(600_000);
  assert.equal(log.at(-1), 'ended');
  latency.start(-3);
  assert.deepEqual(log.slice(-2), ['ended', 'ended']);
});

test('has a row for each input, with times since its begin', () => {
  const { clock, latency } = setUp();
  assert.equal(latency.words, null);
  clock.advance(1000);
  latency.start(10);
  clock.advance(100);
  latency.presented([{ number: 3, time: 990, latency: 110, screen: 110 }], kPicture, 1100);
  latency.presented(
    [{ number: 4, time: 1050, latency: 50, screen: 16.25 }, { number: 5, time: 1060.5, latency: 39.5, screen: 39.5 }],
    kPicture,
    1100,
  );
  assert.equal(
    latency.csv,
    'number,sent_ms,presented_ms,latency_ms,frame,width,height,codec,screen_ms\n' +
      '4,50.00,100.00,50.00,7,1280,720,H.264,16.25\n5,60.50,100.00,39.50,7,1280,720,H.264,39.50\n',
    'not those sent before it began',
  );
  assert.equal(latency.words, 'p50 45, p95 50, p99 50 ms of 2 inputs');
  clock.advance(10_000);
  latency.presented([{ number: 6, time: 1070, latency: 90, screen: 90 }], kPicture, 11_100);
  assert.match(latency.words, /of 2 inputs$/);
  latency.start(1);
  assert.equal(latency.words, null, 'another test begins with nothing');
});

test('the size in the table is the window\'s, however wide the border', () => {
  const { clock, latency } = setUp();
  latency.start(10);
  [{ width: 640, height: 360, border: 0 }, { width: 678, height: 380, border: 6 }, { width: 716, height: 402, border: 12 }]
    .forEach((size, index) => {
      clock.advance(100);
      const input = { number: index, time: clock.now() - 10, latency: 10, screen: 10 };
      latency.presented([input], { ...kPicture, ...size }, clock.now());
    });
  const sizes = latency.csv.trim().split('\n').slice(1).map((row) => row.split(',').slice(5, 7).join('x'));
  assert.deepEqual(sizes, ['640x360', '640x360', '640x360']);
});

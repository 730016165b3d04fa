import assert from 'node:assert/strict';
import { test } from 'node:test';

import { LatencyMeter, SlidingWindow, median, quantile } from '../../web/stream/meters.js';
import { Telemetry } from '../../web/stream/telemetry.js';

test('median of odd and even counts', () => {
  assert.equal(median([]), null);
  assert.equal(median([9, 1, 5]), 5);
  assert.equal(median([1, 2, 10, 4]), 3);
});

test('a window forgets what is older than its span', () => {
  const window = new SlidingWindow(100);
  window.add(0, 'a');
  window.add(60, 'b');
  assert.deepEqual(window.values(99), ['a', 'b']);
  assert.deepEqual(window.values(100), ['b']);
  assert.deepEqual(window.values(500), []);
});

test('latency ends with the first frame that includes the input', () => {
  const meter = new LatencyMeter();
  assert.equal(meter.read(0), null);
  meter.sent(1, 100);
  meter.sent(2, 110);
  meter.presented(0, 120);
  assert.equal(meter.read(120), null);
  meter.presented(2, 150);
  assert.equal(meter.read(150), 45);
  meter.presented(2, 190);
  assert.equal(meter.read(190), 45, 'an input counts once');
});

test('latency is the median of the last second, or the last measurement', () => {
  const meter = new LatencyMeter();
  for (const [number, sent, shown] of [[1, 0, 500], [2, 1000, 1020], [3, 1100, 1130], [4, 1200, 1240]]) {
    meter.sent(number, sent);
    meter.presented(number, shown);
  }
  assert.equal(meter.read(1400), 35);
  assert.equal(meter.read(1600), 30);
  assert.equal(meter.read(9000), 40);
  meter.reset();
  assert.equal(meter.read(9000), null);
});

test('the meter is bounded during a stall', () => {
  const meter = new LatencyMeter();
  for (let number = 1; number <= 2000; number += 1) meter.sent(number, number);
  meter.presented(2000, 2000);
  assert.ok(meter.read(2000) <= 512);
});

test('a reading covers the last second', () => {
  const telemetry = new Telemetry();
  assert.deepEqual(telemetry.read(0), {
    frames: 0,
    framesPerSecond: 0,
    latencyMs: null,
    megabitsPerSecond: 0,
    serverMs: null,
    codec: null,
    width: null,
    height: null,
    visitors: null,
    decodeMs: null,
    paintMs: null,
    times: null,
    status: null,
  });
  telemetry.inputSent(1, 0);
  for (let i = 0; i < 60; i += 1) {
    const frame = {
      frame: i + 1,
      codec: 1,
      width: 1280,
      height: 720,
      visitors: 3,
      lastInput: 1,
      serverMicroseconds: 8000 + i,
      picture: new Uint8Array(12_500),
    };
    telemetry.framePresented(frame, 20 + i * 50);
    telemetry.frameReceived(frame, 20 + i * 50);
  }
  const reading = telemetry.read(20 + 59 * 50);
  assert.equal(reading.frames, 60);
  assert.equal(reading.framesPerSecond, 20);
  assert.equal(reading.latencyMs, 20);
  assert.ok(Math.abs(reading.megabitsPerSecond - 2) < 1e-9);
  assert.ok(Math.abs(reading.serverMs - 8.0495) < 1e-9);
  assert.deepEqual([reading.codec, reading.width, reading.visitors], ['JPEG', 1280, 3]);
});

test('percentiles cover ten seconds, by nearest rank', () => {
  assert.equal(quantile([], 0.5), null);
  assert.equal(quantile([3], 0.99), 3);
  const meter = new LatencyMeter();
  for (let i = 1; i <= 100; i += 1) {
    meter.sent(i, i * 10 - i);
    meter.presented(i, i * 10);
  }
  assert.deepEqual(meter.percentiles(1000), { p50: 50, p95: 95, p99: 99 });
  assert.deepEqual(meter.percentiles(10_005), { p50: 50, p95: 95, p99: 99 });
  assert.deepEqual(meter.percentiles(10_995), { p50: 100, p95: 100, p99: 100 });
  assert.deepEqual(meter.percentiles(99_000), { p50: null, p95: null, p99: null });
});

test('inputs without visible effect are not measured', () => {
  const meter = new LatencyMeter();
  meter.sent(1, 100);
  meter.sent(2, 110);
  meter.sent(3, 120);
  meter.received(1); // its picture waits for the screen
  meter.obeyed(2);
  assert.deepEqual(meter.presented(1, 140), [{ number: 1, time: 100, latency: 40, screen: 40 }]);
  assert.deepEqual(meter.presented(3, 900), [{ number: 3, time: 120, latency: 780, screen: 780 }]);
});

// Fault: the time until a step is on the screen is that of the server's picture, or of a paint before the input.
test('a moved picture shows the inputs before it', () => {
  const meter = new LatencyMeter();
  meter.sent(1, 100);
  meter.moved(110, 112);
  meter.sent(2, 115);
  meter.moved(115, 118);
  meter.moved(130, 132);
  meter.sent(3, 140);
  assert.deepEqual(meter.presented(3, 260), [
    { number: 1, time: 100, latency: 160, screen: 12 },
    { number: 2, time: 115, latency: 145, screen: 17 },
    { number: 3, time: 140, latency: 120, screen: 120 },
  ]);
});

test('a reading has the size of the window without its border', () => {
  const telemetry = new Telemetry();
  const picture = { codec: 2, width: 704, height: 396, border: 10, lastInput: 0, serverMicroseconds: 0, visitors: 1 };
  telemetry.framePresented(picture, 0);
  const { width, height, codec } = telemetry.read(0);
  assert.deepEqual([width, height, codec], [640, 360, 'H.264']);
});

test('counts arrivals in a still world', () => {
  const telemetry = new Telemetry();
  const picture = { codec: 2, width: 704, height: 396, border: 0, lastInput: 0, serverMicroseconds: 0, visitors: 1 };
  telemetry.framePresented(picture, 0);
  telemetry.statusReceived({ lastInput: 0, visitors: 3 });
  assert.equal(telemetry.read(0).visitors, 3);
});

import assert from 'node:assert/strict';
import { test } from 'node:test';

import { WorldStatistics, sharedViews, versionOf } from '../../web/world_statistics.js';
import { FakeClock } from './fake_clock.mjs';
import { sample } from './statistics_sample.mjs';

const counted = (hits, misses, near) => ({
  counters: { 'view cache hits': hits, 'view cache misses': misses, 'views too near to share': near },
});

test('the share covers requests since the last answer', () => {
  assert.equal(sharedViews(null, counted(3, 1, 0)), 0.75);
  assert.equal(sharedViews(counted(3, 1, 0), counted(4, 1, 1)), 0.5);
});

test('the share is unknown without requests and without light fields', () => {
  assert.equal(sharedViews(counted(3, 1, 0), counted(3, 1, 0)), null);
  assert.equal(sharedViews(null, { counters: {} }), null);
  assert.equal(sharedViews({}, {}), null);
});

test('an older server reports no version', () => {
  assert.equal(versionOf(sample()), '1.2.3');
  assert.equal(versionOf({ visitors: 0 }), null);
  assert.equal(versionOf({ version: 2 }), null);
});

test('polls once per second while visible, and forgets a lost server', async () => {
  const clock = new FakeClock();
  let asked = 0;
  let alive = true;
  const statistics = new WorldStatistics(async () => {
    asked += 1;
    if (!alive) throw new Error('gone');
    return { ...sample(), ...counted(asked * 9, asked, 0) };
  }, clock);
  statistics.watch(true);
  await Promise.resolve();
  assert.equal(asked, 1);
  assert.equal(statistics.read().sharedViews, 0.9);
  assert.equal(statistics.read().amortization.visitorsFit, 5);
  assert.equal(statistics.read().version, '1.2.3');
  alive = false;
  clock.advance(1000);
  await new Promise((done) => setImmediate(done));
  assert.equal(asked, 2);
  assert.deepEqual(statistics.read(), { version: null, sharedViews: null, amortization: null });
  statistics.watch(false);
  clock.advance(5000);
  assert.equal(asked, 2);
});

import assert from 'node:assert/strict';
import { test } from 'node:test';

import { WorldStatistics, sharedViews, versionOf } from '../../web/world_statistics.js';
import { FakeClock } from './fake_clock.mjs';
import { sample } from './statistics_sample.mjs';

const reused = (views_made, uses_again, uses_by_others) => ({
  amortization: { reuse: { views_made, uses_again, uses_by_others } },
});

test("a visitor's own reuse is not sharing", () => {
  assert.equal(sharedViews(reused(1, 99, 0)), 0);
  assert.equal(sharedViews(reused(1, 2, 1)), 0.25);
});

test('the share without a use is not known, and neither is that of an older server', () => {
  assert.equal(sharedViews(reused(0, 0, 0)), null);
  assert.equal(sharedViews(reused(1, 'many', 0)), null);
  assert.equal(sharedViews({ counters: { 'view cache hits': 3 } }), null);
  assert.equal(sharedViews({ amortization: null }), null);
  assert.equal(sharedViews(null), null);
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
    return sample();
  }, clock);
  statistics.watch(true);
  await Promise.resolve();
  assert.equal(asked, 1);
  assert.equal(statistics.read().sharedViews, 0.2);
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

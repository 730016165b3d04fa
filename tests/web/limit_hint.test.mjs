import assert from 'node:assert/strict';
import { test } from 'node:test';

import { LimitHint } from '../../web/panels/limit_hint.js';
import { LimitedBy } from '../../web/stream/protocol.js';
import { FakeClock } from './fake_clock.mjs';

function setUp() {
  const clock = new FakeClock();
  const element = { hidden: true, textContent: '' };
  const hint = new LimitHint(element, clock);
  const limited = (limitedBy, framesPerSecond = 20, lines = 480) => hint.update({ limitedBy, framesPerSecond }, lines);
  return { clock, element, hint, limited };
}

test('names a slow line and its effect on the stream', () => {
  const { clock, element, limited } = setUp();
  limited(LimitedBy.line);
  clock.advance(1000);
  limited(LimitedBy.line);
  clock.advance(999);
  assert.equal(element.hidden, true);
  clock.advance(1);
  assert.equal(element.hidden, false);
  assert.equal(element.textContent, 'Slow connection: 480 lines, 20 frames/s');
  limited(LimitedBy.line, 15, 360);
  assert.equal(element.textContent, 'Slow connection: 360 lines, 15 frames/s');
});

test('ignores short lapses and recoveries', () => {
  const { clock, element, limited } = setUp();
  limited(LimitedBy.line);
  clock.advance(1500);
  limited(LimitedBy.nothing);
  clock.advance(10_000);
  assert.equal(element.hidden, true);
  limited(LimitedBy.line);
  clock.advance(2000);
  limited(LimitedBy.nothing);
  clock.advance(2000);
  limited(LimitedBy.line);
  clock.advance(10_000);
  assert.equal(element.hidden, false);
  limited(LimitedBy.visitor);
  clock.advance(3000);
  assert.equal(element.hidden, true, 'a limit by choice is no slow line');
});

test('a lost connection removes the notice', () => {
  const { clock, element, hint, limited } = setUp();
  limited(LimitedBy.line);
  clock.advance(1000);
  hint.reset();
  clock.advance(10_000);
  assert.equal(element.hidden, true);
});

test('names browser and server alike', () => {
  for (const [limit, words] of [
    [LimitedBy.browser, 'Your browser is busy: 480 lines, 20 frames/s'],
    [LimitedBy.machine, 'The server is busy: 480 lines, 20 frames/s'],
  ]) {
    const { clock, element, limited } = setUp();
    limited(limit);
    clock.advance(2000);
    assert.equal(element.hidden, false);
    assert.equal(element.textContent, words);
  }
});

test('the notice changes at once with the bottleneck', () => {
  const { clock, element, limited } = setUp();
  limited(LimitedBy.line);
  clock.advance(2000);
  limited(LimitedBy.browser);
  assert.match(element.textContent, /^Your browser/);
  clock.advance(10_000);
  assert.equal(element.hidden, false);
});

import assert from 'node:assert/strict';
import { test } from 'node:test';

import { paths, roundUp } from '../../web/operator/chart.js';
import { History } from '../../web/operator/history.js';
import { Poll } from '../../web/operator/poll.js';
import { situation } from '../../web/operator/situation.js';
import { FakeClock } from './fake_clock.mjs';
import { sample } from './statistics_sample.mjs';

test('lists the conditions before the figures', () => {
  const title = (statistics) => situation('live', statistics, '12:00')?.title;
  assert.equal(title(sample()), undefined);
  assert.equal(title({ ...sample(), amortization: null, visitors: 0 }), 'No visitors');
  assert.equal(title({ ...sample(), amortization: null, visitors: 1 }), 'A visitor has arrived');
  const joined = (state, reason) => title({ ...sample(), world: { state, visitors: 3, reason } });
  assert.equal(joined('joined'), undefined);
  assert.match(joined('lost'), /owner of this world is lost/);
  assert.match(joined('connecting'), /does not answer/);
  assert.match(situation('live', { ...sample(), world: { state: 'refused', reason: 'it shows another scene' } }, '12:00').text, /another scene/);
  assert.equal(title({ visitors: 2, stages: {}, counters: {} }), 'This server does not report what sharing saves');
});

test('marks old figures with their time', () => {
  const lost = situation('lost', null, '12:00:01');
  assert.match(`${lost.title}. ${lost.text}`, /cannot be reached.*figures are from 12:00:01.*Trying again/s);
  assert.doesNotMatch(situation('lost', null, null).text, /figures are from/);
  assert.equal(situation('paused', null, '12:00').title, 'Paused');
  assert.match(situation('asking', null, null).title, /Connecting/);
  assert.equal(situation('asking', null, '12:00'), null, 'a moment later it is live');
});

test('history covers two minutes', () => {
  const history = new History();
  for (let second = 0; second <= 200; second += 1) history.add(second * 1000, { visitors: second, alpha: undefined });
  const points = history.of('visitors');
  assert.deepEqual(points[0], { time: 80_000, value: 80 });
  assert.deepEqual(points.at(-1), { time: 200_000, value: 200 });
  assert.equal(history.of('alpha')[0].value, null);
});

test('axes end at round numbers', () => {
  assert.deepEqual([0.3, 1, 3, 5, 5.1, 12, 99, 101].map(roundUp), [0.5, 1, 5, 5, 10, 20, 100, 200]);
});

test('a line ends at the right and has gaps for unknown values', () => {
  const at = (second, value) => ({ time: second * 1000, value });
  const { line, area } = paths([at(0, 0), at(60, 2), at(61, 4), at(62, null), at(63, 1), at(120, 9)], 120_000, 4);
  assert.equal(line, 'M0.0 60.0h.1M120.0 30.0L122.0 0.0M126.0 45.0h.1M240.0 0.0h.1');
  assert.equal(area.match(/Z/g).length, 4);
  assert.deepEqual(paths([], 0, 4), { line: '', area: '' });
});

function polled(ask) {
  const clock = new FakeClock();
  const said = [];
  const on = { answer: (answer) => said.push(answer), lost: () => said.push('lost') };
  const backoff = { next: () => 2000, reset: () => {} };
  const poll = new Poll({ ask, on, timers: clock, backoff });
  const pass = async (time) => {
    clock.advance(time);
    await new Promise((done) => setImmediate(done));
  };
  return { poll, said, pass };
}

test('polls once per second, and slower without answers', async () => {
  let asked = 0;
  let alive = true;
  const { poll, said, pass } = polled(async () => {
    asked += 1;
    if (!alive) throw new Error('gone');
    return asked;
  });
  poll.start();
  await pass(0);
  await pass(1000);
  assert.deepEqual(said, [1, 2]);
  alive = false;
  await pass(1000);
  await pass(1000);
  assert.equal(asked, 3, 'it waits longer');
  alive = true;
  await pass(1000);
  await pass(1000);
  assert.deepEqual(said, [1, 2, 'lost', 4, 5]);
});

test('a silent server counts as gone, and its late answer is ignored', async () => {
  const answers = [];
  const { poll, said, pass } = polled(() => new Promise((resolve) => answers.push(resolve)));
  poll.start();
  await pass(5000);
  assert.deepEqual(said, ['lost']);
  answers[0]('late');
  await pass(0);
  assert.deepEqual(said, ['lost']);
  await pass(2000);
  answers[1]('again');
  await pass(0);
  assert.deepEqual(said, ['lost', 'again']);
});

test('a stopped poller neither asks nor listens', async () => {
  const answers = [];
  const { poll, said, pass } = polled(() => new Promise((resolve) => answers.push(resolve)));
  poll.start();
  poll.stop();
  answers[0]('late');
  await pass(60_000);
  assert.deepEqual([answers.length, said], [1, []]);
  poll.start();
  answers[1]('here');
  await pass(0);
  assert.deepEqual(said, ['here']);
});

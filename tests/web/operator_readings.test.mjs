import assert from 'node:assert/strict';
import { test } from 'node:test';

import { amortizationOf } from '../../web/amortization.js';
import { writeFigures } from '../../web/operator/figures_panel.js';
import { frameCost, total } from '../../web/operator/frame_cost.js';
import { linksOf } from '../../web/operator/links.js';
import { memoryOf } from '../../web/operator/memory.js';
import { Processes } from '../../web/operator/processes.js';
import { Readings } from '../../web/operator/readings.js';
import { sample } from './statistics_sample.mjs';

function later(statistics, runs, cpu) {
  const next = structuredClone(statistics);
  for (const stage of Object.values(next.stages)) {
    stage.runs += runs;
    stage.cpu_ms += cpu;
  }
  return next;
}

const stage = (readings, name) => readings.stages().find((entry) => entry.name === name);

test('rates need two readings', () => {
  const readings = new Readings();
  assert.deepEqual(readings.stages(), []);
  assert.equal(readings.newest, null);
  assert.equal(readings.cacheHits(), null);
  readings.add(0, sample());
  assert.deepEqual(
    { ...stage(readings, 'Encoder') },
    { name: 'Encoder', work: 'per-user-frontend', runsPerSecond: null, cpuPerRun: null, share: null, failures: 0 },
  );
  readings.add(2000, later(sample(), 60, 150));
  const { runsPerSecond, cpuPerRun, share } = stage(readings, 'Encoder');
  assert.deepEqual([runsPerSecond, cpuPerRun, share], [30, 2.5, 0.25]);
});

test('rates are of the last five seconds', () => {
  const readings = new Readings();
  let statistics = sample();
  for (let second = 0; second <= 20; second += 1) {
    readings.add(second * 1000, statistics);
    statistics = later(statistics, second < 10 ? 30 : 10, 20);
  }
  assert.equal(stage(readings, 'Renderer').runsPerSecond, 10);
});

test('an idle stage has no cost per run, and a new one counts from zero', () => {
  const readings = new Readings();
  const { Encoder: encoder, ...others } = sample().stages;
  readings.add(0, { ...sample(), stages: others });
  readings.add(1000, sample());
  assert.equal(stage(readings, 'Renderer').cpuPerRun, null);
  assert.equal(stage(readings, 'Renderer').runsPerSecond, 0);
  assert.equal(stage(readings, 'Encoder').runsPerSecond, encoder.runs);
});

test('does not compare readings across a restart of the server', () => {
  for (const forget of [(s) => (s.stages.Encoder.runs = 4), (s) => delete s.stages.Encoder, (s) => (s.counters = {})]) {
    const readings = new Readings();
    readings.add(0, sample());
    const fresh = sample();
    forget(fresh);
    readings.add(1000, fresh);
    assert.equal(stage(readings, 'Renderer').runsPerSecond, null);
    assert.equal(readings.newest, fresh);
  }
});

test('across-user stages come first, and malformed ones are skipped', () => {
  const readings = new Readings();
  const strange = { runs: 2, work: 'night work', cpu_ms: 'much' };
  const odd = { Broken: null, Empty: {}, Negative: { runs: -3 }, Strange: strange };
  readings.add(0, { stages: { ...odd, ...sample().stages } });
  readings.add(1000, { stages: { ...odd, ...sample().stages } });
  const names = readings.stages().map(({ name }) => name);
  assert.deepEqual(names, ['Simulation Tick', 'Renderer', 'Compositor', 'Encoder', 'Strange']);
  readings.add(2000, {});
  assert.deepEqual(readings.stages(), []);
});

test('hits of the cache are those of other visitors', () => {
  const readings = new Readings();
  readings.add(0, sample());
  assert.equal(readings.cacheHits(), 0.2);
});

test('work that views cause stands between work for everybody and for one', () => {
  const readings = new Readings();
  const view = { work: 'on-demand', runs: 1, failures: 0, cpu_ms: 1, wall_ms: 1 };
  readings.add(0, { stages: { 'A View': view, ...sample().stages } });
  const names = readings.stages().map(({ name }) => name);
  assert.deepEqual(names, ['Simulation Tick', 'A View', 'Renderer', 'Compositor', 'Encoder']);
});

test('the cost of a frame includes its share of across-user work', () => {
  const cost = frameCost(amortizationOf(sample()));
  assert.equal(cost.now.shared, 14.5 / 3);
  assert.equal(cost.now.other, 0.7);
  assert.ok(Math.abs(total(cost.alone) - 24.4) < 1e-9, 'as the server predicts');
  assert.equal(cost.alone.frontend, 5.5);
});

test('links lead to nodes, and to the owner of the world in another process', () => {
  assert.deepEqual(linksOf(sample()), [], 'an older server tells nothing');
  const node = { name: 'the node at a:1', state: 'welcomed', round_trip_ms: 0.4 };
  assert.deepEqual(linksOf({ nodes: [node], world: { state: 'own', visitors: 1 } }), [node]);
  const [first, owner] = linksOf({ nodes: [node], world: { state: 'lost', reason: 'gone', round_trip_ms: null } });
  assert.deepEqual(first, node);
  assert.deepEqual([owner.name, owner.state, owner.reason], ['the owner of this world', 'lost', 'gone']);
});

test('the cost of a frame is unknown without its parts', () => {
  for (const odd of [{ c_b_ms: null }, { c_i_ms: -1 }, { visitors: 0 }]) {
    assert.equal(frameCost(amortizationOf({ amortization: { ...sample().amortization, ...odd } })), null);
  }
  const little = { ...sample().amortization, other_ms: null, private_frame_ms: -1 };
  const less = frameCost(amortizationOf({ amortization: little }));
  assert.deepEqual([less.now.other, less.alone], [0, null]);
});

test('memory is listed by holder, the largest first, with the unnamed rest', () => {
  const { resident, holders, told, rest } = memoryOf(sample());
  assert.deepEqual(holders.map(({ name }) => name), ['light fields', 'shared views', 'targets']);
  assert.equal(holders[0].share, 752.1 / resident);
  assert.ok(Math.abs(told + rest - resident) < 1e-9);
});

test('holders may exceed resident memory, malformed ones are skipped, and older servers have none', () => {
  const memory = { resident_mb: 100, holders: [{ holder: 'files', mb: 130 }, { holder: 'odd', mb: -4 }, null] };
  const { holders, rest } = memoryOf({ memory });
  assert.deepEqual([holders.length, rest], [1, null]);
  assert.equal(memoryOf({ memory: { resident_mb: 100 } }).rest, 100);
  for (const odd of [{}, null, { memory: null }, { memory: { resident_mb: -1 } }]) assert.equal(memoryOf(odd), null);
});

test('nodes have their own stages, memory and rates', () => {
  const node = (name, runs) => ({
    name,
    state: 'welcomed',
    stages: { Renderer: { work: 'per-user-backend', runs, failures: 0, cpu_ms: runs, wall_ms: runs } },
    memory: { resident_mb: 129, holders: [{ holder: 'view cache', type: 'lightfield', work: 'across-user', mb: 100 }] },
  });
  const away = { name: 'away', state: 'lost', stages: null, memory: null };
  const processes = new Processes();
  processes.add(0, { ...sample(), nodes: [node('a', 10), away] });
  processes.add(1000, { ...later(sample(), 60, 150), nodes: [node('a', 40), node('b', 5)] });
  const rates = () => processes.stages().map(({ process, stages }) => [process, stages[0].runsPerSecond]);
  assert.deepEqual(rates(), [['this server', 60], ['a', 30], ['b', null]]);
  assert.equal(processes.stages()[1].stages[0].share, 1, 'of the CPU time of its process');
  const resident = processes.memory().map(({ process, memory }) => [process, memory.resident]);
  assert.deepEqual(resident, [['this server', 1439.2], ['a', 129], ['b', 129]]);
  processes.add(2000, { ...later(sample(), 120, 300), nodes: [node('a', 3), away] });
  assert.deepEqual(rates(), [['this server', 60], ['a', null]], 'a has started anew, which does not concern the server');
  processes.clear();
  assert.deepEqual(processes.stages(), [{ process: 'this server', stages: [] }]);
});

test('the operator sees what a busy machine gives', () => {
  const notes = (statistics) => {
    const elements = new Map();
    const root = {
      querySelector(selector) {
        if (!elements.has(selector)) elements.set(selector, {});
        return elements.get(selector);
      },
    };
    writeFigures(root, { statistics, amortization: amortizationOf(statistics.amortization), cacheHits: null });
    return elements.get('[data-note=fps]').textContent;
  };
  assert.doesNotMatch(notes(sample()), /machine/);
  assert.doesNotMatch(notes({ ...sample(), picture_scale: 1 }), /machine/);
  assert.match(notes({ ...sample(), picture_scale: 2 / 3 }), /machine is busy.*67 %/);
  assert.match(notes({ ...sample(), picture_scale: 1, moved_pictures_per_second: 20 }), /machine is busy.*late walk gets 20/);
  assert.match(
    notes({ ...sample(), picture_scale: 2 / 3, moved_pictures_per_second: 15 }),
    /machine is busy.*67 %.*and late walk gets 15/,
  );
  assert.doesNotMatch(notes({ ...sample(), picture_scale: 1, moved_pictures_per_second: null }), /machine/);
});

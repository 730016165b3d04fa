import assert from 'node:assert/strict';
import { test } from 'node:test';

import { amortizationOf, perUser } from '../../web/amortization.js';
import { sample } from './statistics_sample.mjs';

test('reads the answer of the server', () => {
  const told = amortizationOf(sample());
  assert.deepEqual([told.visitors, told.acrossUser, told.cpuCores, told.cores], [3, 14.5, 1.31, 2]);
  assert.deepEqual([told.visitorsFit, told.privateVisitorsFit], [5, 2]);
  assert.equal(perUser(told), 8.5);
  assert.deepEqual(told.types.map(({ name }) => name), ['', 'fluid', 'lightfield']);
  assert.equal(told.types[1].acrossUserMb, 40.2);
});

test('handles empty, older and missing servers', () => {
  for (const odd of [{ amortization: null }, {}, null, undefined, { amortization: 7 }, { amortization: [] }, 'no']) {
    assert.equal(amortizationOf(odd), null);
  }
});

test('impossible values are unknown, the rest is kept', () => {
  const odd = sample();
  Object.assign(odd.amortization, { alpha: -0.2, beta: 1.5, c_b_ms: 'much', visitors_fit: null });
  odd.amortization.types = { fluid: null, mesh: {} };
  delete odd.amortization.cpu_cores;
  const told = amortizationOf(odd);
  for (const name of ['alpha', 'beta', 'backend', 'visitorsFit', 'cpuCores']) assert.equal(told[name], null, name);
  assert.equal(perUser(told), null);
  assert.equal(told.acrossUser, 14.5);
  assert.deepEqual(told.types.map(({ name, alpha }) => [name, alpha]), [['mesh', null]]);
});

test('there is no share without requests', () => {
  const none = { ...sample().amortization, across_user_mb: 0, per_visitor_mb: 0, beta: 0, alpha: 0 };
  const told = amortizationOf({ amortization: none });
  assert.deepEqual([told.alpha, told.beta], [0, null], 'where no memory is told of, nothing is known of sharing it');
});

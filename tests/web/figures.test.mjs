import assert from 'node:assert/strict';
import { test } from 'node:test';

import { bitRate, fixed, known, megabytes, milliseconds, percent, plain, share, visitors, whole } from '../../web/figures.js';

const kOdd = [null, undefined, NaN, Infinity, -1, '7', {}, true];

test('malformed figures are unknown', () => {
  for (const odd of kOdd) {
    assert.equal(known(odd), null);
    for (const tell of [bitRate, plain, share, percent, milliseconds, megabytes, whole]) assert.equal(tell(odd), '\u2013');
    assert.equal(fixed(odd, 2), '\u2013');
  }
  assert.equal(known(0), 0);
});

test('shows few digits and loses none at the boundaries', () => {
  const cases = [[1234.5, '1,235'], [99.96, '100'], [99.94, '99.9'], [48.19, '48.2'], [9.996, '10.0'], [9.99, '9.99'],
    [1.314, '1.31'], [0.02, '0.02'], [0.004, '< 0.01'], [0, '0']];
  for (const [value, text] of cases) assert.equal(plain(value), text);
  assert.equal(fixed(1499.16, 1), '1,499.2');
  assert.equal(fixed(0.03, 1), '< 0.1');
});

test('99.9 % is not shown as 100 %, nor 0.1 % as 0', () => {
  assert.deepEqual([0, 0.001, 0.784, 0.996, 1].map(share), ['0.00', '< 0.01', '0.78', '> 0.99', '1.00']);
  assert.deepEqual([0, 0.001, 0.784, 0.996, 1].map(percent), ['0 %', '< 1 %', '78 %', '> 99 %', '100 %']);
});

test('chooses fitting units', () => {
  assert.equal(milliseconds(14.5128), '14.5 ms');
  assert.deepEqual([0.04, 752.1, 1439].map(megabytes), ['0.04 MB', '752 MB', '1.44 GB']);
  assert.deepEqual([0, 0.04, 0.9996, 16].map(bitRate), ['0 kbit/s', '40.0 kbit/s', '1.0 Mbit/s', '16.0 Mbit/s']);
  assert.deepEqual([0, 1, 8].map(visitors), ['0 visitors', '1 visitor', '8 visitors']);
});

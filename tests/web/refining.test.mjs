import assert from 'node:assert/strict';
import { test } from 'node:test';

import { Refining } from '../../web/panels/refining.js';

const said = (message) => {
  const element = { hidden: true, textContent: '' };
  new Refining(element).show(message);
  return element.hidden ? null : element.textContent.replaceAll('\u00a0', ' ');
};

test('shows progress and the remaining time', () => {
  const told = (percent, secondsLeft) => said({ percent, secondsLeft, step: 'oak' });
  assert.equal(told(37, 73), 'Improving the detail: 37 %, about 75 s left');
  assert.equal(told(98, 1), 'Improving the detail: 98 %, about 5 s left');
  assert.equal(told(5, 400), 'Improving the detail: 5 %, about 7 minutes left');
});

test('shows no time if none is known', () => {
  assert.equal(said({ percent: 0, secondsLeft: null, step: '' }), 'Improving the detail: 0 %');
});

test('disappears when done', () => {
  assert.equal(said({ percent: 100, secondsLeft: 0, step: '' }), null);
});

import assert from 'node:assert/strict';
import { test } from 'node:test';

import { PaintBudget } from '../../web/picture/paint_budget.js';

const judge = (paints) => {
  const budget = new PaintBudget();
  return paints.map((paint) => budget.isExceededBy(paint)).indexOf(true);
};

test('twelve slow paints count, a single one does not', () => {
  assert.equal(judge(Array(12).fill(9)), 11, 'not before there are a dozen');
  assert.equal(judge(Array(40).fill(8)), -1, 'what is just quick enough stays');
  assert.equal(judge([...Array(30).fill(1), 500, 500, 500, ...Array(30).fill(1)]), -1);
  assert.equal(judge([...Array(12).fill(1), ...Array(12).fill(9)]), 18, 'the last dozen counts');
});

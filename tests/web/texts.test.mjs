import assert from 'node:assert/strict';
import { readFileSync } from 'node:fs';
import { test } from 'node:test';

import { kDefaultKeys } from '../../web/input/bindings.js';
import { kOperatorPage, kPage, kStatistics } from '../../web/texts.js';

const read = (name) => readFileSync(new URL(`../../web/${name}`, import.meta.url), 'utf8');

/** Without its text an element would be empty, and the page would not start. */
test('every text that a page names exists, and each is used', () => {
  for (const [page, texts] of [['index.html', kPage], ['operator.html', kOperatorPage]]) {
    const named = new Set([...read(page).matchAll(/data-words="(\w+)"/g)].map(([, name]) => name));
    assert.deepEqual([...named].sort(), Object.keys(texts).sort(), page);
  }
});

test('page bodies contain no texts but those shown without scripts', () => {
  for (const [page, known] of [['index.html', ['Grove', 'Entering the grove\u2026']], ['operator.html', ['Grove']]]) {
    const body = read(page).match(/<body>([^]*)<noscript>/)[1];
    const words = body.replaceAll(/<[^>]*>/g, '\n').split('\n').map((line) => line.trim()).filter(Boolean);
    assert.deepEqual([...new Set(words)], known, page);
  }
});

test('texts name keys by their actions', () => {
  const texts = Object.values(kPage).map((entry) => entry.text ?? entry).filter((text) => typeof text === 'string');
  const named = texts.flatMap((text) => [...text.matchAll(/\{(\w+)\}/g)].map(([, name]) => name));
  assert.ok(named.length > 10);
  for (const name of named) assert.ok(name === 'walking' || name in kDefaultKeys, name);
});

test('singular and plural', () => {
  assert.equal(kStatistics.visitors(1, '1'), '1 visitor');
  assert.equal(kStatistics.visitors(0, '0'), '0 visitors');
  assert.equal(kStatistics.visitors(1200, '1,200'), '1,200 visitors');
});

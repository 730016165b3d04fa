import assert from 'node:assert/strict';
import { readFileSync } from 'node:fs';
import { test } from 'node:test';

/** The file's tables, each as one text. */
const tablesOf = (path) =>
  readFileSync(new URL(`../../${path}`, import.meta.url), 'utf8')
    .split(/\n\n(?=\[)/)
    .map((text) => text.trim());

// Fault: the default world changes, and what is compared with it does not.
test('the rich scene is the default world with more fires', () => {
  const rich = new Set(tablesOf('tests/scenes/rich.toml'));
  const missing = tablesOf('server/world/scenes/grove.toml').filter((table) => !rich.has(table));
  const [head, fire, ...others] = missing;
  assert.match(head, /^# The default world/);
  assert.match(fire, /type = "fluid"/);
  assert.deepEqual(others, []);
});

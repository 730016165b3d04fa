import assert from 'node:assert/strict';
import { execFileSync } from 'node:child_process';
import { readFileSync } from 'node:fs';
import { test } from 'node:test';
import { fileURLToPath } from 'node:url';

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

// Fault: somebody edits the vale by hand, and the next run of the script loses it.
test('the vale is what its script writes', () => {
  const script = fileURLToPath(new URL('../../deploy/scenes/vale.mjs', import.meta.url));
  const scene = readFileSync(new URL('../../server/world/scenes/vale.toml', import.meta.url), 'utf8');
  assert.equal(execFileSync(process.execPath, [script], { encoding: 'utf8' }), scene);
});

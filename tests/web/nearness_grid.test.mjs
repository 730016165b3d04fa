import assert from 'node:assert/strict';
import { readFileSync } from 'node:fs';
import { test } from 'node:test';

import { cellsOf } from '../../web/picture/depth_grid.js';
import { decodeNearness } from '../../web/picture/nearness_grid.js';
import { ProtocolError } from '../../web/stream/protocol_error.js';

const golden = JSON.parse(readFileSync(new URL('../stream/late_walk/golden_grids.json', import.meta.url), 'utf8'));
const bytesOf = (hex) => Uint8Array.from(hex.match(/../g) ?? [], (byte) => parseInt(byte, 16));
const find = (name) => golden.find((entry) => entry.name === name);

// Fault: a page that reads another grid than the server wrote.
for (const { name, width, height, values, code } of golden) {
  test(`reads the grid of ${name}`, () => {
    const { columns, rows } = cellsOf({ width, height });
    const read = decodeNearness(bytesOf(code), columns, rows);
    assert.deepEqual([...read], [...bytesOf(values)].map((value) => value / 64));
  });
}

// Fault: a page that takes bytes for a grid that no server makes of them.
test('refuses bytes that are no grid of this size', () => {
  const code = bytesOf(find('leaves').code);
  const { columns, rows } = cellsOf(find('leaves'));
  assert.throws(() => decodeNearness(Uint8Array.of(...code, 0), columns, rows), ProtocolError);
  assert.throws(() => decodeNearness(code, columns + 1, rows), ProtocolError);
});

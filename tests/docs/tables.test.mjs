import assert from 'node:assert/strict';
import { readFileSync } from 'node:fs';
import { join } from 'node:path';
import { test } from 'node:test';

import { filled, pages, partsIn } from '../../deploy/measure/documents.mjs';
import { kParts } from '../../deploy/measure/parts.mjs';
import { kMeasured, kRoot } from '../../deploy/measure/paths.mjs';

const read = (path) => readFileSync(join(kRoot, path), 'utf8');

// Fault: a figure that nobody measured, or that is older than the others of its table.
test('tables of the documents are what deploy/tables measured', () => {
  for (const page of pages()) assert.equal(read(page), filled(read(page)), page);
});

// Faults: a table that no reader finds; a figure without processor or score.
test('each part has been measured, names its machine and is in a document', () => {
  const shown = pages().flatMap((page) => partsIn(read(page)));
  for (const { name, commands } of kParts) {
    assert.ok(shown.includes(name), `${name} is in no document`);
    const measured = JSON.parse(read(`${kMeasured}/${name}.json`));
    assert.ok(measured.processor && measured.score > 0 && measured.cores > 0, name);
    assert.ok(measured.rows.length > 0, name);
    assert.deepEqual(measured.commands, commands, `${name}: measure it again`);
  }
});

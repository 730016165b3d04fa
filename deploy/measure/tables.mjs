// Measures parts on this machine, keeps their rows in deploy/measured, and writes the tables into the documents.
//   node deploy/measure/tables.mjs [PART…]    all parts if none is named
//   node deploy/measure/tables.mjs --write    only the documents, from what was measured before
import { mkdirSync, writeFileSync } from 'node:fs';

import { writeDocuments } from './documents.mjs';
import { runGrove } from './grove.mjs';
import { kMeasured, kRoot, say } from './paths.mjs';
import { partsOf } from './parts.mjs';

async function measure(part) {
  say(`measuring: ${part.name}`);
  const machine = JSON.parse(await runGrove('bench machine --json'));
  const rows = await part.measure();
  const document = {
    part: part.name,
    commands: part.commands,
    processor: machine.processor,
    cores: machine.cores,
    score: Math.round(machine.score),
    date: new Date().toISOString().slice(0, 10),
    rows,
  };
  writeFileSync(`${kMeasured}/${part.name}.json`, `${JSON.stringify(document, null, 1)}\n`);
}

process.chdir(kRoot);
mkdirSync(kMeasured, { recursive: true });
const names = process.argv.slice(2);
if (names[0] !== '--write') {
  for (const part of partsOf(names)) await measure(part);
}
writeDocuments();

import { parseArgs } from 'node:util';

import { kGroups } from './attacks/all.mjs';
import { keepsHisRate, neverStops } from './bounds.mjs';
import { Place, makeFailedRow, makeRow } from './row.mjs';
import { header, textOf } from './table.mjs';
import { now, pause } from './time.mjs';

/**
 * Attacks real servers of the default world, with an innocent visitor beside, and tells what that did to him and to
 * them. Exit status: 0 if every bound was met, 1 if not, 2 for a mistake, 130 if it was interrupted.
 *
 *   node run.mjs [--json] [GROUP...]
 */

/** If this row misses a bound, the machine has too much else to do for the others to say anything about Grove. */
const kNobody = {
  name: 'nobody',
  seconds: 8,
  here: true,
  attack: () => pause(8),
  bounds: (row) => [keepsHisRate(row), neverStops(row)],
};

function readCommandLine() {
  const names = kGroups.map(({ name }) => name);
  try {
    const { values, positionals } = parseArgs({ options: { json: { type: 'boolean' } }, allowPositionals: true });
    const unknown = positionals.filter((name) => !names.includes(name));
    if (unknown.length > 0) throw new Error(`no such group: ${unknown.join(', ')}`);
    const isWanted = ({ name }) => positionals.length === 0 || positionals.includes(name);
    return { json: values.json, groups: kGroups.filter(isWanted) };
  } catch (error) {
    console.error(`${error.message}\nusage: deploy/test hostile [--json] [GROUP...]\ngroups: ${names.join(', ')}`);
    process.exit(2);
  }
}

const { json, groups } = readCommandLine();
const print = json ? console.error : console.log;
const began = now();
const rows = [];

/** Each on the group's server; on a new one if that did not survive, or sent the innocent visitor away. */
async function runGroup({ name, options, attacks, startsItsOwn = false }) {
  let place = null;
  for (const attack of attacks) {
    let row;
    try {
      if (!startsItsOwn) place ??= await Place.open(options);
      row = await makeRow(attack, place);
    } catch (error) {
      row = makeFailedRow(attack, error.message);
    }
    rows.push({ group: name, ...row });
    print(textOf(row));
    if (place && (place.server.end || row.visitor?.ended !== null)) {
      await place.close();
      place = null;
    }
  }
  await place?.close();
}

print(header());
await runGroup({ name: 'nobody', attacks: [kNobody] });
for (const group of groups) await runGroup(group);

const missed = rows.filter(({ met }) => !met);
const met = missed.length === 0;
const seconds = Math.round(now() - began);
const count = `${missed.length} of ${rows.length} rows`;
print(`${met ? 'every bound is met' : `${count} missed a bound`} (${seconds} s)`);
const document = json ? `${JSON.stringify({ met, seconds, rows }, null, 2)}\n` : '';
// Does not wait for what an attack may have left, but for who reads.
process.stdout.write(document, () => process.exit(met ? 0 : 1));

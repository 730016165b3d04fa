import { parseArgs } from 'node:util';

import { framesInFlight } from './frames_in_flight.mjs';
import { stopServers } from './stops.mjs';

/**
 * Real servers for as long as rare faults need to show. Exit status: 0 if there was none, 1 if there was, 2 for a mistake.
 *
 *   node run.mjs [--stops N] [--minutes N] [stops] [frames]
 */
const kParts = { stops: stopServers, frames: framesInFlight };

function readCommandLine() {
  try {
    const options = { stops: { type: 'string', default: '500' }, minutes: { type: 'string', default: '5' } };
    const { values, positionals } = parseArgs({ options, allowPositionals: true });
    const [stops, minutes] = [Number(values.stops), Number(values.minutes)];
    if (!(stops >= 1) || !(minutes > 0)) throw new Error('--stops and --minutes take a number over 0');
    const unknown = positionals.filter((name) => !(name in kParts));
    if (unknown.length > 0) throw new Error(`no such part: ${unknown.join(', ')}`);
    return { stops, minutes, parts: positionals.length > 0 ? positionals : Object.keys(kParts) };
  } catch (error) {
    console.error(`${error.message}\nusage: run.mjs [--stops N] [--minutes N] [${Object.keys(kParts).join('] [')}]`);
    process.exit(2);
  }
}

const { parts, ...lengths } = readCommandLine();
let failed = false;
for (const name of parts) {
  const { result, faults } = await kParts[name](lengths);
  console.log(`${name}: ${JSON.stringify(result)}`);
  for (const fault of faults) console.log(`${name}: ${fault}`);
  failed ||= faults.length > 0;
}
process.exit(failed ? 1 : 0);

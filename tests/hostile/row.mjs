import { kNewcomer } from './addresses.mjs';
import { is } from './bounds.mjs';
import { HelperProcess } from './helper_process.mjs';
import { PeakMeter, cpuSeconds, descriptors, residentMegabytes } from './readings.mjs';
import { Server } from './server.mjs';
import { now, pause, within } from './time.mjs';

/** One row of the table: one attack upon one server, and what came of it. */

const kWarmSeconds = 4;
const kCalmSeconds = 4;
const kAfterSeconds = 2;
/** An attack that goes on for so much longer than it should hangs. */
const kPatience = 40;
/** Enough to leave the server its turn, not so much that a busy machine stops them. */
const kAttackersNiceness = 10;
const kShownLines = 40;

/** A server with the innocent visitor in it. */
export class Place {
  static async open(options = []) {
    const place = new Place();
    place.server = await Server.listening({ options });
    place.innocents = new HelperProcess('innocents.mjs');
    try {
      await place.innocents.call('enter', { port: place.server.port }, kPatience);
    } catch (error) {
      await place.close();
      throw error;
    }
    await pause(kWarmSeconds);
    return place;
  }

  /** What the innocent visitor saw since the last reading. */
  readVisitor() {
    return this.innocents.call('read', null, kPatience).catch((error) => ({ ended: error.message }));
  }

  async close() {
    await this.innocents.end();
    if (!this.server.end) await this.server.stop();
  }
}

async function perform(attack, place) {
  const { name, seconds, here = false, niceness = kAttackersNiceness } = attack;
  const patience = seconds + kPatience;
  if (here) {
    return within(patience, name, attack.attack()).finally(() => Server.killOthers(place?.server));
  }
  const { port, operatorPort, pid } = place.server;
  const target = { port, operatorPort, pid, seconds };
  const attacker = new HelperProcess('attacker.mjs', { niceness });
  try {
    const [did, beside] = await Promise.all([
      attacker.call('attack', { name, ...target }, patience),
      attack.meanwhile?.(place.innocents, target),
    ]);
    return { ...did, ...beside };
  } finally {
    await attacker.end();
  }
}

/** The server's cores from now until the function is called. */
function measureCores(pid) {
  const [cpu, since] = [cpuSeconds(pid), now()];
  return () => {
    const end = cpuSeconds(pid);
    return end === null ? null : (end - cpu) / (now() - since);
  };
}

async function observe(attack, place) {
  const { server } = place;
  const coresBefore = measureCores(server.pid);
  await place.readVisitor();
  await pause(kCalmSeconds);
  const calm = await place.readVisitor();
  const row = {
    cores: { before: coresBefore() },
    resident: { before: residentMegabytes(server.pid) },
    descriptors: { before: descriptors(server.pid) },
  };
  const firstLine = server.logged.length;
  const peak = new PeakMeter(server.pid);
  const coresDuring = measureCores(server.pid);
  try {
    row.did = await perform(attack, place);
  } catch (error) {
    row.failure = error.message;
  }
  row.cores.during = coresDuring();
  row.visitor = { ...(await place.readVisitor()), calmFramesPerSecond: calm.framesPerSecond };
  await pause(kAfterSeconds);
  peak.stop();
  row.resident = { ...row.resident, peak: peak.resident, after: residentMegabytes(server.pid) };
  row.descriptors = { ...row.descriptors, peak: peak.descriptors, after: descriptors(server.pid) };
  // Newcomers are welcome, and so are the lines about them.
  row.logged = server.logged.slice(firstLine).filter((line) => !line.includes(kNewcomer));
  return row;
}

async function observeAlone(attack) {
  try {
    return { did: await perform(attack, null), logged: [] };
  } catch (error) {
    return { failure: error.message, logged: [] };
  }
}

/** The row of an attack that could not even begin. */
export function makeFailedRow(attack, failure) {
  return { attack: attack.name, failure, bounds: [is('the attack was carried out', failure)], met: false };
}

/** Carries out the attack; `place` is null if it needs none. */
export async function makeRow(attack, place) {
  const row = place ? await observe(attack, place) : await observeAlone(attack);
  const bounds = row.failure ? [is('the attack was carried out', row.failure)] : attack.bounds(row);
  if (place?.server.end) bounds.push(is('the server runs on', JSON.stringify(place.server.end)));
  const { logged, ...rest } = row;
  const log = { lines: logged.length, first: logged.slice(0, kShownLines) };
  return { attack: attack.name, ...rest, log, bounds, met: bounds.every(({ met }) => met) };
}

import { addressOfVisitor } from '../addresses.mjs';
import { atMost, carriedOut, is, neverStops } from '../bounds.mjs';
import { now, pause } from '../time.mjs';
import { Visitor } from '../visitor.mjs';

/** Honest visitors who come and leave: what each of them takes has to come back. */

const kVisitors = 8;
const kStaySeconds = 3;
/** What a server may keep of its visitors, besides what its cache of views may hold: this share, or so much. */
const kKeptShare = 0.1;
const kKeptMegabytes = 64;
/** Eight share two cores with him. */
const kLongestWait = 3;

const sizeOf = (index) => ({ width: 320 + 160 * index, height: 180 + 90 * ((index * 3) % kVisitors) });

async function stay(port, index, wave) {
  const from = addressOfVisitor(index);
  const visitor = await Visitor.enter({ port, from, name: `Soak ${index}`, ...sizeOf(index) }).catch(() => null);
  if (!visitor) return false;
  await pause(kStaySeconds / 2);
  visitor.resize(sizeOf((index + wave) % kVisitors));
  await pause(kStaySeconds / 2);
  const stayed = visitor.ended === null;
  // Every other one is gone without a word.
  if ((index + wave) % 2 === 0) visitor.leave();
  else visitor.drop();
  return stayed;
}

export const soak = {
  name: `waves of ${kVisitors} visitors come and leave`,
  seconds: 60,
  niceness: 0,
  async attack({ port, seconds, measure }) {
    const did = { waves: 0, visitors: 0, lost: 0, megabytes: [], cached: [], descriptors: [] };
    const end = now() + seconds;
    while (now() < end) {
      const stays = Array.from({ length: kVisitors }, (_, index) => stay(port, index, did.waves));
      const stayed = (await Promise.all(stays)).filter(Boolean).length;
      did.waves += 1;
      did.visitors += stayed;
      did.lost += kVisitors - stayed;
      await pause(2);
      const held = await measure();
      did.megabytes.push(Math.round(held.resident));
      did.cached.push(Math.round(held.cached));
      did.descriptors.push(held.descriptors);
    }
    return did;
  },
  bounds: (row) => {
    const kept = row.did.megabytes.map((megabytes, wave) => megabytes - row.did.cached[wave]);
    const [first, last] = [kept[0], kept.at(-1)];
    const most = Math.max(kKeptMegabytes, kKeptShare * first);
    return [
      carriedOut('waves', row.did.waves, 3),
      is('visitors lost', row.did.lost, 0),
      atMost('memory but the cache after the last wave over after the first', last - first, most, ' MB'),
      is('descriptors after the last wave as after the first', row.did.descriptors.at(-1) - row.did.descriptors[0], 0),
      neverStops(row, kLongestWait),
    ];
  },
};

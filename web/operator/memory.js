import { known } from '../figures.js';

/**
 * The holders of the server's memory, in decimal megabytes, largest first. `rest` is the memory without a holder;
 * `null` if the holders report more than is resident now. `null` if the server does not report its memory.
 */
export function memoryOf(statistics) {
  const resident = known(statistics?.memory?.resident_mb);
  if (resident === null) return null;
  const told = statistics.memory.holders;
  const holders = (Array.isArray(told) ? told : [])
    .filter((holder) => known(holder?.mb) !== null)
    .map(({ holder, type, work, mb }) => {
      return { name: String(holder), type: String(type ?? ''), work: String(work), mb, share: mb / resident };
    })
    .sort((a, b) => b.mb - a.mb || a.name.localeCompare(b.name));
  const sum = holders.reduce((all, holder) => all + holder.mb, 0);
  return { resident, holders, told: sum, rest: sum <= resident ? resident - sum : null };
}

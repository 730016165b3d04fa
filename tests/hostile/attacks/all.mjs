import { doorGroup } from './door.mjs';
import { fewDescriptors } from './few_descriptors.mjs';
import { garbage } from './garbage.mjs';
import { idleGroup } from './idle_sockets.mjs';
import { names } from './names.mjs';
import { paths } from './paths.mjs';
import { pingGroup } from './pings.mjs';
import { rebinding } from './rebinding.mjs';
import { resizes } from './resizes.mjs';
import { sceneAttacks } from './scenes.mjs';
import { signalAttacks } from './signals.mjs';
import { silentGroup } from './silent_visitors.mjs';
import { soak } from './soak.mjs';
import { traceGroups } from './trace.mjs';

/**
 * Every attack. Those of a group have one server, one after the other; `options` are that server's. Those of a
 * group that `startsItsOwn` need none. An attack is
 *
 *   name, seconds         how long it goes on; signals and starts end by themselves
 *   attack(target)        what is done, in a process of its own; gives what was done, in plain data
 *   niceness              of that process, 0 to 19; the attackers' own work must not be what slows the server down
 *   here                  attack() starts servers: it runs in the process that ends them
 *   meanwhile(innocents)  what others do beside it; added to what was done
 *   bounds(row)           what must hold (bounds.mjs)
 */
export const kGroups = [
  ...traceGroups,
  idleGroup,
  doorGroup,
  silentGroup,
  pingGroup,
  { name: 'words', attacks: [rebinding, garbage, resizes, names, paths] },
  { name: 'soak', attacks: [soak] },
  { name: 'scenes', attacks: sceneAttacks },
  { name: 'starts', startsItsOwn: true, attacks: [fewDescriptors, ...signalAttacks] },
];

export const attackNamed = (name) => kGroups.flatMap((group) => group.attacks).find((attack) => attack.name === name);

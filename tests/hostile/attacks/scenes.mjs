import { readFileSync, writeFileSync } from 'node:fs';
import { join } from 'node:path';

import { atMost, is, neverStops } from '../bounds.mjs';
import { temporaryFolder } from '../leftovers.mjs';
import { PeakMeter } from '../readings.mjs';
import { Server } from '../server.mjs';

/** Scene files that are wrong, given to a second server beside the one that serves. */

const kGrove = new URL('../../../server/world/scenes/grove.toml', import.meta.url);
const kSeconds = 5;
const kMegabytes = 1024;

function wrongScene(name, makeText) {
  return {
    name,
    seconds: kSeconds,
    here: true,
    async attack() {
      const file = join(temporaryFolder(), 'scene.toml');
      writeFileSync(file, makeText(readFileSync(kGrove, 'utf8')));
      const server = new Server({ options: ['--scene', file] });
      const meter = new PeakMeter(server.pid);
      const end = await server.endsWithin(kSeconds);
      meter.stop();
      if (!end) await server.stop('SIGKILL');
      const { code = null, seconds = null } = end ?? {};
      return { code, seconds, megabytes: meter.resident, lines: server.logged.length, says: server.logged.at(-1) };
    },
    bounds: (row) => [
      is('exit status', row.did.code, 1),
      atMost('ends after', row.did.seconds, kSeconds, ' s'),
      is('lines', row.did.lines, 1),
      atMost('its memory', row.did.megabytes, kMegabytes, ' MB'),
      neverStops(row),
    ],
  };
}

const zero = (type) => `[[object]]\ntype = "${type}"\nname = "zero"\nposition = [0, 0, 0]\nmodel = "/dev/zero"\n`;

export const sceneAttacks = [
  wrongScene('a truncated scene', (grove) => grove.slice(0, grove.lastIndexOf('position = [') + 12)),
  wrongScene('a light field of model = "/dev/zero"', (grove) => `${grove}\n${zero('lightfield')}`),
  wrongScene('a mesh of model = "/dev/zero"', (grove) => `${grove}\n${zero('mesh')}`),
];

import { connect } from 'node:net';

import { kAttacker, kNewcomer } from '../addresses.mjs';
import { is, atMost } from '../bounds.mjs';
import { cpuSeconds } from '../readings.mjs';
import { Server } from '../server.mjs';
import { becomes, now, pause } from '../time.mjs';
import { Visitor } from '../visitor.mjs';
import { request } from './requests.mjs';

/** A system that gives the server hardly any descriptors. */

const kDescriptors = 24;
const kSockets = 40;
const kSeconds = 5;
const kMostLines = 30;
const kMostLinesOfEnd = 3;

/** Whether it serves: a page, and a visitor; then what it says while more connect than it can have. */
async function crowd(server) {
  const from = kNewcomer;
  const page = await request({ port: server.port, from, path: '/healthz' });
  const visitor = await Visitor.enter({ port: server.port, from, name: '', width: 160, height: 90 }).catch(() => null);
  const [lines, cpu, began] = [server.logged.length, cpuSeconds(server.pid), now()];
  const sockets = Array.from({ length: kSockets }, () => {
    const socket = connect({ host: '127.0.0.1', port: server.port, localAddress: kAttacker });
    return socket.on('error', () => {});
  });
  await pause(kSeconds);
  const did = {
    serves: page.status === 200 && visitor?.ended === null,
    lines: server.logged.length - lines,
    cores: server.end ? null : (cpuSeconds(server.pid) - cpu) / (now() - began),
  };
  for (const socket of sockets) socket.destroy();
  visitor?.drop();
  return did;
}

export const fewDescriptors = {
  name: `ulimit -n ${kDescriptors}`,
  seconds: 2 * kSeconds,
  here: true,
  async attack() {
    const server = new Server({ limits: `-n ${kDescriptors}` });
    await becomes(() => server.port !== null || server.end, 2 * kSeconds);
    const did = { listens: server.port !== null, linesAtStart: server.logged.length };
    if (did.listens) Object.assign(did, await crowd(server));
    did.code = server.end?.code ?? null;
    did.signal = server.end?.signal ?? null;
    did.says = server.logged.at(-1);
    if (!server.end) await server.stop('SIGKILL');
    return did;
  },
  bounds: ({ did }) =>
    did.listens
      ? [is('it serves', did.serves), atMost(`lines in ${kSeconds} s`, did.lines, kMostLines)]
      : [is('exit status', did.code, 1), atMost('lines', did.linesAtStart, kMostLinesOfEnd)],
};

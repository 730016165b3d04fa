import { kAttacker } from '../addresses.mjs';
import { is, neverStops } from '../bounds.mjs';
import { upgradeRequest } from '../websocket.mjs';
import { exchange } from './requests.mjs';

/** A page of another site whose name was made to lead to this server (DNS rebinding). */

const kName = 'rebound.example';
const kReports = ['/statistics.json', '/sharing.json', '/trace.json'];
const kPatience = 1;

const statusOf = ({ text }) => Number(/^HTTP\/1\.[01] (\d{3})/.exec(text)?.[1] ?? 0);

/** What the server says to one who asks for a socket and for reports by this name. */
async function ask({ port, operatorPort }, name) {
  const from = kAttacker;
  const upgrade = upgradeRequest({ host: `${name}:${port}`, origin: `http://${name}:${port}` });
  const socket = statusOf(await exchange({ port, from, bytes: upgrade, patience: kPatience }));
  let reports = 0;
  for (const to of new Set([port, operatorPort])) {
    for (const path of kReports) {
      const host = `Host: ${name}:${to}\r\nOrigin: http://${name}:${to}\r\nConnection: close\r\n\r\n`;
      const bytes = `GET ${path} HTTP/1.1\r\n${host}`;
      const { text } = await exchange({ port: to, from, bytes, patience: kPatience });
      if (/\r\n\r\n[{[]/.test(text)) reports += 1;
    }
  }
  return { socket, reports };
}

export const rebinding = {
  name: `Host and Origin ${kName}`,
  seconds: 18,
  async attack(target) {
    return { rebound: await ask(target, kName), byAddress: await ask(target, '127.0.0.1') };
  },
  bounds: (row) => [
    is('by its address: socket', row.did.byAddress.socket, 101),
    is('by its address: some report', row.did.byAddress.reports > 0),
    is('by another name: socket', row.did.rebound.socket, 403),
    is('by another name: reports', row.did.rebound.reports, 0),
    neverStops(row),
  ],
};

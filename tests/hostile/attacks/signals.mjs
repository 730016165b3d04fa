import { addressOfVisitor } from '../addresses.mjs';
import { atMost, is } from '../bounds.mjs';
import { temporaryFolder } from '../leftovers.mjs';
import { Server } from '../server.mjs';
import { becomes, pause } from '../time.mjs';
import { encodeHello } from '../../../web/stream/client_messages.js';
import { openWebSocket } from '../websocket.mjs';

/** SIGTERM at bad moments. */

const kPreparingSeconds = 2;
const kServingSeconds = 5;
const kTimes = 10;
const kVisitors = 3;

const preparing = {
  name: 'SIGTERM while it prepares the world',
  seconds: 8,
  here: true,
  async attack() {
    const server = new Server({ environment: { GROVE_CACHE: temporaryFolder() } });
    const begun = await becomes(() => server.logged.some((line) => line.includes('preparing')) || server.end, 20);
    await pause(1);
    const wasPreparing = begun && server.port === null && !server.end;
    const seconds = await server.stop('SIGTERM', 2 * kPreparingSeconds);
    return { wasPreparing, seconds, code: server.end.code, signal: server.end.signal, says: server.logged.at(-1) };
  },
  bounds: ({ did }) => [
    is('it was preparing', did.wasPreparing),
    atMost('ends after', did.seconds, kPreparingSeconds, ' s'),
    is('exit status', did.code, 0),
  ],
};

/** The seconds that a server with three visitors takes to end, so long after they said Hello. */
async function stopServing(delay) {
  const server = await Server.listening();
  const come = async (index) => {
    const client = await openWebSocket({ port: server.port, from: addressOfVisitor(index) });
    client.send(encodeHello({ name: '', width: 640, height: 360 }));
    return client;
  };
  const clients = await Promise.all(Array.from({ length: kVisitors }, (_, index) => come(index)));
  await pause(delay);
  const letIn = clients.filter((client) => !client.ended).length;
  const seconds = await server.stop('SIGTERM', 2 * kServingSeconds);
  for (const client of clients) client.drop();
  return { letIn, seconds, code: server.end.code };
}

const serving = {
  name: `SIGTERM with ${kVisitors} visitors, ${kTimes} times`,
  seconds: kTimes * 12,
  here: true,
  async attack() {
    const all = [];
    for (let i = 0; i < kTimes; i += 1) all.push(await stopServing(0.2 + 0.5 * i));
    return {
      ended: all.filter(({ seconds }) => seconds !== null).length,
      longestSeconds: Math.max(...all.map(({ seconds }) => seconds ?? Infinity)),
      seconds: all.map(({ seconds }) => seconds?.toFixed(1) ?? 'never').join(' '),
      visitors: Math.min(...all.map(({ letIn }) => letIn)),
      badEnds: all.filter(({ code }) => code !== 0).length,
    };
  },
  bounds: ({ did }) => [
    is('visitors', did.visitors, kVisitors),
    is('times that it ended', did.ended, kTimes),
    atMost('the longest took', did.longestSeconds, kServingSeconds, ' s'),
    is('ends with another status than 0', did.badEnds, 0),
  ],
};

export const signalAttacks = [preparing, serving];

import { encodeAck, encodeHello } from '../../../web/stream/client_messages.js';
import { kAttacker } from '../addresses.mjs';
import { atMost, carriedOut, neverStops } from '../bounds.mjs';
import { portsHeldByServer } from '../readings.mjs';
import { becomes, now } from '../time.mjs';
import { openWebSocket } from '../websocket.mjs';

/** Visitors that keep a place and look at nothing. */

const kVisitors = 16;
const kAckSeconds = 10;
const kMostSeconds = 30;

/** One of them: his port, and when he came; null if he was not let in. */
async function come(port, frame) {
  const client = await openWebSocket({ port, from: kAttacker }).catch(() => null);
  if (!client) return null;
  const came = { port: client.socket.localPort, at: now() };
  client.socket.pause();
  client.send(encodeHello({ name: 'Deaf', width: 1280, height: 720 }));
  const timer = setInterval(() => client.send(encodeAck({ frame })), kAckSeconds * 1000);
  client.socket.on('close', () => clearInterval(timer));
  return came;
}

const deaf = {
  name: '16 visitors who never read, Ack 0 or 2^32-1',
  seconds: kMostSeconds + 3,
  async attack({ port, seconds }) {
    const frames = Array.from({ length: kVisitors }, (_, index) => (index % 2 === 0 ? 0 : 0xffffffff));
    const all = await Promise.all(frames.map((frame) => come(port, frame)));
    const letIn = all.filter(Boolean);
    const closedAfter = new Map();
    // He does not read, so only the kernel knows whether the server has hung up.
    await becomes(() => {
      const held = portsHeldByServer(port);
      for (const one of letIn) {
        if (!held.has(one.port) && !closedAfter.has(one)) closedAfter.set(one, now() - one.at);
      }
      return closedAfter.size === letIn.length;
    }, seconds - 1);
    const after = [...closedAfter.values()];
    return { upgraded: letIn.length, held: letIn.length - after.length, lastClosedAfterSeconds: Math.max(0, ...after) };
  },
  bounds: (row) => [
    carriedOut('websockets', row.did.upgraded),
    atMost('still held in the end', row.did.held, 0),
    atMost('the last is closed after', row.did.lastClosedAfterSeconds, kMostSeconds, ' s'),
    neverStops(row),
  ],
};

/** There is a place for each of them. */
export const silentGroup = { name: 'silent-visitors', options: ['--max-visitors', '24'], attacks: [deaf] };

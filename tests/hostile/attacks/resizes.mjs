import { encodeHello, encodeResize } from '../../../web/stream/client_messages.js';
import { kAttacker } from '../addresses.mjs';
import { atLeast, atMost, carriedOut, neverStops } from '../bounds.mjs';
import { now, pause, repeat } from '../time.mjs';
import { encodeFrame, openWebSocket } from '../websocket.mjs';

/** Frames of another size every time: for the server, memory that is taken and given back. */

const kMegabytes = 64;
const kSizes = [[160, 90], [640, 360], [1280, 720], [333, 777]];

/** Resizes until it is closed, at most so many in a second; how many were sent. */
async function resize(client, perSecond, end) {
  let sent = 0;
  while (!client.ended && now() < end) {
    const batch = Array.from({ length: Math.max(1, Math.round(perSecond / 20)) }, () => {
      const [width, height] = kSizes[sent++ % kSizes.length];
      return encodeFrame(encodeResize({ width, height }));
    });
    client.socket.write(Buffer.concat(batch));
    await pause(0.05);
  }
  return sent;
}

export const resizes = {
  name: 'resizes as fast as possible, and as allowed',
  seconds: 8,
  async attack({ port, seconds }) {
    const did = { fast: 0, allowed: 0, closed: 0, refused: 0 };
    const end = now() + seconds;
    const send = async (kind, perSecond) => {
      const client = await openWebSocket({ port, from: kAttacker }).catch(() => null);
      if (!client) {
        did.refused += 1;
        return pause(0.5);
      }
      client.onEnd = () => (did.closed += 1);
      client.send(encodeHello({ name: 'Mallory', width: 160, height: 90 }));
      did[kind] += await resize(client, perSecond, end);
      client.drop();
    };
    await Promise.all([repeat(seconds, () => send('fast', 100_000)), repeat(seconds, () => send('allowed', 400))]);
    return did;
  },
  bounds: (row) => [
    carriedOut('resizes', row.did.fast + row.did.allowed, 500),
    atLeast('times that one was closed', row.did.closed, 1),
    atMost('memory over before', row.resident.peak - row.resident.before, kMegabytes, ' MB'),
    neverStops(row),
  ],
};

import { randomBytes } from 'node:crypto';

import { encodeHello, encodeInput, encodeResize } from '../../../web/stream/client_messages.js';
import { kAttacker } from '../addresses.mjs';
import { carriedOut, is, keepsHisRate, neverStops } from '../bounds.mjs';
import { becomes, now } from '../time.mjs';
import { Opcode, encodeFrame, openWebSocket } from '../websocket.mjs';
import { exchange } from './requests.mjs';

/** Websockets that say what no page says. */

const kPatience = 5;
const hello = () => encodeFrame(encodeHello({ name: 'Mallory', width: 160, height: 90 }));
const input = (yaw) => encodeFrame(encodeInput({ number: 1, keys: 0, yaw, pitch: 0 }));
const piece = (bytes, opcode, final = false) => encodeFrame(bytes, { opcode, final });
const { binary, continuation, text, ping } = Opcode;

/** What is sent after the upgrade, by name; the server has to hang up upon each. */
const kBadTalk = {
  'random bytes': () => randomBytes(4096),
  'unknown message': () => encodeFrame([0xde, 0xad, 0xbe, 0xef]),
  'empty message': () => encodeFrame([]),
  'half a Hello': () => encodeFrame(new Uint8Array(encodeHello({ name: 'x', width: 9, height: 9 })).subarray(0, 7)),
  'text': () => encodeFrame('hello', { opcode: text }),
  '257 bytes': () => encodeFrame(randomBytes(257)),
  '60 KB': () => encodeFrame(Buffer.alloc(60_000, 2)),
  '2^62 bytes announced': () =>
    Buffer.concat([Buffer.from([0x82, 0xff, 0x40, 0, 0, 0, 0, 0, 0, 0]), randomBytes(1000)]),
  'fragments without end': () =>
    Buffer.concat([piece([2], binary), ...Array.from({ length: 1000 }, () => piece([2], continuation))]),
  'empty fragments': () =>
    Buffer.concat([piece([], binary), ...Array.from({ length: 1000 }, () => piece([], continuation))]),
  'the end of nothing': () => piece([1, 2], continuation, true),
  'a ping of 200 bytes': () => encodeFrame(Buffer.alloc(200), { opcode: ping }),
  'an unmasked frame': () => Buffer.from([0x82, 0x02, 0x01, 0x01]),
  'two Hellos': () => Buffer.concat([hello(), hello()]),
  'a yaw that is no number': () => Buffer.concat([hello(), input(Number.NaN)]),
  'a size of nothing': () => Buffer.concat([hello(), encodeFrame(encodeResize({ width: 0, height: 0 }))]),
};

/** Says one thing; whether the server hung up, or null if it did not let the client in. */
async function say(port, bytes) {
  const client = await openWebSocket({ port, from: kAttacker }).catch(() => null);
  if (!client) return null;
  client.socket.write(bytes);
  const hungUp = await becomes(() => client.ended, kPatience);
  client.drop();
  return hungUp;
}

export const garbage = {
  name: 'garbage, oversized messages, fragments',
  seconds: 8,
  async attack({ port, seconds }) {
    const did = { said: 0, refused: 0, hungUp: 0, rawSockets: 0, keptOpenAfter: [] };
    const end = now() + seconds;
    while (now() < end) {
      for (const [name, bytes] of Object.entries(kBadTalk)) {
        if (now() > end) break;
        const hungUp = await say(port, bytes());
        if (hungUp === null) did.refused += 1;
        else did.said += 1;
        if (hungUp) did.hungUp += 1;
        if (hungUp === false && !did.keptOpenAfter.includes(name)) did.keptOpenAfter.push(name);
      }
      await exchange({ port, from: kAttacker, bytes: randomBytes(2000), patience: 0.2 });
      did.rawSockets += 1;
    }
    return did;
  },
  bounds: (row) => [
    carriedOut('things said', row.did.said, Object.keys(kBadTalk).length),
    is('kept open after', row.did.keptOpenAfter.join(', '), ''),
    keepsHisRate(row),
    neverStops(row),
  ],
};

import { encodeHello } from '../../../web/stream/client_messages.js';
import { kAttacker } from '../addresses.mjs';
import { atLeast, atMost, carriedOut, keepsHisRate, neverStops } from '../bounds.mjs';
import { bytesUnread } from '../readings.mjs';
import { now, pause } from '../time.mjs';
import { Opcode, encodeFrame, openWebSocket } from '../websocket.mjs';

/** Pings as fast as one socket can. The server has to answer each, says the websocket's standard. */

const kMostCores = 0.1;
const kPingsAtOnce = 4096;
const kPing = encodeFrame([], { opcode: Opcode.ping });
const kBatch = Buffer.alloc(kPing.length * kPingsAtOnce, kPing);
/** Until a pinger who was sent away comes back. */
const kAwaySeconds = 1;

/** Resolves when the socket takes more, or is closed, or has taken nothing for half a second. */
function untilDrained(socket) {
  return new Promise((resolve) => {
    const done = () => {
      clearTimeout(timer);
      socket.off('drain', done).off('close', done);
      resolve();
    };
    const timer = setTimeout(done, 500);
    socket.on('drain', done).on('close', done);
  });
}

/** Pings until it is closed or the time is over; adds to what was done. */
async function ping(client, serverPort, end, did) {
  const { socket } = client;
  const fromPort = socket.localPort;
  client.onMessage = (opcode) => (did.pongs += opcode === Opcode.pong ? 1 : 0);
  client.onEnd = (code, reason) => {
    did.closed += 1;
    did.closeReason = `${code} ${reason}`;
  };
  const before = socket.bytesWritten - socket.writableLength;
  while (!client.ended && now() < end) {
    // Nothing drains if the kernel took it all at once.
    if (!socket.writableNeedDrain && socket.write(kBatch)) await new Promise(setImmediate);
    else await untilDrained(socket);
  }
  const written = socket.bytesWritten - socket.writableLength - before;
  did.pings += Math.floor(written / kPing.length);
  did.unread += Math.floor(bytesUnread(fromPort, serverPort) / kPing.length);
  client.onEnd = () => {};
  client.drop();
}

function pinger(name, greet) {
  return {
    name,
    seconds: 6,
    async attack({ port, seconds }) {
      const did = { sockets: 0, refused: 0, pings: 0, unread: 0, pongs: 0, closed: 0, closeReason: '' };
      const end = now() + seconds;
      while (now() < end) {
        const client = await openWebSocket({ port, from: kAttacker }).catch(() => null);
        if (client) {
          did.sockets += 1;
          greet(client);
          await ping(client, port, end, did);
        } else {
          did.refused += 1;
        }
        await pause(Math.min(kAwaySeconds, Math.max(0, end - now())));
      }
      return did;
    },
    bounds: (row) => [
      carriedOut('pings', row.did.pings, kPingsAtOnce / 2),
      atMost("rise of the server's CPU", row.cores.during - row.cores.before, kMostCores, ' cores'),
      atLeast('times that the pinger was closed', row.did.closed, 1),
      keepsHisRate(row),
      neverStops(row),
    ],
  };
}

export const pingGroup = {
  name: 'pings',
  attacks: [
    pinger('pings as fast as one socket can', () => {}),
    pinger('the same of a visitor', (client) => client.send(encodeHello({ name: 'Ping', width: 160, height: 90 }))),
  ],
};

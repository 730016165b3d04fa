import { connect } from 'node:net';

import { encodeHello, encodeLimits } from '../../../web/stream/client_messages.js';
import { kAttacker, kNewcomer } from '../addresses.mjs';
import { atLeast, atMost, carriedOut, is, keepsHisRate, neverStops } from '../bounds.mjs';
import { now, pause } from '../time.mjs';
import { Visitor } from '../visitor.mjs';
import { openWebSocket } from '../websocket.mjs';

/** Lockouts: what takes every place that a newcomer needs. */

const kNewcomers = 10;
const kSockets = 1000;
const kAddresses = 40;
const kDribbleSeconds = 1;

async function withNewcomers(innocents, { port }) {
  await pause(2);
  const { entered, failures } = await innocents.call('newcomers', { port, count: kNewcomers }, 30);
  return { newcomers: entered, failures: [...new Set(failures)].join('; ') || undefined };
}

const silent = {
  name: '1,000 silent or slow sockets of 40 addresses',
  seconds: 18,
  niceness: 19,
  async attack({ port, seconds }) {
    let [tried, ended] = [0, false];
    const take = (index) => {
      if (ended) return;
      tried += 1;
      const socket = connect({ host: '127.0.0.1', port, localAddress: `127.0.4.${(index % kAddresses) + 1}` });
      let timer;
      socket.on('connect', () => {
        if (index % 2 === 0) return;
        // A byte at a time, as slowloris does.
        socket.write(`GET / HTTP/1.1\r\nHost: 127.0.0.1:${port}\r\nX-`);
        timer = setInterval(() => socket.write('a'), kDribbleSeconds * 1000);
      });
      socket.on('data', () => {});
      socket.on('error', () => {});
      socket.on('close', () => {
        clearInterval(timer);
        setTimeout(() => take(index), 100);
      });
    };
    for (let index = 0; index < kSockets; index += 1) take(index);
    await pause(seconds);
    ended = true;
    return { tried };
  },
  meanwhile: withNewcomers,
  bounds: (row) => [
    carriedOut('sockets', row.did.tried, kSockets),
    is(`newcomers of ${kNewcomers} that enter within 5 s`, row.did.newcomers, kNewcomers),
    neverStops(row),
  ],
};

const kHidden = 16;
/** Knocks as web/stream/connection.js does at a full world. */
const kKnockSeconds = 15;
const kMostSeconds = 30;

async function comeHidden(port, index) {
  const from = `127.0.5.${(index % 4) + 1}`;
  const client = await openWebSocket({ port, from, protocol: 'grove.v1.2' }).catch(() => null);
  client?.send(encodeHello({ name: 'Hidden', width: 320, height: 180 }));
  const limits = { hidden: true, border: false, framesPerSecond: 0, kilobitsPerSecond: 0, lines: 0 };
  client?.send(encodeLimits(limits));
  return client;
}

const hidden = {
  name: '16 hidden visitors',
  seconds: kMostSeconds + 6,
  async attack({ port }) {
    const clients = await Promise.all(Array.from({ length: kHidden }, (_, index) => comeHidden(port, index)));
    const began = now();
    await pause(1);
    const answers = [];
    let enteredAfterSeconds = null;
    while (enteredAfterSeconds === null && now() - began <= kMostSeconds) {
      try {
        const at = { port, from: kNewcomer, name: '', width: 160, height: 90, patience: 5 };
        (await Visitor.enter(at)).leave();
        enteredAfterSeconds = now() - began;
      } catch (error) {
        answers.push(error.message);
        await pause(kKnockSeconds);
      }
    }
    return { hidden: clients.filter(Boolean).length, knocks: answers.length + 1, enteredAfterSeconds };
  },
  bounds: (row) => [
    carriedOut('hidden visitors', row.did.hidden, kHidden),
    atLeast('knocks until one is let in', row.did.knocks, 2),
    atMost('a newcomer is in after', row.did.enteredAfterSeconds, kMostSeconds, ' s'),
    neverStops(row),
  ],
};

const kJoinsPerSecond = 8;
const kKeptShare = 0.9;

const joins = {
  name: `${kJoinsPerSecond} visitors a second who join and leave at once`,
  seconds: 15,
  async attack({ port, seconds }) {
    let joined = 0;
    const end = now() + seconds;
    while (now() < end) {
      openWebSocket({ port, from: kAttacker })
        .then((client) => {
          client.onMessage = () => {
            client.onMessage = () => {};
            joined += 1;
            client.drop();
          };
          client.send(encodeHello({ name: 'Passing', width: 1280, height: 720 }));
        })
        .catch(() => {});
      await pause(1 / kJoinsPerSecond);
    }
    return { joined };
  },
  bounds: (row) => [
    carriedOut('joins', row.did.joined, 60),
    // Two seconds more than the attack are logged.
    atMost('log lines', row.logged.length, joins.seconds + 3),
    keepsHisRate(row, kKeptShare),
    neverStops(row),
  ],
};

export const doorGroup = { name: 'door', attacks: [silent, hidden, joins] };

import { connect } from 'node:net';

import { kAttacker } from '../addresses.mjs';
import { atMost, carriedOut, is, keepsHisRate, neverStops } from '../bounds.mjs';
import { pause } from '../time.mjs';

/** Sockets that only take places, of one address. */

const kSockets = 300;
const kNewcomers = 10;
const kMaxLogLines = 30;
/** 60 us of the kernel's time for each that is accepted and closed: a seventh of a core at 2,600 a second. */
const kKeptShare = 0.85;

const idle = {
  name: '300 idle and half-open sockets of one address',
  seconds: 15,
  // His own side of so many connections takes twice that; from elsewhere it would not.
  niceness: 19,
  async attack({ port, seconds }) {
    let [tried, opened, answeredOrClosed, ended] = [0, 0, 0, false];
    const take = (index) => {
      if (ended) return;
      tried += 1;
      const socket = connect({ host: '127.0.0.1', port, localAddress: kAttacker });
      socket.on('connect', () => {
        opened += 1;
        // Every other one asks for something and never ends.
        if (index % 2 === 1) socket.write(`GET / HTTP/1.1\r\nHost: 127.0.0.1:${port}\r\nX-`);
      });
      socket.on('data', () => {});
      socket.on('error', () => {});
      socket.on('close', () => {
        answeredOrClosed += 1;
        setImmediate(() => take(index));
      });
    };
    for (let index = 0; index < kSockets; index += 1) take(index);
    await pause(seconds);
    ended = true;
    return { tried, opened, closedByServer: answeredOrClosed };
  },
  async meanwhile(innocents, { port }) {
    await pause(2);
    const { entered, failures } = await innocents.call('newcomers', { port, count: kNewcomers }, 30);
    return { newcomers: entered, failures: [...new Set(failures)].join('; ') || undefined };
  },
  bounds: (row) => [
    carriedOut('sockets', row.did.tried, kSockets),
    is(`newcomers of ${kNewcomers} that enter`, row.did.newcomers, kNewcomers),
    atMost('log lines', row.logged.length, kMaxLogLines),
    keepsHisRate(row, kKeptShare),
    neverStops(row),
  ],
};

export const idleGroup = { name: 'idle-sockets', attacks: [idle] };

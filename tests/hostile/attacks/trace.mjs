import { Agent } from 'node:http';
import { connect } from 'node:net';

import { kAttacker } from '../addresses.mjs';
import { atMost, carriedOut, keepsHisRate, neverStops } from '../bounds.mjs';
import { pause, repeat } from '../time.mjs';
import { Answers, exchange, request } from './requests.mjs';

/** The trace is the largest and most expensive answer that the server has. */

const kPath = '/trace.json';
/** So much may a trace that 240 read take, and what each of them holds beside. */
const kTraceMegabytes = 32;
const kBytesASecond = 2048;

const from = kAttacker;
const bounds = (row) => [carriedOut('requests', row.did.requests, 10), keepsHisRate(row), neverStops(row)];

const loops = {
  name: '8 loops of HEAD and GET of the trace',
  seconds: 6,
  async attack({ operatorPort: port, seconds }) {
    const answers = new Answers();
    const loop = async () => {
      const agent = new Agent({ keepAlive: true, maxSockets: 1 });
      await repeat(seconds, async () => {
        for (const method of ['HEAD', 'GET']) answers.add(await request({ port, from, path: kPath, method, agent }));
      });
      agent.destroy();
    };
    await Promise.all(Array.from({ length: 8 }, loop));
    return answers.report();
  },
  bounds,
};

const burst = {
  name: '100 GETs of the trace at once',
  seconds: 6,
  async attack({ operatorPort: port, seconds }) {
    const answers = new Answers();
    const get = async () => answers.add(await request({ port, from, path: kPath }));
    await repeat(seconds, () => Promise.all(Array.from({ length: 100 }, get)));
    return answers.report();
  },
  bounds,
};

const pipelined = {
  name: '10 sockets of 100 HEADs of the trace each',
  seconds: 6,
  async attack({ operatorPort: port, seconds }) {
    const head = `HEAD ${kPath} HTTP/1.1\r\nHost: 127.0.0.1:${port}\r\n`;
    const bytes = `${`${head}\r\n`.repeat(99)}${head}Connection: close\r\n\r\n`;
    let [sent, answered] = [0, 0];
    const send = async () => {
      sent += 100;
      const { text } = await exchange({ port, from, bytes, patience: seconds });
      answered += text.split('HTTP/1.1 200').length - 1;
    };
    await repeat(seconds, () => Promise.all(Array.from({ length: 10 }, send)));
    return { requests: sent, answered };
  },
  bounds,
};

const slowReaders = {
  name: '240 slow readers of the trace',
  seconds: 12,
  async attack({ operatorPort: port, seconds }) {
    let [open, reading, bytes] = [0, 0, 0];
    const sockets = Array.from({ length: 240 }, () => {
      const socket = connect({ host: '127.0.0.1', port, localAddress: from });
      socket.on('connect', () => {
        open += 1;
        socket.write(`GET ${kPath} HTTP/1.1\r\nHost: 127.0.0.1:${port}\r\n\r\n`);
      });
      // Whoever listens for this reads by himself.
      socket.on('readable', () => {});
      socket.on('error', () => {});
      return socket;
    });
    // A little each second, so that they are slow and not silent.
    for (let second = 0; second < seconds; second += 1) {
      await pause(1);
      for (const socket of sockets) {
        const piece = socket.read(kBytesASecond);
        bytes += piece?.length ?? 0;
        if (piece?.toString('latin1', 0, 12) === 'HTTP/1.1 200') reading += 1;
      }
    }
    const still = sockets.filter((socket) => !socket.destroyed).length;
    return { sockets: open, reading, stillOpen: still, megabytesRead: bytes / 2 ** 20 };
  },
  bounds: (row) => [
    carriedOut('readers', row.did.reading),
    atMost('memory over before', row.resident.peak - row.resident.before, kTraceMegabytes, ' MB'),
    keepsHisRate(row),
    neverStops(row),
  ],
};

/** Slow readers have a server of their own: what earlier answers left allocated would hide what they take. */
export const traceGroups = [
  { name: 'trace', attacks: [loops, burst, pipelined] },
  { name: 'slow-readers', attacks: [slowReaders] },
];

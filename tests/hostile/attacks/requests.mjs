import { connect } from 'node:net';
import http from 'node:http';

/** HTTP as an attacker speaks it. */

const kPatience = 8_000;

/** Status and length of an answer; the status is an error's code if there is none. Never fails. */
export function request({ port, from, path, method = 'GET', headers = {}, agent = false }) {
  return new Promise((resolve) => {
    const options = { host: '127.0.0.1', port, path, method, headers, agent, localAddress: from, timeout: kPatience };
    const asked = http.request(options, (answer) => {
      let bytes = 0;
      answer.on('data', (chunk) => (bytes += chunk.length));
      answer.on('close', () => resolve({ status: answer.complete ? answer.statusCode : 'cut', bytes }));
      answer.on('error', () => {});
    });
    asked.on('timeout', () => asked.destroy(Object.assign(new Error('no answer'), { code: 'silence' })));
    asked.on('error', (error) => resolve({ status: error.code ?? error.message, bytes: 0 }));
    asked.end();
  });
}

/** Counts answers by what they were. */
export class Answers {
  byStatus = {};
  bytes = 0;

  add({ status, bytes }) {
    this.byStatus[status] = (this.byStatus[status] ?? 0) + 1;
    this.bytes += bytes;
  }

  report() {
    const total = Object.values(this.byStatus).reduce((sum, count) => sum + count, 0);
    return { requests: total, answers: this.byStatus, megabytes: this.bytes / 2 ** 20 };
  }
}

/** Everything that comes back for these bytes until the server hangs up or `patience` is over. Never fails. */
export function exchange({ port, from, bytes, patience = 3 }) {
  return new Promise((resolve) => {
    const socket = connect({ host: '127.0.0.1', port, localAddress: from });
    const chunks = [];
    let hungUp = true;
    const timer = setTimeout(() => {
      hungUp = false;
      socket.destroy();
    }, patience * 1000);
    socket.on('connect', () => socket.write(bytes));
    socket.on('data', (chunk) => chunks.push(chunk));
    socket.on('error', () => {});
    socket.on('close', () => {
      clearTimeout(timer);
      resolve({ text: Buffer.concat(chunks).toString('latin1'), hungUp });
    });
  });
}

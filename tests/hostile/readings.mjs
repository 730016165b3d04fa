import { readFileSync, readdirSync } from 'node:fs';

/** What Linux tells about a process, null once the process is gone, and what a server tells about itself. */

const kTicksPerSecond = 100;
const kPageBytes = 4096;

function orNull(read) {
  try {
    return read();
  } catch {
    return null;
  }
}

/** CPU time, of all its threads. */
export function cpuSeconds(pid) {
  return orNull(() => {
    const fields = readFileSync(`/proc/${pid}/stat`, 'latin1').split(') ').at(-1).split(' ');
    return (Number(fields[11]) + Number(fields[12])) / kTicksPerSecond;
  });
}

export function residentMegabytes(pid) {
  return orNull(() => {
    const pages = Number(readFileSync(`/proc/${pid}/statm`, 'latin1').split(' ')[1]);
    return (pages * kPageBytes) / 2 ** 20;
  });
}

/** What a server holds of shared views: a cache that fills up to its own limit, `--view-cache`. */
export async function cachedMegabytes(operatorPort) {
  const { memory } = await (await fetch(`http://127.0.0.1:${operatorPort}/statistics.json`)).json();
  const caches = memory.holders.filter(({ holder }) => holder === 'shared views');
  return caches.reduce((sum, { mb }) => sum + (mb * 1e6) / 2 ** 20, 0);
}

export function descriptors(pid) {
  return orNull(() => readdirSync(`/proc/${pid}/fd`).length);
}

/** The most that a process held between start() and stop(). */
export class PeakMeter {
  #pid;
  #timer;
  resident = 0;
  descriptors = 0;

  constructor(pid) {
    this.#pid = pid;
    this.#timer = setInterval(() => this.#sample(), 100);
    this.#sample();
  }

  #sample() {
    this.resident = Math.max(this.resident, residentMegabytes(this.#pid) ?? 0);
    this.descriptors = Math.max(this.descriptors, descriptors(this.#pid) ?? 0);
  }

  stop() {
    clearInterval(this.#timer);
    this.#sample();
    return this;
  }
}

/** Bytes on their way from this port of 127.0.0.x that the server has not read. */
export function bytesUnread(fromPort, serverPort) {
  const portOf = (address) => Number.parseInt(address.split(':')[1], 16);
  let unread = 0;
  for (const line of readFileSync('/proc/net/tcp', 'latin1').trim().split('\n').slice(1)) {
    const [, local, remote, , queues] = line.trim().split(/\s+/);
    const [sending, received] = queues.split(':').map((bytes) => Number.parseInt(bytes, 16));
    if (portOf(local) === fromPort && portOf(remote) === serverPort) unread += sending;
    if (portOf(local) === serverPort && portOf(remote) === fromPort) unread += received;
  }
  return unread;
}

/** The ports on 127.0.0.x whose connections to this port of the server the server has not closed. */
export function portsHeldByServer(serverPort) {
  const [kEstablished, kCloseWait] = ['01', '08'];
  const held = new Set();
  for (const line of readFileSync('/proc/net/tcp', 'latin1').trim().split('\n').slice(1)) {
    const [, local, remote, state] = line.trim().split(/\s+/);
    if (Number.parseInt(local.split(':')[1], 16) !== serverPort) continue;
    if (state === kEstablished || state === kCloseWait) held.add(Number.parseInt(remote.split(':')[1], 16));
  }
  return held;
}

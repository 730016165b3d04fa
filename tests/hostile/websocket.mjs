import { connect } from 'node:net';

/**
 * A websocket client on a raw socket, for what a well-behaved library does not do: other source addresses, frames that
 * break the rules, and not reading.
 */

export const Opcode = Object.freeze({ continuation: 0, text: 1, binary: 2, close: 8, ping: 9, pong: 10 });

const kPatience = 10_000;
const kMask = [0x12, 0x34, 0x56, 0x78];

/** A frame as a client sends it. */
export function encodeFrame(payload, { opcode = Opcode.binary, final = true } = {}) {
  const bytes = Buffer.from(payload);
  const head = [opcode | (final ? 0x80 : 0)];
  if (bytes.length < 126) {
    head.push(0x80 | bytes.length);
  } else if (bytes.length < 65536) {
    head.push(0x80 | 126, bytes.length >> 8, bytes.length & 255);
  } else {
    head.push(0x80 | 127, 0, 0, 0, 0, ...[24, 16, 8, 0].map((shift) => (bytes.length >>> shift) & 255));
  }
  return Buffer.concat([Buffer.from([...head, ...kMask]), bytes.map((byte, i) => byte ^ kMask[i % 4])]);
}

/** The request for a socket of the server. */
export function upgradeRequest({ host, origin, protocol = 'grove.v1' }) {
  const lines = [
    'GET / HTTP/1.1',
    `Host: ${host}`,
    'Upgrade: websocket',
    'Connection: Upgrade',
    'Sec-WebSocket-Key: dGhlIHNhbXBsZSBub25jZQ==',
    'Sec-WebSocket-Version: 13',
    `Sec-WebSocket-Protocol: ${protocol}`,
  ];
  if (origin) lines.push(`Origin: ${origin}`);
  return `${lines.join('\r\n')}\r\n\r\n`;
}

/** One socket that was let in. Calls `onMessage(opcode, bytes)` for each frame, and `onEnd(code, reason)` once. */
export class WebSocketClient {
  #rest;
  #ended = false;
  onMessage = () => {};
  onEnd = () => {};

  constructor(socket, rest) {
    this.socket = socket;
    this.#rest = rest;
    socket.on('data', (chunk) => this.#receive(chunk));
    socket.on('close', () => this.#end(0, 'the connection was lost'));
  }

  get ended() {
    return this.#ended;
  }

  /** False: what waits to be sent is more than the socket takes at once. */
  send(payload, options) {
    return this.socket.writable && this.socket.write(encodeFrame(payload, options));
  }

  /** Leaves as a browser does. */
  close() {
    this.send([1000 >> 8, 1000 & 255], { opcode: Opcode.close });
    this.socket.end();
  }

  drop() {
    this.socket.resetAndDestroy();
  }

  #receive(chunk) {
    this.#rest = this.#rest.length > 0 ? Buffer.concat([this.#rest, chunk]) : chunk;
    while (true) {
      const bytes = this.#rest;
      if (bytes.length < 2) return;
      const short = bytes[1] & 127;
      const head = short < 126 ? 2 : short === 126 ? 4 : 10;
      if (bytes.length < head) return;
      const length = short < 126 ? short : short === 126 ? bytes.readUInt16BE(2) : Number(bytes.readBigUInt64BE(2));
      if (bytes.length < head + length) return;
      this.#rest = bytes.subarray(head + length);
      this.#take(bytes[0] & 15, bytes.subarray(head, head + length));
    }
  }

  #take(opcode, payload) {
    if (opcode !== Opcode.close) {
      this.onMessage(opcode, payload);
      return;
    }
    this.#end(payload.length < 2 ? 1005 : payload.readUInt16BE(0), payload.subarray(2).toString());
    if (this.socket.writable) this.socket.end(encodeFrame(payload, { opcode: Opcode.close }));
  }

  #end(code, reason) {
    if (this.#ended) return;
    this.#ended = true;
    this.onEnd(code, reason);
  }
}

/** A client once it is let in; fails with the HTTP status if it is not. `from` is the address to come from. */
export function openWebSocket({ port, from, host = `127.0.0.1:${port}`, origin, protocol }) {
  return new Promise((resolve, reject) => {
    const socket = connect({ host: '127.0.0.1', port, localAddress: from });
    socket.setNoDelay(true);
    let answer = Buffer.alloc(0);
    const fail = (why) => {
      socket.destroy();
      reject(new Error(why));
    };
    const timer = setTimeout(() => fail('no answer'), kPatience);
    const onData = (chunk) => {
      answer = Buffer.concat([answer, chunk]);
      const end = answer.indexOf('\r\n\r\n');
      if (end < 0) return;
      clearTimeout(timer);
      const status = answer.toString('latin1', 9, 12);
      if (status !== '101') return fail(`HTTP ${status}`);
      socket.off('data', onData).off('close', onClose);
      resolve(new WebSocketClient(socket, answer.subarray(end + 4)));
    };
    const onClose = () => {
      clearTimeout(timer);
      fail('closed');
    };
    // Stays: who is let in still has to survive a reset.
    socket.on('error', () => {});
    socket.on('connect', () => socket.write(upgradeRequest({ host, origin, protocol })));
    socket.on('data', onData);
    socket.on('close', onClose);
  });
}

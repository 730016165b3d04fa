import { encodeAck, encodeHello, encodeInput, encodeResize } from '../../web/stream/client_messages.js';
import { decodeServerMessage } from '../../web/stream/server_messages.js';
import { now, within } from './time.mjs';
import { Opcode, openWebSocket } from './websocket.mjs';

const kInputSeconds = 0.03;

/** The value that this share of the values does not exceed; null if there are none. */
function percentile(values, share) {
  const sorted = [...values].sort((a, b) => a - b);
  return sorted[Math.max(0, Math.ceil(share * sorted.length) - 1)] ?? null;
}

/**
 * One who behaves as the page does: stands, looks slowly around, acknowledges every frame. Counts what he sees, and how
 * long it takes from an input to the first frame that shows it.
 */
export class Visitor {
  #client;
  #timer;
  #welcome = null;
  #lastInput = 0;
  #unseen = [];
  #counted;
  #onArrival = { resolve: () => {}, reject: () => {} };
  ended = null;

  constructor(client) {
    this.#client = client;
    client.onMessage = (opcode, bytes) => opcode === Opcode.binary && this.#receive(bytes);
    client.onEnd = (code, reason) => this.#end(`${code} ${reason}`);
    this.#count();
  }

  /** Resolves when the first frame is there; fails after `patience` seconds. */
  static async enter({ port, from, name, width, height, patience = 20 }) {
    const visitor = new Visitor(await openWebSocket({ port, from }));
    const arrival = new Promise((resolve, reject) => (visitor.#onArrival = { resolve, reject }));
    visitor.#client.send(encodeHello({ name, width, height }));
    try {
      await within(patience, 'the first frame', arrival);
    } catch (error) {
      visitor.drop();
      throw error;
    }
    return visitor;
  }

  resize(size) {
    this.#client.send(encodeResize(size));
  }

  /** What he saw since he entered, or since the last reading. */
  read() {
    const { since, frames, bytes, latencies, longestGap, lastFrame } = this.#counted;
    const seconds = now() - since;
    this.#count();
    return {
      framesPerSecond: frames / seconds,
      megabitsPerSecond: (bytes * 8) / seconds / 1e6,
      p99Milliseconds: percentile(latencies, 0.99),
      longestGapSeconds: Math.max(longestGap, now() - lastFrame),
      ended: this.ended,
    };
  }

  leave() {
    this.#end('left');
    this.#client.close();
  }

  drop() {
    this.#end('dropped');
    this.#client.drop();
  }

  #count() {
    this.#counted = { since: now(), frames: 0, bytes: 0, latencies: [], longestGap: 0, lastFrame: now() };
  }

  #receive(bytes) {
    const message = decodeServerMessage(bytes.buffer.slice(bytes.byteOffset, bytes.byteOffset + bytes.length));
    if (message.message === 'Frame') this.#see(message);
    else this.#begin(message);
  }

  #begin(welcome) {
    this.#welcome = welcome;
    this.#timer = setInterval(() => this.#steer(), kInputSeconds * 1000);
  }

  #steer() {
    const number = ++this.#lastInput;
    this.#unseen.push({ number, at: now() });
    const { yaw, pitch } = this.#welcome;
    this.#client.send(encodeInput({ number, keys: 0, yaw: yaw + 0.3 * Math.sin(now()), pitch }));
  }

  #see({ frame, lastInput, picture }) {
    const at = now();
    this.#client.send(encodeAck({ frame }));
    const counted = this.#counted;
    counted.frames += 1;
    counted.bytes += picture.length;
    counted.longestGap = Math.max(counted.longestGap, at - counted.lastFrame);
    counted.lastFrame = at;
    while (this.#unseen.length > 0 && this.#unseen[0].number <= lastInput) {
      counted.latencies.push((at - this.#unseen.shift().at) * 1000);
    }
    this.#onArrival.resolve();
  }

  #end(why) {
    clearInterval(this.#timer);
    if (this.ended !== null) return;
    this.ended = why;
    this.#onArrival.reject(new Error(why));
  }
}

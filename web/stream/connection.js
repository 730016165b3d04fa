import {
  encodeAck,
  encodeBroken,
  encodeCapture,
  encodeHello,
  encodeInput,
  encodeLimits,
  encodeOffer,
  encodePainted,
  encodePresented,
  encodeResize,
} from './client_messages.js';
import { CloseCode, kAdaptiveProtocols, kMeasuringProtocols, kSpatialProtocols } from './protocol.js';
import { decodeServerMessage } from './server_messages.js';

/** After this long without a message (ms), the connection counts as lost. */
const kLongestSilence = 10_000;
/**
 * Servers of 1.2 and later send something twice a second: after this long without a message (ms), the page shows a
 * notice.
 */
const kShortSilence = 1500;
/** A page that stalled for longer than this (ms) may have unread messages. */
const kStall = 250;
/** Delay (ms) until the next attempt if the server is full. */
const kFullDelay = 15_000;

const kOpenReadyState = 1;

/** The listener of each message. */
const kListeners = Object.freeze({
  Waiting: 'waiting',
  Frame: 'picture',
  Picture: 'picture',
  Status: 'status',
  Refining: 'refining',
  Captured: 'captured',
  Times: 'times',
  People: 'people',
  Ground: 'ground',
});

/**
 * The page's connection to the server. Reconnects by itself after a loss.
 *
 * States: `connecting` (for the first time), `open` (welcomed), `silent` (open, but without messages), `lost`
 * (unreachable; retries), `full` (retries more slowly), `away` (the place went to another visitor while the page was
 * hidden; retries), `outdated` (page and server have different versions) and `refused` (with the server's reason). The
 * last two stay until retry().
 */
export class Connection {
  #openSocket;
  #offer;
  #hello;
  #on;
  #backoff;
  #clock;
  #mayRetry;

  #state = 'connecting';
  #socket = null;
  #greeted = false;
  #adapts = false;
  #measures = false;
  #isSpatial = false;
  #patience = kLongestSilence;
  #lastAcknowledged = 0;
  #size = null;
  #retryTimer;
  #silenceTimer;

  /**
   * @param {object} parts
   * @param {() => WebSocket} parts.openSocket starts a new socket
   * @param {() => number[]} parts.offer the codecs to offer before Hello, best first
   * @param {() => {name: string, width: number, height: number}} parts.hello the content of Hello, read each time
   * @param {object} parts.on
   * @param {(state: string, reason: string) => void} parts.on.state on each change
   * @param {(message: object) => void} parts.on.welcome on each Welcome
   * @param {(message: object) => void} parts.on.waiting progress of the world's preparation, before Welcome
   * @param {(message: object) => void} parts.on.picture on each Frame or Picture; `arrived`: time of its arrival (ms)
   * @param {(message: object) => void} [parts.on.status]
   * @param {(message: object) => void} [parts.on.refining]
   * @param {(message: object) => void} [parts.on.captured]
   * @param {(message: object) => void} [parts.on.times]
   * @param {(message: object) => void} [parts.on.people]
   * @param {(message: object) => void} [parts.on.ground]
   * @param {import('./backoff.js').Backoff} parts.backoff
   * @param {() => boolean} parts.mayRetry whether the page is visible: a hidden page neither expects messages nor
   *     retries. The owner calls retry() and listen() when it becomes true
   * @param {{now: Function, setTimeout: Function, clearTimeout: Function}} parts.clock milliseconds
   */
  constructor({ openSocket, offer, hello, on, backoff, mayRetry, clock }) {
    this.#openSocket = openSocket;
    this.#offer = offer;
    this.#hello = hello;
    this.#on = on;
    this.#backoff = backoff;
    this.#mayRetry = mayRetry;
    this.#clock = clock;
  }

  get state() {
    return this.#state;
  }

  /** Whether the server speaks 1.2 or later, with Offer, Limits and Broken. */
  get adapts() {
    return this.#greeted && this.#adapts;
  }

  /** Whether the server speaks 1.3 or later, with Painted and Capture. */
  get measures() {
    return this.#greeted && this.#measures;
  }

  /** Whether the server speaks 1.5 or later, with Ground and the spaces of pictures. */
  get isSpatial() {
    return this.#greeted && this.#isSpatial;
  }

  start() {
    this.#on.state(this.#state, '');
    this.#connect();
  }

  /** Reconnects at once, unless a connection exists or is being made. */
  retry() {
    if (this.#socket) return;
    this.#clock.clearTimeout(this.#retryTimer);
    this.#connect();
  }

  /** Restarts the count of silence: the server sends nothing to a hidden page. */
  listen() {
    if (this.#socket) this.#watchSilence();
  }

  sendInput(input) {
    this.#send(encodeInput(input));
  }

  /** Requests frames of this size, unless the server already has the request. */
  sendResize({ width, height }) {
    if (!this.#greeted || (width === this.#size.width && height === this.#size.height)) return;
    this.#size = { width, height };
    this.#send(encodeResize({ width, height }));
  }

  /**
   * Acknowledges a picture, and with it all earlier ones: it was presented, or never will be. `decode` and `paint` are
   * milliseconds, 0 for a step that did not happen.
   */
  acknowledge({ frame, arrived }, { decode = 0, paint = 0 } = {}) {
    if (!this.#greeted || frame <= this.#lastAcknowledged) return;
    this.#lastAcknowledged = frame;
    const times = { frame, held: this.#clock.now() - arrived, arrived: arrived * 1000 };
    if (this.#measures) this.#send(encodePainted({ ...times, decode, paint }));
    else if (this.#adapts) this.#send(encodePresented(times));
    else this.#send(encodeAck({ frame }));
  }

  sendCapture(number) {
    if (this.measures) this.#send(encodeCapture({ number }));
  }

  sendOffer(codecs) {
    if (this.adapts) this.#send(encodeOffer({ codecs }));
  }

  sendLimits(limits) {
    if (this.adapts) this.#send(encodeLimits(limits));
  }

  sendBroken(frame) {
    if (this.adapts) this.#send(encodeBroken({ frame }));
  }

  #send(bytes) {
    if (this.#greeted && this.#socket.readyState === kOpenReadyState) this.#socket.send(bytes);
  }

  #connect() {
    const socket = this.#openSocket();
    socket.binaryType = 'arraybuffer';
    this.#socket = socket;
    this.#greeted = false;
    this.#patience = kLongestSilence;
    this.#lastAcknowledged = 0;
    this.#watchSilence();
    socket.onopen = () => {
      this.#adapts = kAdaptiveProtocols.includes(socket.protocol);
      this.#isSpatial = kSpatialProtocols.includes(socket.protocol);
      this.#measures = kMeasuringProtocols.includes(socket.protocol);
      if (this.#adapts) socket.send(encodeOffer({ codecs: this.#offer() }));
      const hello = this.#hello();
      this.#size = hello;
      socket.send(encodeHello(hello));
    };
    socket.onmessage = ({ data }) => this.#receive(data);
    socket.onclose = ({ code, reason }) => this.#end(code, reason);
  }

  #receive(data) {
    const arrived = this.#clock.now();
    if (this.#state === 'silent') this.#enter('open');
    try {
      const message = decodeServerMessage(data);
      if (message.message === 'Welcome') {
        this.#greeted = true;
        this.#on.welcome(message);
        this.#enter('open');
      } else if (this.#greeted || message.message === 'Waiting') {
        if (message.message !== 'Waiting') this.#backoff.reset();
        // From now on the server sends regularly. Before, preparing the world may delay its messages.
        if (this.#adapts && ['Picture', 'Status'].includes(message.message)) this.#patience = kShortSilence;
        this.#on[kListeners[message.message]]?.({ ...message, arrived });
      }
      if (this.#socket) this.#watchSilence();
    } catch (error) {
      if (error.name !== 'ProtocolError') throw error;
      this.#abandon(CloseCode.protocolError, error.message);
    }
  }

  /** (Re)starts the timer for a server that vanished without closing: TCP alone takes minutes to notice. */
  #watchSilence(since = this.#clock.now(), patience = this.#patience) {
    this.#clock.clearTimeout(this.#silenceTimer);
    const due = since + patience;
    this.#silenceTimer = this.#clock.setTimeout(() => {
      if (!this.#mayRetry()) this.#watchSilence();
      else if (this.#clock.now() > due + kStall) this.#watchSilence(this.#clock.now() - patience + kStall, patience);
      else if (patience < kLongestSilence) this.#fallSilent(since);
      else this.#abandon(1000, '');
    }, due - this.#clock.now());
  }

  #fallSilent(since) {
    this.#enter('silent');
    this.#watchSilence(since, kLongestSilence);
  }

  /** Drops the socket without waiting for its closing handshake. */
  #abandon(code, reason) {
    const socket = this.#socket;
    socket.onopen = socket.onmessage = socket.onclose = null;
    socket.close(code === CloseCode.protocolError ? code : 1000);
    this.#end(code, reason);
  }

  #end(code, reason) {
    this.#clock.clearTimeout(this.#silenceTimer);
    this.#socket = null;
    this.#greeted = false;
    switch (code) {
      case CloseCode.full:
        this.#enter('full', reason);
        this.#retryAfter(kFullDelay);
        break;
      case CloseCode.hidden:
        this.#enter('away', reason);
        this.#retryAfter(this.#backoff.next());
        break;
      case CloseCode.wrongVersion:
        this.#enter('outdated', reason);
        break;
      case CloseCode.protocolError:
      case CloseCode.flood:
        this.#enter('refused', reason);
        break;
      default:
        this.#enter('lost', reason);
        this.#retryAfter(this.#backoff.next());
    }
  }

  #retryAfter(delay) {
    this.#retryTimer = this.#clock.setTimeout(() => {
      if (this.#mayRetry()) this.retry();
    }, delay);
  }

  #enter(state, reason = '') {
    if (state === this.#state) return;
    this.#state = state;
    this.#on.state(state, reason);
  }
}

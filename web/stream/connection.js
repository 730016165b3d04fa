import {
  CloseCode,
  decodeServerMessage,
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
  kAdaptiveProtocols,
  kMeasuringProtocols,
} from './protocol.js';

/** After this long without a word from the server (ms), the connection counts as lost. */
const kLongestSilence = 10_000;
/** A server that adapts its stream says something twice a second; after this long (ms), the visitor is told. */
const kShortSilence = 1500;
/** A page that was itself held up for longer than this (ms) has words of the server before it, unread. */
const kHeldUp = 250;
/** When the server is full, the page knocks again after this long (ms). */
const kFullDelay = 15_000;

const kOpenReadyState = 1;

/** Who hears of which message. */
const kListeners = Object.freeze({
  Waiting: 'waiting',
  Frame: 'picture',
  Picture: 'picture',
  Status: 'status',
  Refining: 'refining',
  Captured: 'captured',
  Times: 'times',
  People: 'people',
});

/**
 * The page's one link to the server. Reaches it again by itself after a loss.
 *
 * States: `connecting` (the first time), `open` (welcomed), `silent` (still open, but the server says nothing), `lost`
 * (out of reach, trying again), `full` (trying again more slowly), `away` (the place went to another while nobody looked; trying again), `outdated` (the page speaks another version) and
 * `refused` (the server said why). The last two stay until retry().
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
  #patience = kLongestSilence;
  #lastAcknowledged = 0;
  #size = null;
  #retryTimer;
  #silenceTimer;

  /**
   * @param {object} parts
   * @param {() => WebSocket} parts.openSocket starts a new socket
   * @param {() => number[]} parts.offer the codecs to offer before the hello, the best first
   * @param {() => {name: string, width: number, height: number}} parts.hello what to say first, asked for each time
   * @param {object} parts.on
   * @param {(state: string, reason: string) => void} parts.on.state on every change
   * @param {(message: object) => void} parts.on.welcome when let in
   * @param {(message: object) => void} parts.on.waiting as the wait for the first picture gets on; `isIn`:
   *     after the welcome
   * @param {(message: object) => void} parts.on.picture for each Frame or Picture, with the time of its arrival (ms) as
   *     `arrived`
   * @param {(message: object) => void} [parts.on.status]
   * @param {(message: object) => void} [parts.on.refining]
   * @param {(message: object) => void} [parts.on.captured]
   * @param {(message: object) => void} [parts.on.times]
   * @param {(message: object) => void} [parts.on.people]
   * @param {import('./backoff.js').Backoff} parts.backoff
   * @param {() => boolean} parts.mayRetry whether anybody looks, so that silence means something and trying again is
   *     worth it; once it turns true again, retry() and listen() will be called
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

  /** Whether the server takes offers, limits and the like: it speaks 1.2 or later. */
  get adapts() {
    return this.#greeted && this.#adapts;
  }

  /** Whether the server takes Painted and Capture: it speaks 1.3 or later. */
  get measures() {
    return this.#greeted && this.#measures;
  }

  start() {
    this.#on.state(this.#state, '');
    this.#connect();
  }

  /** Tries again at once, unless a connection stands or is being made. */
  retry() {
    if (this.#socket) return;
    this.#clock.clearTimeout(this.#retryTimer);
    this.#connect();
  }

  /** Begins to count the server's silence anew: while nobody looked, it had no reason to speak. */
  listen() {
    if (this.#socket) this.#expectWord();
  }

  sendInput(input) {
    this.#send(encodeInput(input));
  }

  /** Asks for frames of another size, unless the server knows that one as the last wanted. */
  sendResize({ width, height }) {
    if (!this.#greeted || (width === this.#size.width && height === this.#size.height)) return;
    this.#size = { width, height };
    this.#send(encodeResize({ width, height }));
  }

  /**
   * Tells that the picture was presented or will never be; earlier ones are acknowledged with it. `decode` and `paint`
   * are milliseconds, 0 for what has not happened.
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
    this.#expectWord();
    socket.onopen = () => {
      this.#adapts = kAdaptiveProtocols.includes(socket.protocol);
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
        // From now on the server keeps speaking; while a world is made for a newcomer it may take its time.
        if (this.#adapts && ['Picture', 'Status'].includes(message.message)) this.#patience = kShortSilence;
        this.#on[kListeners[message.message]]?.({ ...message, arrived, isIn: this.#greeted });
      }
      if (this.#socket) this.#expectWord();
    } catch (error) {
      if (error.name !== 'ProtocolError') throw error;
      this.#abandon(CloseCode.protocolError, error.message);
    }
  }

  /** (Re)starts the watch for a server that vanished without closing, which TCP alone notices only after minutes. */
  #expectWord(heard = this.#clock.now(), patience = this.#patience) {
    this.#clock.clearTimeout(this.#silenceTimer);
    const due = heard + patience;
    this.#silenceTimer = this.#clock.setTimeout(() => {
      if (!this.#mayRetry()) this.#expectWord();
      else if (this.#clock.now() > due + kHeldUp) this.#expectWord(this.#clock.now() - patience + kHeldUp, patience);
      else if (patience < kLongestSilence) this.#fallSilent(heard);
      else this.#abandon(1000, '');
    }, due - this.#clock.now());
  }

  #fallSilent(heard) {
    this.#enter('silent');
    this.#expectWord(heard, kLongestSilence);
  }

  /** Lets go of the socket without waiting for its closing handshake. */
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

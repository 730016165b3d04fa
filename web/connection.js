import { CloseCode, decodeServerMessage, encodeAck, encodeHello, encodeInput, encodeResize } from './protocol.js';

/** After this long without a word from the server (ms), the connection counts as lost. */
const kLongestSilence = 10_000;
/** When the server is full, the page knocks again after this long (ms). */
const kFullDelay = 15_000;

const kOpenReadyState = 1;

/**
 * The page's one link to the server. Reaches it again by itself after a loss.
 *
 * States: `connecting` (the first time), `open` (welcomed), `lost` (out of reach, trying again), `full` (trying again
 * more slowly), `outdated` (the page speaks another version) and `refused` (the server said why). The last two stay
 * until retry().
 */
export class Connection {
  #openSocket;
  #hello;
  #on;
  #backoff;
  #timers;
  #mayRetry;

  #state = 'connecting';
  #socket = null;
  #greeted = false;
  #lastAcknowledged = 0;
  #size = null;
  #retryTimer;
  #silenceTimer;

  /**
   * @param {object} parts
   * @param {() => WebSocket} parts.openSocket starts a new socket
   * @param {() => {name: string, width: number, height: number}} parts.hello what to say first, asked for each time
   * @param {{state: Function, welcome: Function, waiting: Function, refining: Function, frame: Function}} parts.on
   *     `state(state, reason)` on every change, `welcome(message)` when let in, `waiting(message, isIn)` as the wait for
   *     the first frame gets on, before one is let in or after, `refining(message)` as the world gets finer,
   *     `frame(message)` for each frame
   * @param {import('./backoff.js').Backoff} parts.backoff
   * @param {() => boolean} parts.mayRetry whether trying again is worth it now; if not, retry() will be called
   * @param {{setTimeout: Function, clearTimeout: Function}} parts.timers
   */
  constructor({ openSocket, hello, on, backoff, mayRetry, timers }) {
    this.#openSocket = openSocket;
    this.#hello = hello;
    this.#on = on;
    this.#backoff = backoff;
    this.#mayRetry = mayRetry;
    this.#timers = timers;
  }

  get state() {
    return this.#state;
  }

  start() {
    this.#on.state(this.#state, '');
    this.#connect();
  }

  /** Tries again at once, unless a connection stands or is being made. */
  retry() {
    if (this.#socket) return;
    this.#timers.clearTimeout(this.#retryTimer);
    this.#connect();
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

  /** Tells that the frame was presented or will never be; earlier frames are acknowledged with it. */
  acknowledge(frame) {
    if (!this.#greeted || frame <= this.#lastAcknowledged) return;
    this.#lastAcknowledged = frame;
    this.#send(encodeAck({ frame }));
  }

  #send(bytes) {
    if (this.#greeted && this.#socket.readyState === kOpenReadyState) this.#socket.send(bytes);
  }

  #connect() {
    const socket = this.#openSocket();
    socket.binaryType = 'arraybuffer';
    this.#socket = socket;
    this.#greeted = false;
    this.#lastAcknowledged = 0;
    this.#expectWord();
    socket.onopen = () => {
      const hello = this.#hello();
      this.#size = hello;
      socket.send(encodeHello(hello));
    };
    socket.onmessage = ({ data }) => this.#receive(data);
    socket.onclose = ({ code, reason }) => this.#end(code, reason);
  }

  #receive(data) {
    this.#expectWord();
    try {
      const message = decodeServerMessage(data);
      if (message.message === 'Welcome') {
        this.#greeted = true;
        this.#on.welcome(message);
        this.#enter('open');
      } else if (message.message === 'Waiting') {
        this.#on.waiting(message, this.#greeted);
      } else if (this.#greeted && message.message === 'Refining') {
        this.#on.refining(message);
      } else if (this.#greeted && message.picture) {
        this.#backoff.reset();
        this.#on.frame(message);
      }
    } catch (error) {
      if (error.name !== 'ProtocolError') throw error;
      this.#abandon(CloseCode.protocolError, error.message);
    }
  }

  /** (Re)starts the watch for a server that vanished without closing, which TCP alone notices only after minutes. */
  #expectWord() {
    this.#timers.clearTimeout(this.#silenceTimer);
    this.#silenceTimer = this.#timers.setTimeout(() => {
      // A hidden page presents, and so receives, next to nothing.
      if (this.#mayRetry()) this.#abandon(1000, '');
      else this.#expectWord();
    }, kLongestSilence);
  }

  /** Lets go of the socket without waiting for its closing handshake. */
  #abandon(code, reason) {
    const socket = this.#socket;
    socket.onopen = socket.onmessage = socket.onclose = null;
    socket.close(code === CloseCode.protocolError ? code : 1000);
    this.#end(code, reason);
  }

  #end(code, reason) {
    this.#timers.clearTimeout(this.#silenceTimer);
    this.#socket = null;
    this.#greeted = false;
    switch (code) {
      case CloseCode.full:
        this.#enter('full', reason);
        this.#retryAfter(kFullDelay);
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
    this.#retryTimer = this.#timers.setTimeout(() => {
      if (this.#mayRetry()) this.retry();
    }, delay);
  }

  #enter(state, reason = '') {
    if (state === this.#state) return;
    this.#state = state;
    this.#on.state(state, reason);
  }
}

import { decodeNearness } from '../picture/nearness_grid.js';
import { Receiver } from './receiver.js';

function workerOf(window) {
  try {
    return new window.Worker(new URL('receiver_worker.js', import.meta.url), { type: 'module' });
  } catch {
    return null;
  }
}

/**
 * Runs the receiver in a worker if the browser can paint from one, so that a busy page delays neither arrival nor
 * painting; else on the main thread. Commands wait until open() has chosen.
 */
export class ReceiverHome {
  #window;
  #clock;
  #canvas;
  #start;
  #on;
  #deliver = null;
  #waiting = [];

  /**
   * @param {object} parts
   * @param {Window} parts.window
   * @param {object} parts.clock as in connection.js
   * @param {HTMLCanvasElement} parts.canvas
   * @param {object} parts.start as Receiver takes it
   * @param {(event: object) => void} parts.on called with each event of the receiver
   */
  constructor({ window, clock, canvas, start, on }) {
    this.#window = window;
    this.#clock = clock;
    this.#canvas = canvas;
    this.#start = { ...start, timeOrigin: window.performance.timeOrigin };
    this.#on = on;
  }

  /** Resolves to the receiver's place: `worker` or `page`. */
  async open() {
    const worker = this.#canvas.transferControlToOffscreen ? workerOf(this.#window) : null;
    const isAble = worker !== null && (await this.#canPaint(worker));
    if (isAble) this.#moveInto(worker);
    else this.#stay(worker);
    for (const command of this.#waiting.splice(0)) this.#deliver(command);
    return isAble ? 'worker' : 'page';
  }

  send(command) {
    if (this.#deliver) this.#deliver(command);
    else this.#waiting.push(command);
  }

  /** A browser without module workers reports an error. */
  #canPaint(worker) {
    return new Promise((resolve) => {
      worker.onmessage = ({ data }) => resolve(data.able);
      worker.onerror = () => resolve(false);
    });
  }

  #moveInto(worker) {
    worker.onerror = null;
    worker.onmessage = ({ data }) => this.#on(data);
    const canvas = this.#canvas.transferControlToOffscreen();
    worker.postMessage({ kind: 'start', canvas, start: this.#start }, [canvas]);
    this.#deliver = (command) => worker.postMessage(command);
  }

  #stay(worker) {
    worker?.terminate();
    const receiver = new Receiver({
      scope: this.#window,
      clock: this.#clock,
      canvas: this.#canvas,
      makeCanvas: () => this.#window.document.createElement('canvas'),
      emit: (event) => this.#on(event),
      decodeNearness,
      start: this.#start,
    });
    this.#deliver = (command) => receiver.do(command);
    receiver.start();
  }
}

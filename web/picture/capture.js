/** A server that has not answered after so long (ms) does not answer. */
const kLongestWait = 3000;

/**
 * Pictures for the visitor to keep: asked of the server, at the full wanted size and the finest quality, whatever the
 * stream is like; where that fails, what is on the screen.
 */
export class Capture {
  #send;
  #clock;
  #number = 0;
  #asked = new Map();

  /** `send(command)` hands commands to the Receiver. `clock` is as `window`. */
  constructor({ send, clock }) {
    this.#send = send;
    this.#clock = clock;
  }

  /** Promises a Blob: a JPEG of the server, or a PNG of the screen. */
  async take() {
    const jpeg = await this.#ask('capture');
    if (jpeg) return new Blob([jpeg], { type: 'image/jpeg' });
    const png = await this.#ask('picture');
    if (!png) throw new Error('there is no picture');
    return png;
  }

  /** The receiver answers `number`; `picture` is `null` if there is none. A late answer finds nobody who asked. */
  answered({ number, picture }) {
    const answer = this.#asked.get(number);
    this.#asked.delete(number);
    answer?.(picture);
  }

  #ask(kind) {
    this.#number += 1;
    const number = this.#number;
    return new Promise((resolve) => {
      const timer = this.#clock.setTimeout(() => this.answered({ number, picture: null }), kLongestWait);
      this.#asked.set(number, (picture) => {
        this.#clock.clearTimeout(timer);
        resolve(picture);
      });
      this.#send({ kind, number });
    });
  }
}

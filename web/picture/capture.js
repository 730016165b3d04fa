/** After this long (ms) without an answer, the page takes the picture from the screen. */
const kLongestWait = 3000;

/**
 * Pictures for screenshots: requested from the server, in the full wanted size and finest quality whatever the stream's
 * are. If that fails, taken from the screen.
 */
export class Capture {
  #send;
  #clock;
  #number = 0;
  #requests = new Map();

  /** `send(command)` passes commands to the Receiver. `clock` has the timers of `window`. */
  constructor({ send, clock }) {
    this.#send = send;
    this.#clock = clock;
  }

  /** Resolves to a Blob: a JPEG from the server, or a PNG of the screen. */
  async take() {
    const jpeg = await this.#ask('capture');
    if (jpeg) return new Blob([jpeg], { type: 'image/jpeg' });
    const png = await this.#ask('picture');
    if (!png) throw new Error('there is no picture');
    return png;
  }

  /** The receiver's answer to request `number`; `picture` may be `null`. Late answers have no effect. */
  answered({ number, picture }) {
    const answer = this.#requests.get(number);
    this.#requests.delete(number);
    answer?.(picture);
  }

  #ask(kind) {
    this.#number += 1;
    const number = this.#number;
    return new Promise((resolve) => {
      const timer = this.#clock.setTimeout(() => this.answered({ number, picture: null }), kLongestWait);
      this.#requests.set(number, (picture) => {
        this.#clock.clearTimeout(timer);
        resolve(picture);
      });
      this.#send({ kind, number });
    });
  }
}

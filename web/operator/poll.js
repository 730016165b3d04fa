import { Backoff } from '../stream/backoff.js';

const kInterval = 1000;
/** A server that is silent for so long is gone. Milliseconds. */
const kPatience = 5000;

/** Asks again and again while it runs: once a second, and with growing delays while there is no answer. */
export class Poll {
  #ask;
  #on;
  #timers;
  #backoff;
  #timer = null;
  #turn = 0;

  /** `ask()` promises an answer; `on.answer(answer)` and `on.lost()` are called with it. `timers` is as `window`. */
  constructor({ ask, on, timers, backoff = new Backoff() }) {
    this.#ask = ask;
    this.#on = on;
    this.#timers = timers;
    this.#backoff = backoff;
  }

  start() {
    this.stop();
    this.#backoff.reset();
    this.#next();
  }

  /** What is on its way is not listened to any more. */
  stop() {
    this.#turn += 1;
    this.#timers.clearTimeout(this.#timer);
  }

  #next() {
    this.#turn += 1;
    const turn = this.#turn;
    const settle = (then) => (answer) => {
      if (turn !== this.#turn) return;
      this.stop();
      then(answer);
    };
    const lost = settle(() => {
      this.#again(this.#backoff.next());
      this.#on.lost();
    });
    const answered = settle((answer) => {
      this.#backoff.reset();
      this.#again(kInterval);
      this.#on.answer(answer);
    });
    this.#timer = this.#timers.setTimeout(lost, kPatience);
    this.#ask().then(answered, lost);
  }

  #again(delay) {
    this.#timer = this.#timers.setTimeout(() => this.#next(), delay);
  }
}

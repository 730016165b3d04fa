import { Backoff } from '../stream/backoff.js';

const kInterval = 1000;
/** Without an answer for this long, the server counts as lost. Milliseconds. */
const kPatience = 5000;

/** Requests an answer once a second, with growing delays while there is none. */
export class Poll {
  #ask;
  #on;
  #timers;
  #backoff;
  #timer = null;
  #turn = 0;

  /**
   * `ask()` promises an answer. Calls `on.answer(answer)`, or without one `on.lost()`. `timers` has the timers of `window`.
   */
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

  /** Also discards a pending answer. */
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

/** The page's visibility in a worker: like `document`, it has `hidden` and `visibilitychange`. */
export class Visibility extends EventTarget {
  #hidden;

  constructor(hidden) {
    super();
    this.#hidden = hidden;
  }

  get hidden() {
    return this.#hidden;
  }

  set hidden(hidden) {
    if (hidden === this.#hidden) return;
    this.#hidden = hidden;
    this.dispatchEvent(new Event('visibilitychange'));
  }
}

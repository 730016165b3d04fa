/** Whether anybody looks at the page, where there is no document to ask: as `document`, it has `hidden` and the event. */
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

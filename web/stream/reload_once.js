const kMark = 'grove.reloaded';

/**
 * Reloads a page that is older than its server, but only once: afterwards, and without the browser's storage, the
 * notice asks the visitor.
 */
export class ReloadOnce {
  #window;

  constructor(window) {
    this.#window = window;
  }

  /** Reloads, unless it did so since the last settled(). */
  attempt() {
    try {
      if (this.#window.sessionStorage.getItem(kMark)) return;
      this.#window.sessionStorage.setItem(kMark, 'yes');
    } catch {
      return;
    }
    this.#window.location.reload();
  }

  /** The versions agree. */
  settled() {
    try {
      this.#window.sessionStorage.removeItem(kMark);
    } catch {
      // Nothing was stored either.
    }
  }
}

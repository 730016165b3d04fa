const kMark = 'grove.reloaded';

/**
 * A page that is older than its server reloads by itself, but once only: if that does not help, its visitor is asked.
 * Where the browser keeps no storage for the page, the visitor is asked at once.
 */
export class ReloadOnce {
  #window;

  constructor(window) {
    this.#window = window;
  }

  /** Reloads, unless that was tried since the last settled(). */
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

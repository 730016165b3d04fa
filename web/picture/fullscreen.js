/** Toggles full screen. Hides the button if the browser has none (most phones). Older Safari has prefixed names. */
export class Fullscreen {
  #document;

  constructor(document, button) {
    this.#document = document;
    button.hidden = !(document.fullscreenEnabled ?? document.webkitFullscreenEnabled ?? false);
    button.addEventListener('click', () => this.toggle());
    const changed = () => button.setAttribute('aria-pressed', String(this.#isOn));
    document.addEventListener('fullscreenchange', changed);
    document.addEventListener('webkitfullscreenchange', changed);
  }

  async toggle() {
    const document = this.#document;
    const root = document.documentElement;
    try {
      if (this.#isOn) await (document.exitFullscreen ?? document.webkitExitFullscreen).call(document);
      else await (root.requestFullscreen ?? root.webkitRequestFullscreen)?.call(root);
    } catch {
      // The browser or its user refuses: the page stays as it is.
    }
  }

  get #isOn() {
    return Boolean(this.#document.fullscreenElement ?? this.#document.webkitFullscreenElement);
  }
}

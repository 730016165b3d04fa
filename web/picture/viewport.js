const kMaxWidth = 1920;
const kMaxHeight = 1080;
/** Phone screens are small and dense: more pixels would cost everybody time, and be invisible. */
const kMaxLongSideInHand = 1280;
const kMaxShortSideInHand = 720;
/** CSS pixels: the short side is under 500 on the largest phones, over 700 on the smallest tablets. */
const kLargestPhone = 600;
/** The protocol refuses a side below this. */
const kMinSide = 16;
/** A drag of the window's edge must request one new size, not fifty. Milliseconds. */
const kSettleTime = 200;

/**
 * The frame to request, in pixels, for a window in CSS pixels: bounded, in the window's shape. `coarse`: fingers point.
 */
export function fitStream(width, height, pixelRatio, coarse) {
  const [long, short] = [Math.max(width, height, 1), Math.max(Math.min(width, height), 1)];
  const inHand = coarse && short < kLargestPhone;
  const scale = Math.min(
    pixelRatio,
    inHand ? kMaxLongSideInHand / long : kMaxWidth / Math.max(width, 1),
    inHand ? kMaxShortSideInHand / short : kMaxHeight / Math.max(height, 1),
  );
  const side = (length) => Math.max(kMinSide, Math.round(length * scale));
  return { width: side(width), height: side(height) };
}

/** Watches the window's size and pixel ratio. Calls `onSize` with each new wanted size after it has settled. */
export class Viewport {
  #window;
  #onSize;
  #timer;

  constructor(window, onSize) {
    this.#window = window;
    this.#onSize = onSize;
    window.addEventListener('resize', () => this.#settle());
    this.#watchPixelRatio();
  }

  get size() {
    const { innerWidth, innerHeight, devicePixelRatio } = this.#window;
    const coarse = this.#window.matchMedia('(pointer: coarse)').matches;
    return fitStream(innerWidth, innerHeight, devicePixelRatio, coarse);
  }

  /** A move to another screen changes the pixel ratio without a resize; a query matches one ratio only. */
  #watchPixelRatio() {
    const query = this.#window.matchMedia(`(resolution: ${this.#window.devicePixelRatio}dppx)`);
    const changed = () => {
      this.#settle();
      this.#watchPixelRatio();
    };
    query.addEventListener('change', changed, { once: true });
  }

  #settle() {
    this.#window.clearTimeout(this.#timer);
    this.#timer = this.#window.setTimeout(() => this.#onSize(this.size), kSettleTime);
  }
}

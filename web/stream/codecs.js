import { Codec, kCodecNames } from './protocol.js';

const kMark = 'grove.failed-codecs';
/** Constrained Baseline at the levels of 720 and 1080 lines; the page needs both. */
const kH264Levels = ['avc1.42E01F', 'avc1.42E028'];
/** A browser that takes longer to answer (ms) gets JPEG, so that the visitor does not wait. */
const kLongestAnswerTime = 1000;
/** Codecs that a visitor can choose by name. */
const kForced = Object.freeze({ h264: [Codec.h264], jpeg: [Codec.jpegPatches, Codec.jpeg] });

async function claimsH264(VideoDecoder) {
  if (!VideoDecoder) return false;
  const answers = await Promise.all(
    kH264Levels.map((codec) => VideoDecoder.isConfigSupported({ codec, optimizeForLatency: true })),
  );
  return answers.every(({ supported }) => supported);
}

/**
 * The codecs that this page can decode, best first: those that the browser claims, without those that failed. Failures
 * are kept for the tab's life, if the browser provides storage.
 */
export class Codecs {
  #window;
  #claimed = [Codec.jpegPatches];
  #failed = new Set();

  /** `window` has `sessionStorage`, `setTimeout` and, in secure contexts only, `VideoDecoder`. */
  constructor(window) {
    this.#window = window;
    try {
      for (const codec of JSON.parse(window.sessionStorage.getItem(kMark) ?? '[]')) this.#failed.add(codec);
    } catch {
      // No storage, or foreign content: no codec has failed so far.
    }
  }

  /** Queries the browser. Until it resolves, the page can decode JPEG only. Never rejects. */
  async ask() {
    const late = new Promise((resolve) => this.#window.setTimeout(() => resolve(false), kLongestAnswerTime));
    const claims = await Promise.race([claimsH264(this.#window.VideoDecoder).catch(() => false), late]);
    if (claims) this.#claimed = [Codec.h264, Codec.jpegPatches];
  }

  /**
   * The codecs to offer; `preference` is `auto`, `h264` or `jpeg`. The server may choose any offered codec, so a
   * preferred one is offered alone. JPEG is the fallback, because every browser has it.
   */
  offer(preference) {
    const usable = [...this.#claimed.filter((codec) => !this.#failed.has(codec)), Codec.jpeg];
    if (!(preference in kForced)) return usable;
    const wanted = usable.filter((codec) => kForced[preference].includes(codec));
    return wanted.length > 0 ? wanted : usable.filter((codec) => kForced.jpeg.includes(codec));
  }

  /** Excludes a failed codec from all later offers. */
  drop(codec) {
    this.#failed.add(codec);
    try {
      this.#window.sessionStorage.setItem(kMark, JSON.stringify([...this.#failed]));
    } catch {
      // Then the page tries the codec again after a reload.
    }
  }
}

/** For messages: `H.264, JPEG`. */
export function namesOf(codecs) {
  return [...new Set(codecs.map((codec) => kCodecNames[codec]))].join(', ');
}

import { Codec, kCodecNames } from './protocol.js';

const kMark = 'grove.failed-codecs';
/** Constrained Baseline at the levels of 720 and 1080 lines; a browser that has one but not the other is of no use. */
const kH264Levels = ['avc1.42E01F', 'avc1.42E028'];
/** Who takes longer to answer (ms) than a visitor waits gladly does without. */
const kLongestQuestion = 1000;
/** By what a visitor may ask for by name. */
const kForced = Object.freeze({ h264: Codec.h264, jpeg: Codec.jpeg });

async function claimsH264(VideoDecoder) {
  if (!VideoDecoder) return false;
  const answers = await Promise.all(
    kH264Levels.map((codec) => VideoDecoder.isConfigSupported({ codec, optimizeForLatency: true })),
  );
  return answers.every(({ supported }) => supported);
}

/**
 * The codecs that this page can decode, the best first: what the browser claims, less what has failed in spite of it.
 * A failure is remembered as long as the tab lives, where the browser keeps storage for it.
 */
export class Codecs {
  #window;
  #claimed = [];
  #failed = new Set();

  /** Of `window`: `VideoDecoder`, which browsers have in secure contexts only, `sessionStorage` and `setTimeout`. */
  constructor(window) {
    this.#window = window;
    try {
      for (const codec of JSON.parse(window.sessionStorage.getItem(kMark) ?? '[]')) this.#failed.add(codec);
    } catch {
      // No storage, or not what we wrote: nothing has failed so far.
    }
  }

  /** Asks the browser; until that resolves, the page can decode JPEG only. Never rejects. */
  async ask() {
    const late = new Promise((resolve) => this.#window.setTimeout(() => resolve(false), kLongestQuestion));
    const claims = await Promise.race([claimsH264(this.#window.VideoDecoder).catch(() => false), late]);
    this.#claimed = claims ? [Codec.h264] : [];
  }

  /**
   * What to offer; `preference` is `auto`, `h264` or `jpeg`. The server may choose among what is offered, so a codec that
   * is asked for stands alone. JPEG is offered where nothing else works: every browser has it.
   */
  offer(preference) {
    const usable = [...this.#claimed.filter((codec) => !this.#failed.has(codec)), Codec.jpeg];
    const wanted = usable.filter((codec) => codec === kForced[preference]);
    if (!(preference in kForced)) return usable;
    return wanted.length > 0 ? wanted : [Codec.jpeg];
  }

  /** Leaves a codec that does not work out of every further offer. */
  drop(codec) {
    this.#failed.add(codec);
    try {
      this.#window.sessionStorage.setItem(kMark, JSON.stringify([...this.#failed]));
    } catch {
      // Then it is tried again after a reload.
    }
  }
}

/** The codecs' names, as an offer is told to people. */
export function namesOf(codecs) {
  return codecs.map((codec) => kCodecNames[codec]).join(', ');
}

import { namesOf } from './codecs.js';
import { kCodecNames } from './protocol.js';
import { kStatistics } from '../texts.js';

/** The visitor's choices; 0 is no limit. `reducedMotion` is the system's setting. */
export const kPreferences = Object.freeze({
  codec: 'auto',
  framesPerSecond: 0,
  kilobitsPerSecond: 0,
  lines: 0,
  lateLook: true,
  reducedMotion: false,
});

/**
 * The page's side of the stream: negotiates codec and limits, decodes pictures, and reports those that it cannot
 * decode. Choices and failed codecs outlast a reconnection.
 */
export class Stream {
  #connection;
  #codecs;
  #decoding;
  #lateLook;
  #onCodecFailed;
  #preferences = kPreferences;
  #hidden = false;
  #told = '';

  /**
   * @param {object} parts
   * @param {import('./connection.js').Connection} parts.connection
   * @param {import('./codecs.js').Codecs} parts.codecs
   * @param {(on: object) => import('../picture/decoding.js').Decoding} parts.makeDecoding with its listeners
   * @param {import('../picture/display.js').Display} parts.display
   * @param {import('../picture/late_look.js').LateLook} parts.lateLook
   * @param {{now: Function}} parts.clock milliseconds
   * @param {(words: string) => void} parts.onCodecFailed a codec is no longer offered, with the reason
   */
  constructor({ connection, codecs, clock, makeDecoding, display, lateLook, onCodecFailed }) {
    this.#connection = connection;
    this.#codecs = codecs;
    this.#lateLook = lateLook;
    this.#onCodecFailed = onCodecFailed;
    this.#decoding = makeDecoding({
      image: (image, picture) => display.show(image, { ...picture, decode: clock.now() - picture.arrived }),
      skipped: (picture) => connection.acknowledge(picture),
      broken: (picture) => connection.sendBroken(picture.frame),
      useless: (codec, error) => this.#drop(codec, error),
    });
  }

  /** The codecs to offer, best first. */
  get offer() {
    return this.#codecs.offer(this.#preferences.codec);
  }

  /** Whether late look turns pictures. */
  get turns() {
    return this.#preferences.lateLook && this.#lateLook.isReady;
  }

  /**
   * Whether late look also moves pictures. A bent picture moves what does not move in the world, which a visitor may
   * have asked the system to avoid.
   */
  get walks() {
    return this.turns && this.#connection.isSpatial && !this.#preferences.reducedMotion;
  }

  /** The state of late look, for the overlay. */
  get lateLookWord() {
    if (this.turns) return this.walks ? kStatistics.lateLookOn : kStatistics.lateLookTurns;
    return this.#preferences.lateLook ? kStatistics.lateLookHindered(this.#lateLook.hindrance) : kStatistics.lateLookOff;
  }

  /**
   * Applies the visitor's choices; omitted ones stay.
   * @param {object} chosen
   * @param {'auto' | 'h264' | 'jpeg'} [chosen.codec]
   * @param {number} [chosen.framesPerSecond] at most; 0 is no limit, here and below
   * @param {number} [chosen.kilobitsPerSecond]
   * @param {number} [chosen.lines] height of the picture
   * @param {boolean} [chosen.lateLook] turn and move pictures to the visitor's newest view
   * @param {boolean} [chosen.reducedMotion] turn them only
   */
  setPreferences(chosen) {
    const before = this.#preferences;
    this.#preferences = { ...before, ...chosen };
    if (this.#preferences.codec !== before.codec) this.#connection.sendOffer(this.offer);
    this.tellLimits();
  }

  /** The server sends nothing to a hidden page. */
  setHidden(hidden) {
    this.#hidden = hidden;
    this.tellLimits();
  }

  /** A new connection has begun. */
  begin() {
    this.#decoding.reset();
    this.#told = '';
    this.tellLimits();
  }

  receive(picture) {
    this.#decoding.push(picture);
  }

  /** Sends changed limits. Also to be called when late look's `isReady` has changed. */
  tellLimits() {
    const { framesPerSecond, kilobitsPerSecond, lines } = this.#preferences;
    const shown = { hidden: this.#hidden, border: this.turns, nearness: this.walks };
    const limits = { ...shown, framesPerSecond, kilobitsPerSecond, lines };
    const words = JSON.stringify(limits);
    if (!this.#connection.adapts || words === this.#told) return;
    this.#told = words;
    this.#connection.sendLimits(limits);
  }

  #drop(codec, error) {
    this.#codecs.drop(codec);
    this.#connection.sendOffer(this.offer);
    this.#onCodecFailed(`${kCodecNames[codec]} does not work here (${error.message}); offering ${namesOf(this.offer)}`);
  }
}

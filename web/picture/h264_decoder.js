import { HoldWatch } from './hold_watch.js';

/** More chunks than this before the decoder only get stale: half a second at 60 a second. */
const kLongestQueue = 30;
const kSequenceParameters = 7;

/** The decoder holds pictures back until newer ones come: each is shown late, and the last one never. */
export class HoldsBack extends Error {
  name = 'HoldsBack';
}

/**
 * The codec's full name (profile, constraints and level, such as `avc1.42E01F`), from the parameter sets at the start
 * of an independent picture in Annex B; `null` without them.
 */
export function codecName(bytes) {
  for (let i = 0; i + 6 < bytes.length; i += 1) {
    if (bytes[i] !== 0 || bytes[i + 1] !== 0 || bytes[i + 2] !== 1) continue;
    if ((bytes[i + 3] & 0x1f) !== kSequenceParameters) continue;
    const digits = [...bytes.subarray(i + 4, i + 7)].map((byte) => byte.toString(16).padStart(2, '0'));
    return `avc1.${digits.join('').toUpperCase()}`;
  }
  return null;
}

/**
 * Decodes H.264 in Annex B by the browser's VideoDecoder; a decoder as in decoders.js. Pictures depend on earlier ones,
 * so the first must be independent, and a failure ends all output.
 */
export class H264Decoder {
  #EncodedVideoChunk;
  #decoder;
  #software;
  #on;
  #watch;
  #configured = '';
  #inside = new Map();
  #deferred = [];

  /**
   * @param {object} parts
   * @param {{VideoDecoder: Function, EncodedVideoChunk: Function}} parts.window
   * @param {object} parts.clock
   * @param {boolean} parts.software without the graphics card, which may hold pictures back
   */
  constructor({ window, clock, software, onImage, onFailure, onHeld }) {
    this.#EncodedVideoChunk = window.EncodedVideoChunk;
    this.#software = software;
    this.#on = { image: onImage, failure: onFailure, held: onHeld };
    this.#decoder = new window.VideoDecoder({
      output: (frame) => this.#output(frame),
      error: (error) => this.#fail(error),
    });
    this.#watch = new HoldWatch({
      clock,
      on: {
        rest: () => this.#on?.held([...this.#inside.values()].at(-1)),
        holds: () => this.#fail(new HoldsBack(`the decoder holds ${this.#inside.size} pictures back`)),
        tested: () => this.#pushDeferred(),
      },
    });
  }

  push(picture) {
    if (this.#watch.testing) this.#deferred.push(picture);
    else this.#put(picture);
  }

  close() {
    this.#on = null;
    this.#watch.close();
    if (this.#decoder.state !== 'closed') this.#decoder.close();
  }

  #put(picture) {
    const timestamp = picture.frame * 1000;
    this.#inside.set(timestamp, picture);
    try {
      if (this.#decoder.decodeQueueSize >= kLongestQueue) throw new Error('the decoder does not keep up');
      if (picture.independent) this.#configure(picture);
      const type = picture.independent ? 'key' : 'delta';
      this.#decoder.decode(new this.#EncodedVideoChunk({ type, timestamp, data: picture.picture }));
    } catch (error) {
      this.#fail(error);
      return;
    }
    this.#watch.put(this.#inside.size);
  }

  /** Again for each new size: some decoders do not take it from the stream. */
  #configure({ picture, width, height }) {
    const codec = codecName(picture);
    if (!codec) throw new Error('an independent picture has no parameter sets');
    const configuration = `${codec} ${width} ${height}`;
    if (configuration === this.#configured) return;
    this.#configured = configuration;
    this.#decoder.configure({
      codec,
      codedWidth: width,
      codedHeight: height,
      optimizeForLatency: true,
      hardwareAcceleration: this.#software ? 'prefer-software' : 'no-preference',
    });
  }

  #output(frame) {
    const picture = this.#inside.get(frame.timestamp);
    if (!this.#on || !picture) {
      frame.close();
      return;
    }
    // Without B pictures the order stays: older pictures will not come any more.
    for (const timestamp of this.#inside.keys()) if (timestamp <= frame.timestamp) this.#inside.delete(timestamp);
    this.#on.image(frame, picture);
    this.#watch.out(this.#inside.size, this.#inside.size - this.#decoder.decodeQueueSize);
  }

  #pushDeferred() {
    const deferred = this.#deferred;
    this.#deferred = [];
    for (const picture of deferred) this.push(picture);
  }

  #fail(error) {
    this.#on?.failure(error, [...this.#inside.values(), ...this.#deferred].at(-1) ?? null);
  }
}

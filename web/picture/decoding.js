import { Codec } from '../stream/protocol.js';

/** This many failures within this time (ms) make a codec useless; fewer if it never worked. */
const kFailures = 3;
const kFailuresAtFirst = 2;
const kFailureTime = 20_000;

/** The browser took the decoder back from a hidden page: the codec did not fail. */
const kReclaimed = 'QuotaExceededError';
/** The browser claims the codec, but refuses its decoder: retrying does not help. */
const kRefused = 'NotSupportedError';

/**
 * Turns pictures into images by the decoder of their codec, and recovers from its failures: skips pictures that depend
 * on a missing one, and requests an independent one. Images never go back in time.
 */
export class Decoding {
  #make;
  #clock;
  #on;
  #decoder = null;
  #codec = 0;
  #newest = 0;
  #chain = 'missing';
  #software = false;
  #failures = [];
  #worked = new Set();
  #useless = new Set();

  /**
   * @param {object} parts
   * @param {object} parts.make as decoders() returns it
   * @param {{now: Function}} parts.clock milliseconds
   * @param {object} parts.on
   * @param {(image: ImageBitmap | VideoFrame, picture: object) => void} parts.on.image owns the image
   * @param {(picture: object) => void} parts.on.skipped it and all earlier ones will not be shown
   * @param {(picture: object) => void} parts.on.broken cannot be decoded: an independent one is needed
   * @param {(codec: number, error: Error) => void} parts.on.useless the codec does not work in this browser
   */
  constructor({ make, clock, on }) {
    this.#make = make;
    this.#clock = clock;
    this.#on = on;
  }

  /** For a new connection, which counts frames anew: drops all pending pictures. */
  reset() {
    this.#close();
    this.#codec = 0;
    this.#newest = 0;
  }

  push(picture) {
    if (this.#useless.has(picture.codec)) {
      this.#on.skipped(picture);
      return;
    }
    if (picture.codec !== this.#codec) {
      this.#close();
      this.#codec = picture.codec;
    }
    // Older servers send only JPEG, without this flag.
    if (picture.independent ?? true) this.#chain = 'whole';
    if (this.#chain !== 'whole') {
      if (this.#chain === 'missing') this.#request(picture);
      this.#on.skipped(picture);
      return;
    }
    try {
      this.#decoder ??= this.#open();
    } catch (error) {
      this.#fail(error, picture);
      return;
    }
    this.#decoder.push(picture);
  }

  #open() {
    return this.#make[this.#codec]({
      software: this.#software,
      onImage: (image, picture) => this.#show(image, picture),
      onHeld: (picture) => this.#on.skipped(picture),
      onFailure: (error, picture) => this.#fail(error, picture),
    });
  }

  #close() {
    this.#decoder?.close();
    this.#decoder = null;
    this.#chain = 'missing';
  }

  #request(picture) {
    this.#chain = 'requested';
    this.#on.broken(picture);
  }

  #show(image, picture) {
    this.#worked.add(picture.codec);
    if (picture.frame <= this.#newest) {
      image.close();
      return;
    }
    this.#newest = picture.frame;
    this.#on.image(image, picture);
  }

  #fail(error, picture) {
    const codec = this.#codec;
    this.#close();
    if (this.#isUseless(codec, error)) {
      this.#useless.add(codec);
      this.#on.useless(codec, error);
    } else if (picture) {
      this.#request(picture);
    }
    if (picture) this.#on.skipped(picture);
  }

  #isUseless(codec, error) {
    if (codec === Codec.jpeg || error.name === kReclaimed) return false;
    if (error.name === kRefused) return true;
    if (error.name === 'HoldsBack') {
      const last = this.#software;
      this.#software = true;
      return last;
    }
    const now = this.#clock.now();
    this.#failures = [...this.#failures.filter((time) => time > now - kFailureTime), now];
    return this.#failures.length >= (this.#worked.has(codec) ? kFailures : kFailuresAtFirst);
  }
}

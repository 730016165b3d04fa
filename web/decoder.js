/**
 * Turns frames into bitmaps. Decoding is asynchronous and may finish out of order; what comes out never goes back in
 * time: a bitmap that a newer one has overtaken is dropped.
 */
export class Decoder {
  #decode;
  #onPicture;
  #onBroken;
  #epoch = 0;
  #newest = 0;

  /**
   * @param {object} parts
   * @param {(picture: Uint8Array) => Promise<ImageBitmap>} parts.decode
   * @param {(bitmap: ImageBitmap, frame: object) => void} parts.onPicture takes over the bitmap
   * @param {(frame: object) => void} parts.onBroken the picture could not be decoded
   */
  constructor({ decode, onPicture, onBroken }) {
    this.#decode = decode;
    this.#onPicture = onPicture;
    this.#onBroken = onBroken;
  }

  /** Another connection, another count of frames: forgets all that is under way. */
  reset() {
    this.#epoch += 1;
    this.#newest = 0;
  }

  async push(frame) {
    const epoch = this.#epoch;
    let bitmap;
    try {
      bitmap = await this.#decode(frame.picture);
    } catch {
      if (epoch === this.#epoch) this.#onBroken(frame);
      return;
    }
    if (epoch !== this.#epoch || frame.frame <= this.#newest) {
      bitmap.close();
      return;
    }
    this.#newest = frame.frame;
    this.#onPicture(bitmap, frame);
  }
}

/** Decodes a JPEG away from the main thread. */
export function decodeJpeg(picture) {
  return createImageBitmap(new Blob([picture], { type: 'image/jpeg' }));
}

/** Decodes a JPEG away from the main thread. */
export function decodeJpeg({ picture }) {
  return createImageBitmap(new Blob([picture], { type: 'image/jpeg' }));
}

/** Decodes into a VideoFrame: in browsers without a graphics card, this takes a third of the time. */
export async function decodeJpegToFrame({ picture }) {
  const decoder = new ImageDecoder({ type: 'image/jpeg', data: picture, colorSpaceConversion: 'none' });
  try {
    return (await decoder.decode()).image;
  } finally {
    decoder.close();
  }
}

/**
 * Decodes each picture by a function; a decoder as in decoders.js. `decode(picture)` resolves to an image. Images may
 * come in another order than their pictures.
 */
export class IndependentDecoder {
  #decode;
  #onImage;
  #onFailure;
  #closed = false;

  constructor({ onImage, onFailure, decode }) {
    this.#decode = decode;
    this.#onImage = onImage;
    this.#onFailure = onFailure;
  }

  async push(picture) {
    let image;
    try {
      image = await this.#decode(picture);
    } catch (error) {
      if (!this.#closed) this.#onFailure(error, picture);
      return;
    }
    if (this.#closed) image.close();
    else this.#onImage(image, picture);
  }

  close() {
    this.#closed = true;
  }
}

/** BT.601 full range, as raster/yuv_image.h has it. */
const kColours = { primaries: 'smpte170m', transfer: 'smpte170m', matrix: 'smpte170m', fullRange: true };

/** The planes Y, U and V of a picture of DeflateEncoder. Rejects if it is damaged. */
export async function planesOf(bytes) {
  const inflated = new Blob([bytes]).stream().pipeThrough(new DecompressionStream('deflate'));
  const planes = new Uint8Array(await new Response(inflated).arrayBuffer());
  for (let i = 1; i < planes.length; i += 1) planes[i] += planes[i - 1];
  return planes;
}

function toVideoFrame(planes, { width, height }) {
  return new VideoFrame(planes, {
    format: 'I420',
    codedWidth: width,
    codedHeight: height,
    timestamp: 0,
    colorSpace: kColours,
  });
}

/** A decoder as web/picture/decoders.js describes it. */
export class DeflateDecoder {
  #onImage;
  #onFailure;
  #makeImage;
  #closed = false;

  constructor({ onImage, onFailure, makeImage = toVideoFrame }) {
    this.#onImage = onImage;
    this.#onFailure = onFailure;
    this.#makeImage = makeImage;
  }

  async push(picture) {
    let image;
    try {
      image = this.#makeImage(await planesOf(picture.picture), picture);
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

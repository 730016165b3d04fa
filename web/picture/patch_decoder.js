import { IndependentDecoder, decodeJpeg } from './independent_decoder.js';

const kPatchHeaderBytes = 8;

/** The JPEGs of a picture, and the places of their top left corners. Throws if the picture is cut off. */
export function patchesOf(bytes) {
  const view = new DataView(bytes.buffer, bytes.byteOffset, bytes.byteLength);
  const patches = [];
  let at = 0;
  while (at < bytes.length) {
    const begin = at + kPatchHeaderBytes;
    const end = begin <= bytes.length ? begin + view.getUint32(at + 4, true) : Infinity;
    if (end > bytes.length) throw new Error('a patch is cut off');
    patches.push({ left: view.getUint16(at, true), top: view.getUint16(at + 2, true), jpeg: bytes.subarray(begin, end) });
    at = end;
  }
  return patches;
}

/** Pictures of JPEG patches, put together. */
class Patchwork {
  #decode;
  #makeCanvas;
  #whole = null;
  #drawn = null;

  constructor(decode, makeCanvas) {
    this.#decode = decode;
    this.#makeCanvas = makeCanvas;
  }

  /** Resolves to the image of a picture. Each depends on the one before, unless it is independent. */
  async imageOf(picture) {
    return picture.independent ? this.#begin(picture) : this.#continue(picture);
  }

  #begin(picture) {
    this.#whole = picture;
    this.#drawn = null;
    const [{ jpeg }] = patchesOf(picture.picture);
    return this.#decode({ picture: jpeg });
  }

  async #continue(picture) {
    const before = this.#drawn ?? this.#drawWhole();
    this.#drawn = before.then((context) => this.#draw(picture, context));
    const { canvas } = await this.#drawn;
    return createImageBitmap(canvas);
  }

  #drawWhole() {
    const canvas = this.#makeCanvas();
    canvas.width = this.#whole.width;
    canvas.height = this.#whole.height;
    return this.#draw(this.#whole, canvas.getContext('2d', { alpha: false }));
  }

  async #draw({ picture }, context) {
    const patches = patchesOf(picture);
    const images = await Promise.all(patches.map(({ jpeg }) => decodeJpeg({ picture: jpeg })));
    images.forEach((image, i) => {
      context.drawImage(image, patches[i].left, patches[i].top);
      image.close();
    });
    return context;
  }
}

/**
 * Makes a decoder of JPEG patches, as in decoders.js. Independent pictures are decoded as any JPEG is. The first picture
 * that depends on one draws it again, on a hidden canvas that takes the patches, so moving pictures cost no more.
 * `decode({picture})` resolves to the image of a JPEG, `makeCanvas()` makes a hidden canvas.
 */
export function patchDecoder({ decode, makeCanvas, ...parts }) {
  const patchwork = new Patchwork(decode, makeCanvas);
  return new IndependentDecoder({ ...parts, decode: (picture) => patchwork.imageOf(picture) });
}

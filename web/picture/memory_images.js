/**
 * Copies decoded pictures into memory before painting. If the browser paints in software, drawing a VideoFrame of 720
 * lines takes some 17 ms, mostly to convert colours; the browser's conversion into memory takes 1 ms, and painting the
 * copy almost nothing. With a graphics card the reverse holds.
 */
export class MemoryImages {
  #makeData;
  #free = [];
  #works = true;
  #passed = 0;
  #shown = 0;

  /** `makeData(width, height)` makes an ImageData. */
  constructor(makeData = (width, height) => new ImageData(width, height)) {
    this.#makeData = makeData;
  }

  /** Passes the image to `show(image)`, as `{ imageData, close() }` if it is a VideoFrame that can be copied. */
  async pass(image, show) {
    this.#passed += 1;
    const number = this.#passed;
    const copied = await this.#copy(image);
    // A newer copy was faster.
    if (number < this.#shown) {
      copied.close();
      return;
    }
    this.#shown = number;
    show(copied);
  }

  async #copy(image) {
    if (!this.#works || !image.copyTo) return image;
    const { displayWidth: width, displayHeight: height } = image;
    const data = this.#take(width, height);
    try {
      // A browser without the conversion would copy the planes unchanged.
      if (image.allocationSize({ format: 'RGBA' }) !== data.data.byteLength) throw new Error('no conversion');
      await image.copyTo(data.data, { format: 'RGBA' });
    } catch {
      this.#works = false;
      return image;
    }
    image.close();
    return { imageData: data, close: () => this.#free.push(data) };
  }

  /** A buffer of this size, reused if possible. Drops those of other sizes. */
  #take(width, height) {
    this.#free = this.#free.filter((data) => data.width === width && data.height === height);
    return this.#free.pop() ?? this.#makeData(width, height);
  }
}

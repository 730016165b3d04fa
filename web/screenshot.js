/** Browsers still read from the address for a while after the click. Milliseconds. */
const kAddressKeptFor = 60_000;

/** `grove-2026-03-01-174205.png`, by the visitor's clock. */
export function pictureName(date) {
  const two = (value) => String(value).padStart(2, '0');
  const day = [date.getFullYear(), two(date.getMonth() + 1), two(date.getDate())].join('-');
  return `grove-${day}-${two(date.getHours())}${two(date.getMinutes())}${two(date.getSeconds())}.png`;
}

/**
 * What the canvas shows, as a PNG. `draw()` draws it once more in the same task, for a canvas that forgets its picture
 * as soon as the screen has it (WebGL).
 */
export function takePicture(canvas, draw = () => {}) {
  draw();
  return new Promise((resolve, reject) => {
    canvas.toBlob((blob) => (blob ? resolve(blob) : reject(new Error('the canvas gives no picture'))), 'image/png');
  });
}

/**
 * Hands the file to the visitor: as a download, or where the browser has none, to share, or in a page of its own.
 * Resolves to what became of it, in words.
 */
export async function saveFile(window, file) {
  const { document, navigator, URL } = window;
  const link = document.createElement('a');
  if (!('download' in link) && navigator.canShare?.({ files: [file] })) {
    await navigator.share({ files: [file] });
    return 'Picture shared';
  }
  link.href = URL.createObjectURL(file);
  window.setTimeout(() => URL.revokeObjectURL(link.href), kAddressKeptFor);
  if ('download' in link) {
    link.download = file.name;
    link.click();
    return `Picture saved: ${file.name}`;
  }
  link.target = '_blank';
  link.click();
  return 'Picture opened';
}

/** Keeps the present picture as a file, and says so. */
export class Screenshot {
  #take;
  #save;
  #say;

  /**
   * @param {object} parts
   * @param {() => Promise<Blob>} parts.take the present picture
   * @param {(file: File) => Promise<string>} parts.save says what became of it
   * @param {(text: string) => void} parts.say
   */
  constructor({ take, save, say }) {
    this.#take = take;
    this.#save = save;
    this.#say = say;
  }

  async shoot() {
    try {
      const name = pictureName(new Date());
      this.#say(await this.#save(new File([await this.#take()], name, { type: 'image/png' })));
    } catch (error) {
      // The visitor thought better of sharing it.
      if (error.name !== 'AbortError') this.#say('The picture could not be saved.');
    }
  }
}

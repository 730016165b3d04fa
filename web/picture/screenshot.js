import { kPictures } from '../texts.js';

/** Browsers read from the address for some time after the click. Milliseconds. */
const kAddressKeptFor = 60_000;
const kEndings = Object.freeze({ 'image/png': 'png', 'image/jpeg': 'jpg' });

/** `grove-2026-03-01-174205.png`, in the visitor's time. The server's JPEGs end in `.jpg`. */
export function pictureName(date, type = 'image/png') {
  const two = (value) => String(value).padStart(2, '0');
  const day = [date.getFullYear(), two(date.getMonth() + 1), two(date.getDate())].join('-');
  return `grove-${day}-${two(date.getHours())}${two(date.getMinutes())}${two(date.getSeconds())}.${kEndings[type]}`;
}

/** The content of a 2D canvas, on the page or in a worker, as a PNG. */
export function takePicture(canvas) {
  if (canvas.convertToBlob) return canvas.convertToBlob({ type: 'image/png' });
  return new Promise((resolve, reject) => {
    canvas.toBlob((blob) => (blob ? resolve(blob) : reject(new Error('the canvas has no picture'))), 'image/png');
  });
}

/**
 * Gives the file to the visitor: as a download, or in browsers without, shared or in a new page. Resolves to a text
 * about the result.
 */
export async function saveFile(window, file) {
  const { document, navigator, URL } = window;
  const link = document.createElement('a');
  if (!('download' in link) && navigator.canShare?.({ files: [file] })) {
    await navigator.share({ files: [file] });
    return kPictures.shared;
  }
  link.href = URL.createObjectURL(file);
  window.setTimeout(() => URL.revokeObjectURL(link.href), kAddressKeptFor);
  if ('download' in link) {
    link.download = file.name;
    link.click();
    return kPictures.saved(file.name);
  }
  link.target = '_blank';
  link.click();
  return kPictures.opened;
}

/** Saves the current picture as a file, and reports it. */
export class Screenshot {
  #take;
  #save;
  #say;

  /**
   * @param {object} parts
   * @param {() => Promise<Blob>} parts.take the current picture
   * @param {(file: File) => Promise<string>} parts.save resolves to a text about the result
   * @param {(text: string) => void} parts.say
   */
  constructor({ take, save, say }) {
    this.#take = take;
    this.#save = save;
    this.#say = say;
  }

  async shoot() {
    try {
      const picture = await this.#take();
      const { type } = picture;
      this.#say(await this.#save(new File([picture], pictureName(new Date(), type), { type })));
    } catch (error) {
      // The visitor cancelled sharing.
      if (error.name !== 'AbortError') this.#say(kPictures.failed);
    }
  }
}

/**
 * A Storage for workers, which have none: reads a copy of the page's entries and passes each write to `write(key,
 * value)`.
 */
export class RemoteStorage {
  #items;
  #write;

  constructor(items, write) {
    this.#items = new Map(Object.entries(items));
    this.#write = write;
  }

  getItem(key) {
    return this.#items.get(key) ?? null;
  }

  setItem(key, value) {
    this.#items.set(key, value);
    this.#write(key, value);
  }
}

/** A copy of the page's entries; empty if the browser provides no storage. */
export function storedItems(storage) {
  try {
    const kept = storage();
    return Object.fromEntries(Array.from({ length: kept.length }, (_, i) => [kept.key(i), kept.getItem(kept.key(i))]));
  } catch {
    return {};
  }
}

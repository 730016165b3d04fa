import { kDefaultKeys, repairKeys } from '../input/bindings.js';

const kStorageKey = 'grove.settings';
const kMaxNameLength = 32;

const oneOf = (...choices) => (value) => (choices.includes(value) ? value : undefined);
const boolean = (value) => (typeof value === 'boolean' ? value : undefined);

function sensitivity(value) {
  return Number.isFinite(value) ? Math.min(4, Math.max(0.2, value)) : undefined;
}

function name(value) {
  if (typeof value !== 'string') return undefined;
  return [...value.replace(/\p{C}/gu, '').trim()].slice(0, kMaxNameLength).join('');
}

/** The defaults; 0 is no limit. */
export const kDefaults = Object.freeze({
  name: '',
  sensitivity: 1,
  invertY: false,
  codec: 'auto',
  kilobitsPerSecond: 0,
  lines: 0,
  framesPerSecond: 0,
  lateLook: true,
  sound: true,
  keys: kDefaultKeys,
});

/** For each setting: turns any value into a valid one, or `undefined`. */
const kRepairs = {
  name,
  sensitivity,
  invertY: boolean,
  codec: oneOf('auto', 'h264', 'jpeg'),
  kilobitsPerSecond: oneOf(0, 16_000, 8000, 4000, 2000, 1000, 500),
  lines: oneOf(0, 1080, 720, 480, 360),
  framesPerSecond: oneOf(0, 60, 30, 20, 15),
  lateLook: boolean,
  sound: boolean,
  keys: (value) => (value !== null && typeof value === 'object' ? repairKeys(value) : undefined),
};

/** The valid settings in `values`, repaired; omits all others. */
function repaired(values) {
  const entries = Object.keys(kDefaults)
    .filter((key) => Object.hasOwn(Object(values), key))
    .map((key) => [key, kRepairs[key](values[key])]);
  return Object.fromEntries(entries.filter(([, value]) => value !== undefined));
}

const same = (a, b) => JSON.stringify(a) === JSON.stringify(b);

/** A visitor's settings, kept in the browser's storage if it provides any. */
export class Settings {
  #storage;
  #values = kDefaults;
  #isKept = true;
  #listeners = [];

  /** `storage()` returns the Storage. It may throw, as in browsers whose user forbids storage. */
  constructor(storage) {
    this.#storage = storage;
    this.#values = this.#read();
  }

  get values() {
    return this.#values;
  }

  /** Whether the settings outlast the page. */
  get isKept() {
    return this.#isKept;
  }

  /** Calls `listener(values)` after each change. */
  onChange(listener) {
    this.#listeners.push(listener);
  }

  /** Changes some settings; invalid values have no effect. */
  change(values) {
    this.#become({ ...this.#values, ...repaired(values) });
    this.#write();
  }

  reset() {
    this.#become(kDefaults);
    this.#write();
  }

  /** For changes by another page of this browser. */
  reload() {
    this.#become(this.#read());
  }

  #become(values) {
    if (same(values, this.#values)) return;
    this.#values = Object.freeze(values);
    for (const listener of this.#listeners) listener(this.#values);
  }

  #read() {
    try {
      return Object.freeze({ ...kDefaults, ...repaired(JSON.parse(this.#storage().getItem(kStorageKey))) });
    } catch {
      return kDefaults;
    }
  }

  /** Stores only differences from the defaults, so that better defaults reach visitors without a choice. */
  #write() {
    const chosen = Object.entries(this.#values).filter(([key, value]) => !same(value, kDefaults[key]));
    try {
      this.#storage().setItem(kStorageKey, JSON.stringify(Object.fromEntries(chosen)));
      this.#isKept = true;
    } catch {
      this.#isKept = false;
    }
  }
}

/** The settings of the stream. */
export function streamPreferences({ codec, framesPerSecond, kilobitsPerSecond, lines, lateLook }) {
  return { codec, framesPerSecond, kilobitsPerSecond, lines, lateLook };
}

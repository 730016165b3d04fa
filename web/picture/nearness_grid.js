import { ProtocolError } from '../stream/protocol_error.js';

/** Values of the grid are 1 / view depth in steps of this, 1 / metres. */
const kStep = 1 / 64;
const kMax = 127;
const kLengths = 8;

/** Decodes bits of adaptive probability, as BitDecoder of server/stream/late_walk/nearness_code.cpp. */
class BitDecoder {
  #bytes;
  #read = 0;
  #low = 0;
  #high = 0xffffffff;
  #value = 0;

  constructor(bytes) {
    this.#bytes = bytes;
    for (let i = 0; i < 4; i += 1) this.#value = ((this.#value << 8) | this.#next()) >>> 0;
  }

  /** `chances[at]` is the probability of a set bit in 4096ths, and is adapted. Returns 0 or 1. */
  decode(chances, at) {
    const chance = chances[at];
    const middle = this.#low + ((this.#high - this.#low) >>> 12) * Math.min(4064, Math.max(32, chance));
    const isSet = this.#value <= middle;
    if (isSet) {
      this.#high = middle;
      chances[at] = chance + ((4096 - chance) >> 4);
    } else {
      this.#low = middle + 1;
      chances[at] = chance - (chance >> 4);
    }
    while (((this.#low ^ this.#high) & 0xff000000) === 0) {
      this.#low = (this.#low << 8) >>> 0;
      this.#high = ((this.#high << 8) | 0xff) >>> 0;
      this.#value = ((this.#value << 8) | this.#next()) >>> 0;
    }
    return isSet ? 1 : 0;
  }

  get isAtEnd() {
    return this.#bytes.length === this.#read - 4 + (this.#low > 0 ? 1 : 0);
  }

  #next() {
    this.#read += 1;
    return this.#bytes[this.#read - 1] ?? 0;
  }
}

const chances = (count) => new Uint16Array(count).fill(2048);

class ErrorDecoder {
  #bits;
  #isThere = chances(5 * 3);
  #isNegative = chances(5);
  #isLonger = chances(5 * kLengths);
  #suffixes = chances(kLengths * kLengths);

  constructor(bits) {
    this.#bits = bits;
  }

  decode(activity, slope) {
    const calm = activity === 0 ? 0 : activity < 2 ? 1 : activity < 5 ? 2 : activity < 12 ? 3 : 4;
    const steep = slope === 0 ? 0 : slope < 4 ? 1 : 2;
    if (!this.#bits.decode(this.#isThere, calm * 3 + steep)) return 0;
    const isNegative = this.#bits.decode(this.#isNegative, calm);
    let length = 0;
    let size = 1;
    while (length + 1 < kLengths && this.#bits.decode(this.#isLonger, calm * kLengths + length)) {
      size += 1 << length;
      length += 1;
    }
    for (let bit = length - 1; bit >= 0; bit -= 1) {
      size += this.#bits.decode(this.#suffixes, length * kLengths + bit) << bit;
    }
    return isNegative ? -size : size;
  }
}

function median(left, above, corner) {
  if (corner >= Math.max(left, above)) return Math.min(left, above);
  if (corner <= Math.min(left, above)) return Math.max(left, above);
  return left + above - corner;
}

/**
 * Decodes the grid of a Picture message, see PROTOCOL.md: 1 / view depth in 1 / metres at the centres of cells of
 * 16 x 16 pixels, row by row; 0 is infinitely far. Throws ProtocolError for bytes that are no grid of this size.
 */
export function decodeNearness(bytes, columns, rows) {
  const bits = new BitDecoder(bytes);
  const error = new ErrorDecoder(bits);
  const values = new Int16Array(columns * rows);
  const sizes = new Int16Array(columns * rows);
  for (let y = 0; y < rows; y += 1) {
    for (let x = 0; x < columns; x += 1) {
      const at = y * columns + x;
      const hasNext = y > 0 && x + 1 < columns;
      const left = x > 0 ? values[at - 1] : y > 0 ? values[at - columns] : 0;
      const above = y > 0 ? values[at - columns] : left;
      const corner = x > 0 && y > 0 ? values[at - columns - 1] : above;
      const next = hasNext ? values[at - columns + 1] : above;
      const activity =
        (x > 0 ? sizes[at - 1] : 0) + (y > 0 ? sizes[at - columns] : 0) + (hasNext ? sizes[at - columns + 1] : 0);
      const change = error.decode(activity, Math.abs(left - above) + Math.abs(above - next));
      const value = median(left, above, corner) + change;
      if (value < 0 || value > kMax) throw new ProtocolError('a nearness is out of range');
      values[at] = value;
      sizes[at] = Math.abs(change);
    }
  }
  if (!bits.isAtEnd) throw new ProtocolError('the grid of nearness has a wrong length');
  return Float32Array.from(values, (value) => value * kStep);
}

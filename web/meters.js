/** Values of the last `span` milliseconds. Times are milliseconds on any one clock. */
export class SlidingWindow {
  #span;
  #entries = [];

  constructor(span = 1000) {
    this.#span = span;
  }

  add(time, value) {
    this.#entries.push({ time, value });
    this.#forget(time);
  }

  values(now) {
    this.#forget(now);
    return this.#entries.map((entry) => entry.value);
  }

  clear() {
    this.#entries = [];
  }

  #forget(now) {
    const first = this.#entries.findIndex((entry) => entry.time > now - this.#span);
    if (first !== 0) this.#entries.splice(0, first < 0 ? this.#entries.length : first);
  }
}

export function median(values) {
  if (values.length === 0) return null;
  const sorted = [...values].sort((a, b) => a - b);
  const middle = sorted.length >> 1;
  return sorted.length % 2 ? sorted[middle] : (sorted[middle - 1] + sorted[middle]) / 2;
}

/** Inputs that may wait for their frame; the server shows them in order, so the oldest go first when it stalls. */
const kMostWaiting = 512;

/** Time from sending an input to presenting the first frame that shows it, in milliseconds. */
export class LatencyMeter {
  #waiting = [];
  #samples = new SlidingWindow();
  #last = null;

  sent(number, now) {
    this.#waiting.push({ number, time: now });
    if (this.#waiting.length > kMostWaiting) this.#waiting.shift();
  }

  presented(lastInput, now) {
    while (this.#waiting.length > 0 && this.#waiting[0].number <= lastInput) {
      this.#last = now - this.#waiting.shift().time;
      this.#samples.add(now, this.#last);
    }
  }

  /** Median of the last second; if nothing was measured in it, the last measurement, and `null` before the first. */
  read(now) {
    return median(this.#samples.values(now)) ?? this.#last;
  }

  reset() {
    this.#waiting = [];
    this.#samples.clear();
    this.#last = null;
  }
}

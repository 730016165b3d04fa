/** Values of the last `span` milliseconds; all times are milliseconds by one clock. */
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

/** The quantile at `share` (0..1) by nearest rank; `null` without values. */
export function quantile(values, share) {
  return quantiles(values, [share])[0];
}

function quantiles(values, shares) {
  const sorted = [...values].sort((a, b) => a - b);
  return shares.map((share) => sorted[Math.max(0, Math.ceil(share * sorted.length) - 1)] ?? null);
}

/** Percentiles need more values than one second has. Milliseconds. */
const kLongSpan = 10_000;

/** Inputs that may wait for their frame. The server shows them in order, so the oldest are dropped if it stalls. */
const kMaxWaiting = 512;

/** The latency: milliseconds from sending an input to presenting the first frame that shows it. */
export class LatencyMeter {
  #waiting = [];
  #received = 0;
  #samples = new SlidingWindow();
  #longSamples = new SlidingWindow(kLongSpan);
  #last = null;

  sent(number, now) {
    this.#waiting.push({ number, time: now });
    if (this.#waiting.length > kMaxWaiting) this.#waiting.shift();
  }

  /** A frame that shows all inputs up to this one has arrived. */
  received(lastInput) {
    this.#received = lastInput;
  }

  /** The screen shows all inputs that were sent before `until`, by a turn or movement of an older picture. */
  moved(until, now) {
    for (const input of this.#waiting) if (input.time < until) input.shown ??= now;
  }

  /**
   * Returns the inputs that this frame shows first, as `{ number, time, latency, screen }`; `screen`: milliseconds from
   * sending the input until the screen showed it, by this frame or by a turn or movement of an older one.
   */
  presented(lastInput, now) {
    const shown = [];
    while (this.#waiting.length > 0 && this.#waiting[0].number <= lastInput) {
      const { number, time, shown: moved = now } = this.#waiting.shift();
      this.#last = now - time;
      this.#samples.add(now, this.#last);
      this.#longSamples.add(now, this.#last);
      shown.push({ number, time, latency: this.#last, screen: moved - time });
    }
    return shown;
  }

  /** The server applied all inputs up to this one. Those without a frame changed nothing, so they are not measured. */
  obeyed(lastInput) {
    this.#waiting = this.#waiting.filter(({ number }) => number <= this.#received || number > lastInput);
  }

  /** Median of the last second; without values in it, the last value; `null` before the first. */
  read(now) {
    return median(this.#samples.values(now)) ?? this.#last;
  }

  /** Of the last ten seconds; each `null` without values. */
  percentiles(now) {
    const [p50, p95, p99] = quantiles(this.#longSamples.values(now), [0.5, 0.95, 0.99]);
    return { p50, p95, p99 };
  }

  reset() {
    this.#waiting = [];
    this.#received = 0;
    this.#samples.clear();
    this.#longSamples.clear();
    this.#last = null;
  }
}

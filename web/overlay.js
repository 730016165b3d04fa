import { perUser } from './amortization.js';
import { kUnknown, known, milliseconds, percent, plain, visitors, whole } from './figures.js';
import { LimitedBy } from './protocol.js';

/** Readable numbers change a few times a second, not with every frame. Milliseconds. */
const kInterval = 250;

/** What each line says about a reading; `null` where it is not known yet. */
const kLines = {
  fps: (reading) => String(reading.framesPerSecond),
  latency: (reading) => reading.latencyMs !== null && `${reading.latencyMs.toFixed(0)} ms`,
  percentiles: ({ latencyPercentiles: { p50, p95, p99 } }) =>
    p50 !== null && `${[p50, p95, p99].map((value) => value.toFixed(0)).join(' / ')} ms`,
  rate: (reading) => `${reading.megabitsPerSecond.toFixed(1)} Mbit/s`,
  codec: (reading) => reading.codec,
  size: (reading) => reading.width !== null && `${reading.width} \u00d7 ${reading.height}`,
  visitors: (reading) => reading.visitors !== null && String(reading.visitors),
  shared: (reading) => reading.sharedViews !== null && `${Math.round(reading.sharedViews * 100)} %`,
  server: (reading) => reading.serverMs !== null && `${reading.serverMs.toFixed(1)} ms`,
  version: (reading) => reading.version,
};

const kLimits = {
  [LimitedBy.nothing]: 'nothing',
  [LimitedBy.line]: 'your line',
  [LimitedBy.machine]: 'the server is busy',
  [LimitedBy.browser]: 'your browser is busy',
  [LimitedBy.visitor]: 'your settings',
};

/** What each line says of where a picture's time goes; a server before 1.3 does not tell its part. */
const kPlaces = {
  queued: ({ times }) => times && milliseconds(times.queued),
  drawn: ({ times }) => times && milliseconds(times.drawn),
  encoded: ({ times }) => times && milliseconds(times.encoded),
  socket: ({ times }) => times && milliseconds(times.socket),
  line: ({ times }) => times && milliseconds(times.line),
  decoded: ({ decodeMs }) => milliseconds(decodeMs),
  painted: ({ paintMs }) => milliseconds(paintMs),
};

/** What each line says of how the stream fits the line, as the server tells it. */
const kStatus = {
  limit: ({ limitedBy }) => kLimits[limitedBy],
  goal: ({ framesPerSecond }) => `${framesPerSecond} frames/s`,
  quality: ({ quality }) => `${quality} %`,
  carries: ({ kilobitsPerSecond }) => kilobitsPerSecond > 0 && `${plain(kilobitsPerSecond / 1000)} Mbit/s`,
  roundTrip: ({ roundTripMilliseconds }) => `${roundTripMilliseconds} ms`,
};

const told = (value, tell) => known(value) !== null && tell(value);

/** What each line says about what sharing saves; a line that is not told of is not there. */
const kSavings = {
  alpha: ({ alpha }) => told(alpha, percent),
  beta: ({ beta }) => told(beta, percent),
  everybody: ({ acrossUser }) => told(acrossUser, milliseconds),
  visitor: (amortization) => told(perUser(amortization), milliseconds),
  cost: ({ visitorCores }) => told(visitorCores, (cores) => `${plain(cores)} cores`),
  fit: ({ visitorsFit }) => told(visitorsFit, visitors),
  private: ({ isPrivate, privateVisitorsFit }) => !isPrivate && told(privateVisitorsFit, atMost),
  mode: ({ isPrivate }) => isPrivate && 'off',
};

const atMost = (count) => (count === 0 ? 'none' : `at most ${whole(count)}`);

/** The small panel of figures; hidden until it is asked for. */
export class Overlay {
  #panel;
  #button;
  #read;
  #watch;
  #timer;

  /**
   * `panel` has an element with `data-figure`, `data-status`, `data-place` or `data-saving` for each line; `read()` gives a reading
   * of Telemetry and WorldStatistics, and `lateLook`, what becomes of that; `watch(shown)` is told when the panel appears and goes.
   */
  constructor(panel, button, read, watch) {
    this.#panel = panel;
    this.#button = button;
    this.#read = read;
    this.#watch = watch;
    button.addEventListener('click', () => this.toggle());
  }

  toggle() {
    const shown = this.#panel.hidden;
    this.#panel.hidden = !shown;
    this.#button.setAttribute('aria-pressed', String(shown));
    clearInterval(this.#timer);
    this.#watch(shown);
    if (!shown) return;
    this.#write();
    this.#timer = setInterval(() => this.#write(), kInterval);
  }

  #write() {
    const reading = this.#read();
    for (const figure of this.#panel.querySelectorAll('[data-figure]')) {
      figure.textContent = kLines[figure.dataset.figure](reading) || kUnknown;
    }
    const { status, lateLook, amortization } = reading;
    const stream = this.#panel.querySelector('[data-line]');
    stream.hidden = status === null;
    for (const figure of status === null ? [] : stream.querySelectorAll('[data-status]')) {
      const { status: name } = figure.dataset;
      figure.textContent = (name === 'lateLook' ? lateLook : kStatus[name](status)) || kUnknown;
    }
    for (const figure of this.#panel.querySelectorAll('[data-place]')) {
      figure.textContent = kPlaces[figure.dataset.place](reading) || kUnknown;
    }
    this.#panel.querySelector('[data-savings]').hidden = amortization === null;
    if (amortization === null) return;
    for (const figure of this.#panel.querySelectorAll('[data-saving]')) {
      const text = kSavings[figure.dataset.saving](amortization) || '';
      figure.textContent = text;
      figure.parentElement.hidden = text === '';
    }
  }
}

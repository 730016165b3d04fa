import { perUser } from '../amortization.js';
import { bitRate, kUnknown, known, milliseconds, percent, plain, visitors, whole } from '../figures.js';
import { LimitedBy } from '../stream/protocol.js';
import { kRows, kStatistics } from '../texts.js';

/** Readable numbers change a few times a second, not with every frame. Milliseconds. */
const kInterval = 250;

const kLimits = {
  [LimitedBy.nothing]: kStatistics.limits.nothing,
  [LimitedBy.line]: kStatistics.limits.line,
  [LimitedBy.machine]: kStatistics.limits.machine,
  [LimitedBy.browser]: kStatistics.limits.browser,
  [LimitedBy.visitor]: kStatistics.limits.visitor,
};

const ofStatus = (textOf) => ({ status }) => status !== null && textOf(status);
/** Servers before 1.3 do not send Times. */
const ofTimes = (part) => ({ times }) => times && milliseconds(times[part]);
const ofSharing = (textOf) => ({ amortization }) => amortization !== null && textOf(amortization);
const ifKnown = (value, textOf) => known(value) !== null && textOf(value);
const atMost = (count) => (count === 0 ? kStatistics.noVisitors : kStatistics.atMost(whole(count)));

/** The text of each row, from a reading; falsy if unknown. */
const kFigures = {
  fps: (reading) => kStatistics.framesPerSecond(reading.framesPerSecond),
  latency: (reading) => reading.latencyMs !== null && `${reading.latencyMs.toFixed(0)} ms`,
  quality: ofStatus(({ quality }) => `${quality} %`),
  limit: ofStatus(({ limitedBy }) => kLimits[limitedBy]),

  percentiles: ({ latencyPercentiles: { p50, p95, p99 } }) =>
    p50 !== null && `${[p50, p95, p99].map((value) => value.toFixed(0)).join(' / ')} ms`,
  rate: (reading) => bitRate(reading.megabitsPerSecond),
  codec: (reading) => reading.codec,
  size: (reading) => reading.width !== null && `${reading.width} \u00d7 ${reading.height}`,
  visitors: (reading) => reading.visitors !== null && String(reading.visitors),
  shared: (reading) => reading.sharedViews !== null && `${Math.round(reading.sharedViews * 100)} %`,
  server: (reading) => reading.serverMs !== null && `${reading.serverMs.toFixed(1)} ms`,
  version: (reading) => reading.version,

  goal: ofStatus(({ framesPerSecond }) => kStatistics.framesPerSecond(framesPerSecond)),
  carries: ofStatus(({ kilobitsPerSecond }) => kilobitsPerSecond > 0 && bitRate(kilobitsPerSecond / 1000)),
  roundTrip: ofStatus(({ roundTripMilliseconds }) => `${roundTripMilliseconds} ms`),
  lateLook: ({ lateLook }) => lateLook,

  queued: ofTimes('queued'),
  drawn: ofTimes('drawn'),
  encoded: ofTimes('encoded'),
  socket: ofTimes('socket'),
  line: ofTimes('line'),
  decoded: ({ decodeMs }) => milliseconds(decodeMs),
  painted: ({ paintMs }) => milliseconds(paintMs),

  alpha: ofSharing(({ alpha }) => ifKnown(alpha, percent)),
  beta: ofSharing(({ beta }) => ifKnown(beta, percent)),
  everybody: ofSharing(({ acrossUser }) => ifKnown(acrossUser, milliseconds)),
  visitor: ofSharing((amortization) => ifKnown(perUser(amortization), milliseconds)),
  cost: ofSharing(({ visitorCores }) => ifKnown(visitorCores, (cores) => kStatistics.cores(plain(cores)))),
  fit: ofSharing(({ visitorsFit }) => ifKnown(visitorsFit, visitors)),
  private: ofSharing(({ privateVisitorsFit }) => ifKnown(privateVisitorsFit, atMost)),
};

function addRows(list, { label, rows }) {
  const { ownerDocument: document } = list;
  list.setAttribute('aria-label', label);
  for (const [name, [term, about]] of Object.entries(rows)) {
    const row = list.appendChild(document.createElement('div'));
    if (about) row.title = about;
    row.appendChild(document.createElement('dt')).textContent = term;
    row.appendChild(document.createElement('dd')).dataset.figure = name;
  }
}

/** The panel of statistics, with expert figures below the simple ones; hidden at first. */
export class Overlay {
  #panel;
  #button;
  #read;
  #watch;
  #timer;

  /**
   * `panel` has a list with `data-rows` for each list in kRows. `read()` returns a reading of Telemetry and
   * WorldStatistics, with `lateLook`, its state. The overlay calls `watch(shown)` when it opens and closes.
   */
  constructor(panel, button, read, watch) {
    this.#panel = panel;
    this.#button = button;
    this.#read = read;
    this.#watch = watch;
    for (const [name, rows] of Object.entries(kRows)) addRows(this.#list(name), rows);
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

  #list(name) {
    return this.#panel.querySelector(`[data-rows=${name}]`);
  }

  #write() {
    const reading = this.#read();
    for (const figure of this.#panel.querySelectorAll('[data-figure]')) {
      figure.textContent = kFigures[figure.dataset.figure](reading) || kUnknown;
    }
    this.#list('line').hidden = reading.status === null;
    this.#list('savings').hidden = reading.amortization === null;
    // Older servers report fewer of these.
    for (const row of this.#list('savings').children) row.hidden = row.lastChild.textContent === kUnknown;
  }
}

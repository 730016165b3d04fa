import { windowOf } from '../picture/look_geometry.js';
import { LatencyMeter, SlidingWindow, median } from './meters.js';
import { kCodecNames } from './protocol.js';

/** The overlay's figures: collected with each frame, read a few times a second. Times in milliseconds. */
export class Telemetry {
  #presented = new SlidingWindow();
  #received = new SlidingWindow();
  #server = new SlidingWindow();
  #decode = new SlidingWindow();
  #paint = new SlidingWindow();
  #latency = new LatencyMeter();
  #frames = 0;
  #last = null;
  #status = null;
  #times = null;

  inputSent(number, now) {
    this.#latency.sent(number, now);
  }

  frameReceived(frame, now) {
    this.#received.add(now, frame.picture.byteLength);
    this.#latency.received(frame.lastInput);
  }

  statusReceived(status) {
    this.#status = status;
    if (this.#last) this.#last = { ...this.#last, visitors: status.visitors };
    this.#latency.obeyed(status.lastInput);
  }

  /** The time that server and line take, from the message Times. */
  timesReceived(times) {
    this.#times = times;
  }

  /** A frame on the screen was turned or moved, and shows all inputs that were sent before `until`. */
  frameMoved(until, now) {
    this.#latency.moved(until, now);
  }

  /** Returns the inputs that the frame shows first, as `{ number, time, latency, screen }`. */
  framePresented(frame, now, paint = 0) {
    this.#frames += 1;
    this.#last = frame;
    this.#presented.add(now, 1);
    this.#server.add(now, frame.serverMicroseconds / 1000);
    this.#decode.add(now, frame.decode ?? 0);
    this.#paint.add(now, paint);
    return this.#latency.presented(frame.lastInput, now);
  }

  /** For a new connection: it counts inputs anew, and its line is unknown. */
  reset() {
    this.#latency.reset();
    this.#status = null;
    this.#times = null;
  }

  /** Unknown figures are `null`. */
  read(now) {
    const size = this.#last && windowOf(this.#last);
    return {
      frames: this.#frames,
      framesPerSecond: this.#presented.values(now).length,
      latencyMs: this.#latency.read(now),
      megabitsPerSecond: (this.#received.values(now).reduce((sum, bytes) => sum + bytes, 0) * 8) / 1e6,
      serverMs: median(this.#server.values(now)),
      codec: this.#last && kCodecNames[this.#last.codec],
      width: size && size.width,
      height: size && size.height,
      visitors: this.#last && this.#last.visitors,
      decodeMs: median(this.#decode.values(now)),
      paintMs: median(this.#paint.values(now)),
      times: this.#times,
      status: this.#status,
    };
  }

  /** Of the last ten seconds; not part of read(), because it sorts them all. */
  latencyPercentiles(now) {
    return this.#latency.percentiles(now);
  }
}

/** The reading before the first picture. */
export const kNoReading = Object.freeze({
  ...new Telemetry().read(0),
  latencyPercentiles: { p50: null, p95: null, p99: null },
  lateLook: '',
});

import { LatencyMeter, SlidingWindow, median } from './meters.js';
import { kCodecNames } from './protocol.js';

/** What the overlay tells: collected frame by frame, read a few times a second. Times in milliseconds. */
export class Telemetry {
  #presented = new SlidingWindow();
  #received = new SlidingWindow();
  #server = new SlidingWindow();
  #latency = new LatencyMeter();
  #frames = 0;
  #last = null;

  inputSent(number, now) {
    this.#latency.sent(number, now);
  }

  frameReceived(frame, now) {
    this.#received.add(now, frame.picture.byteLength);
  }

  framePresented(frame, now) {
    this.#frames += 1;
    this.#last = frame;
    this.#presented.add(now, 1);
    this.#server.add(now, frame.serverMicroseconds / 1000);
    this.#latency.presented(frame.lastInput, now);
  }

  /** Another connection counts its inputs anew. */
  reset() {
    this.#latency.reset();
  }

  /** Figures that are not known yet are `null`. */
  read(now) {
    return {
      frames: this.#frames,
      framesPerSecond: this.#presented.values(now).length,
      latencyMs: this.#latency.read(now),
      megabitsPerSecond: (this.#received.values(now).reduce((sum, bytes) => sum + bytes, 0) * 8) / 1e6,
      serverMs: median(this.#server.values(now)),
      codec: this.#last && kCodecNames[this.#last.codec],
      width: this.#last && this.#last.width,
      height: this.#last && this.#last.height,
      visitors: this.#last && this.#last.visitors,
    };
  }
}

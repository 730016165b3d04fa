/** A long pause between two frames (a hidden page) must not spin the view. Seconds. */
const kLongestStep = 0.1;

/** Turns the view smoothly, frame by frame, while keys or sticks turn it. */
export class Turner {
  #controls;
  #requestFrame;
  #running = false;
  #last;

  /** `requestFrame(callback)` calls back with the time in milliseconds. */
  constructor(controls, requestFrame) {
    this.#controls = controls;
    this.#requestFrame = requestFrame;
    controls.onChange(() => this.#wake());
  }

  #wake() {
    if (this.#running || !this.#controls.turning) return;
    this.#running = true;
    this.#requestFrame((time) => {
      this.#last = time;
      this.#step(time);
    });
  }

  #step(time) {
    const { turning } = this.#controls;
    if (!turning) {
      this.#running = false;
      return;
    }
    const seconds = Math.min((time - this.#last) / 1000, kLongestStep);
    this.#last = time;
    this.#requestFrame((next) => this.#step(next));
    this.#controls.look(turning.yaw * seconds, turning.pitch * seconds);
  }
}

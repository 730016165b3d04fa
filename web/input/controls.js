/** The max pitch, up or down, in radians; the server's limit, too. */
export const kMaxPitch = 1.5;

/**
 * The state of the visitor's controls, from all input devices. Each holder of keys has a name, so that two ways to walk
 * forward do not end each other. Angles are radians; yaw grows to the left, pitch upwards.
 */
export class Controls {
  #held = new Map();
  #turns = new Map();
  #yaw = 0;
  #pitch = 0;
  #steering = { sensitivity: 1, invertY: false };
  #listeners = [];

  /** Calls `listener()` after each change. */
  onChange(listener) {
    this.#listeners.push(listener);
  }

  get keys() {
    let keys = 0;
    for (const key of this.#held.values()) keys |= key;
    return keys;
  }

  get yaw() {
    return this.#yaw;
  }

  get pitch() {
    return this.#pitch;
  }

  /** The sum of all turns, in radians a second; `null` if there are none. */
  get turning() {
    if (this.#turns.size === 0) return null;
    const sum = { yaw: 0, pitch: 0 };
    for (const turn of this.#turns.values()) {
      sum.yaw += turn.yaw;
      sum.pitch += turn.pitch;
    }
    return sum;
  }

  /** Sets the bits of Key (protocol.js) that `holder` holds; 0 releases them. */
  hold(holder, key) {
    if ((this.#held.get(holder) ?? 0) === key) return;
    if (key === 0) this.#held.delete(holder);
    else this.#held.set(holder, key);
    this.#changed();
  }

  release(holder) {
    this.hold(holder, 0);
  }

  /** Sets the rate at which `holder` turns the view; two zeros end it. */
  turn(holder, yaw, pitch) {
    if (yaw === 0 && pitch === 0) {
      if (!this.#turns.delete(holder)) return;
    } else {
      this.#turns.set(holder, { yaw, pitch });
    }
    this.#changed();
  }

  releaseAll() {
    if (this.#held.size === 0 && this.#turns.size === 0) return;
    this.#held.clear();
    this.#turns.clear();
    this.#changed();
  }

  /** Settings of steer() and steerAt(): turn `sensitivity` times as far, and up for down if `invertY`. */
  setSteering({ sensitivity, invertY }) {
    this.#steering = { sensitivity, invertY };
  }

  /** Turns the view by a movement of mouse or finger; setSteering() scales it. */
  steer(yaw, pitch) {
    this.look(...this.#steered(yaw, pitch));
  }

  /** As turn(), for a stick. */
  steerAt(holder, yaw, pitch) {
    this.turn(holder, ...this.#steered(yaw, pitch));
  }

  /** Turns the view by these angles. */
  look(yaw, pitch) {
    this.face(this.#yaw + yaw, this.#pitch + pitch);
  }

  /** Turns the view to these angles. */
  face(yaw, pitch) {
    if (!Number.isFinite(yaw) || !Number.isFinite(pitch)) return;
    // Within half a turn of 0, where 32-bit floats are precise.
    const wrapped = yaw - 2 * Math.PI * Math.round(yaw / (2 * Math.PI));
    const clamped = Math.min(kMaxPitch, Math.max(-kMaxPitch, pitch));
    if (wrapped === this.#yaw && clamped === this.#pitch) return;
    this.#yaw = wrapped;
    this.#pitch = clamped;
    this.#changed();
  }

  #steered(yaw, pitch) {
    const { sensitivity, invertY } = this.#steering;
    return [yaw * sensitivity, pitch * (invertY ? -sensitivity : sensitivity)];
  }

  #changed() {
    for (const listener of this.#listeners) listener();
  }
}

/** As far up or down as a visitor can look, in radians; the server's limit too. */
export const kMaxPitch = 1.5;

/**
 * The state of a visitor's controls, whatever moves them. Keys are held under the name of what holds them, so that two
 * ways to walk forward do not end each other; angles in radians, yaw growing to the left and pitch upwards.
 */
export class Controls {
  #held = new Map();
  #turns = new Map();
  #yaw = 0;
  #pitch = 0;
  #steering = { sensitivity: 1, invertY: false };
  #listeners = [];

  /** `listener()` is called after every change. */
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

  /** Sum of what turns the view by itself, in radians a second, or `null` if nothing does. */
  get turning() {
    if (this.#turns.size === 0) return null;
    const sum = { yaw: 0, pitch: 0 };
    for (const turn of this.#turns.values()) {
      sum.yaw += turn.yaw;
      sum.pitch += turn.pitch;
    }
    return sum;
  }

  /** `holder` now holds the bits `key` of protocol.js's Key, instead of what it held before; 0 lets go. */
  hold(holder, key) {
    if ((this.#held.get(holder) ?? 0) === key) return;
    if (key === 0) this.#held.delete(holder);
    else this.#held.set(holder, key);
    this.#changed();
  }

  release(holder) {
    this.hold(holder, 0);
  }

  /** `holder` turns the view at this rate from now on; two zeros end it. */
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

  /** How a hand's movements turn the view: `sensitivity` times as far, and up for down if `invertY`. */
  setSteering({ sensitivity, invertY }) {
    this.#steering = { sensitivity, invertY };
  }

  /** Turns the view by the movement of a mouse or a finger that is worth these angles. */
  steer(yaw, pitch) {
    this.look(...this.#steered(yaw, pitch));
  }

  /** As turn(), for a stick that a hand pushes. */
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
    // Within half a turn of 0, where 32-bit floats are fine.
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

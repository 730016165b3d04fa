import { rests, walked } from './walking.js';

/** The prediction bridges a gap of the line of this length beyond the usual age of pictures. Milliseconds. */
const kBridged = 300;
/** The longest predicted walk (ms): beyond it, too much of the window would be invented. */
const kLongestWalk = 700;
/** Share of a new picture in the usual age. */
const kAgeShare = 0.1;
/** Obstacles farther away than this (metres) are out of reach of a predicted walk. */
const kReach = 5;
/** Walks are predicted in parts of this length (ms), to notice when they end. */
const kPart = 100;
/** Time constant of a correction (ms). */
const kCorrection = 100;
/** A larger correction (metres) is no error of a prediction: the server has moved the visitor. */
const kTeleport = 1;
/** Smaller displacements (metres) move nothing by a pixel. */
const kTiny = 1e-3;
/** Others go on as in the picture for so long (ms): a page with late walk gets at least 10 pictures a second. */
const kOthersGoOn = 100;
/** Inputs of which no picture is known yet. */
const kMaxInputs = 512;

const kNowhere = Object.freeze([0, 0, 0]);
/** The view stays with the picture's own eye. */
export const kNoMovement = Object.freeze({ displacement: kNowhere, elapsed: 0, until: -Infinity, isMoving: false });

function near(ground, [x, , z]) {
  const isNear = (obstacle) => Math.hypot(obstacle.x - x, obstacle.z - z) < obstacle.radius + kReach;
  return { ...ground, obstacles: ground.obstacles.filter(isNear) };
}

/**
 * Predicts where the visitor is now, ahead of the pictures: by the server's rules of walking, from where the
 * server knew them and the inputs that the picture does not show yet. Times are milliseconds by the page's clock.
 */
export class Prediction {
  #ground = null;
  #inputs = [];
  #space = null;
  /** When the picture came to the screen. */
  #begin = 0;
  #origin = null;
  #near = null;
  #age = null;
  #offset = kNowhere;
  #offsetTime = 0;

  /** For a new connection. */
  reset() {
    this.#ground = null;
    this.#inputs = [];
    this.#space = null;
    this.#origin = null;
    this.#age = null;
  }

  /** Without the message Ground nobody moves. */
  setGround(ground) {
    this.#ground = ground;
  }

  inputSent({ number, keys, yaw }, now) {
    this.#inputs.push({ number, keys, yaw, time: now });
    // The first one is the origin of the picture on the screen.
    if (this.#inputs.length > kMaxInputs) this.#inputs.splice(1, 1);
  }

  /**
   * The movement from the eye of the picture on the screen, for a picture that shows the inputs up to `lastInput`;
   * `space` as in the message Picture.
   *
   * @returns {{displacement: number[], elapsed: number, until: number, isMoving: boolean}} metres along x, y and z, zeros
   *     at rest; includes all inputs sent before `until`; `elapsed`: time for which the picture's moving parts have gone
   *     on (ms); `isMoving`: a later call gives another one
   */
  moved({ space, lastInput }, now) {
    if (!space || !this.#ground) return kNoMovement;
    if (space !== this.#space) this.#take(space, lastInput, now);
    const elapsed = space.moving.length > 0 ? Math.min(kOthersGoOn, now - this.#begin) : 0;
    const goOn = space.moving.length > 0 && elapsed < kOthersGoOn;
    if (!this.#origin) return { ...kNoMovement, elapsed, isMoving: goOn };
    const { position, until, isWalking } = this.#walk(now);
    const offset = this.#offsetAt(now);
    const displacement = position.map((value, i) => value + offset[i] - space.eye[i]);
    const isTiny = Math.hypot(...displacement) < kTiny;
    return {
      displacement: isTiny ? kNowhere : displacement,
      elapsed,
      until,
      isMoving: goOn || isWalking || Math.hypot(...offset) >= kTiny,
    };
  }

  /** Goes on from another picture, without a jump. */
  #take(space, lastInput, now) {
    const before = this.#origin && this.#walk(now).position;
    const offset = this.#offsetAt(now);
    const first = this.#inputs.findIndex(({ number }) => number === lastInput);
    this.#space = space;
    this.#begin = now;
    this.#origin = null;
    this.#offset = kNowhere;
    if (first < 0) return;
    this.#inputs.splice(0, first);
    this.#origin = { position: space.visitor, velocity: space.velocity, time: this.#inputs[0].time + space.sinceInput };
    this.#near = near(this.#ground, space.visitor);
    this.#grow(now - this.#origin.time);
    if (!before) return;
    const after = this.#walk(now).position;
    const change = before.map((value, i) => value + offset[i] - after[i]);
    if (Math.hypot(...change) <= kTeleport) this.#offset = change;
    this.#offsetTime = now;
  }

  #grow(age) {
    const sample = Math.min(kLongestWalk, Math.max(0, age));
    this.#age = this.#age === null ? sample : this.#age + kAgeShare * (sample - this.#age);
  }

  #offsetAt(now) {
    const share = Math.exp((this.#offsetTime - now) / kCorrection);
    return this.#offset.map((value) => value * share);
  }

  /**
   * The visitor's state now. Standing still takes nothing of the time that may be predicted, because no picture comes
   * from a world where nothing changes.
   */
  #walk(now) {
    let state = this.#origin;
    let { time } = this.#origin;
    let left = Math.min(kLongestWalk, this.#age + kBridged);
    let input;
    for (let i = 0; i < this.#inputs.length; i += 1) {
      input = this.#inputs[i];
      const end = Math.min(now, this.#inputs[i + 1]?.time ?? now);
      while (time < end && !rests(state, input)) {
        if (left <= 0) return { position: state.position, until: time, isWalking: false };
        const span = Math.min(left, kPart, end - time);
        state = walked(this.#near, state, input, span / 1000);
        time += span;
        left -= span;
      }
      time = Math.max(time, end);
    }
    return { position: state.position, until: now, isWalking: !rests(state, input) };
  }
}

import { Key } from '../stream/protocol.js';
import { stickKeys } from './stick.js';

/** Radians per CSS pixel of finger movement. */
const kLookScale = 0.0045;
/** The stick's full deflection, in CSS pixels. */
const kStickRadius = 56;
/** A finger that rests this long (ms), within this far (CSS pixels), blows until it lifts. */
const kLongPress = 450;
const kRestSlack = 10;
const kWalkHolder = 'touch stick';
const kBlowHolder = 'touch press';

/** A finger on the left half walks. `stick` (an element around a knob) shows its position. */
class WalkingFinger {
  #controls;
  #stick;
  #x;
  #y;

  constructor(event, controls, stick) {
    this.#controls = controls;
    this.#stick = stick;
    this.#x = event.clientX;
    this.#y = event.clientY;
    stick.style.translate = `${this.#x}px ${this.#y}px`;
    stick.hidden = false;
    this.move(event);
  }

  move(event) {
    let x = (event.clientX - this.#x) / kStickRadius;
    let y = (event.clientY - this.#y) / kStickRadius;
    const scale = 1 / Math.max(1, Math.hypot(x, y));
    x *= scale;
    y *= scale;
    this.#stick.firstElementChild.style.translate = `${x * kStickRadius}px ${y * kStickRadius}px`;
    this.#controls.hold(kWalkHolder, stickKeys(x, y));
  }

  end() {
    this.#stick.hidden = true;
    this.#controls.release(kWalkHolder);
  }
}

/** A finger on the right half looks. After a rest it blows, and movements aim. */
class LookingFinger {
  #controls;
  #x;
  #y;
  #way = 0;
  #timer;

  constructor(event, controls) {
    this.#controls = controls;
    this.#x = event.clientX;
    this.#y = event.clientY;
    this.#timer = setTimeout(() => controls.hold(kBlowHolder, Key.blow), kLongPress);
  }

  move(event) {
    const [x, y] = [event.clientX - this.#x, event.clientY - this.#y];
    this.#x = event.clientX;
    this.#y = event.clientY;
    this.#way += Math.hypot(x, y);
    if (this.#way > kRestSlack) clearTimeout(this.#timer);
    this.#controls.steer(-x * kLookScale, -y * kLookScale);
  }

  end() {
    clearTimeout(this.#timer);
    this.#controls.release(kBlowHolder);
  }
}

/** One finger of each kind at a time: one thumb walks, the other looks. */
export function listenToTouch(canvas, controls, stick) {
  const fingers = new Map();
  const has = (kind) => [...fingers.values()].some((finger) => finger instanceof kind);

  canvas.addEventListener('pointerdown', (event) => {
    if (event.pointerType === 'mouse') return;
    const kind = event.clientX < canvas.clientWidth / 2 ? WalkingFinger : LookingFinger;
    if (has(kind)) return;
    canvas.setPointerCapture(event.pointerId);
    fingers.set(event.pointerId, new kind(event, controls, stick));
  });
  canvas.addEventListener('pointermove', (event) => fingers.get(event.pointerId)?.move(event));
  for (const end of ['pointerup', 'pointercancel']) {
    canvas.addEventListener(end, (event) => {
      fingers.get(event.pointerId)?.end();
      fingers.delete(event.pointerId);
    });
  }
}

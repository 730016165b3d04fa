import { Key } from '../stream/protocol.js';

/** Radians per pixel of mouse movement. */
const kLookScale = 0.0023;
/** A press with more movement (CSS pixels) is a drag, not a click. */
const kClickSlack = 8;
const kBlowHolder = 'mouse';

/**
 * Requests the pointer, without the system's acceleration if the browser supports that. Resolves to whether the browser
 * grants it. Older Safari returns nothing, so only `pointerlockchange` shows it.
 */
async function lockPointer(canvas) {
  try {
    await canvas.requestPointerLock({ unadjustedMovement: true });
    return true;
  } catch (error) {
    if (error.name !== 'NotSupportedError') return false;
  }
  try {
    await canvas.requestPointerLock();
    return true;
  } catch {
    return false;
  }
}

/**
 * A click locks the pointer; then the mouse looks, and its held button blows. Dragging looks without the lock. Calls
 * `onLock(state)` with `locked`, `free` or `refused`.
 */
export function listenToMouse(canvas, controls, onLock) {
  const { ownerDocument: document } = canvas;
  const isLocked = () => document.pointerLockElement === canvas;
  let pressedBy = '';
  let dragging = false;
  let way = 0;

  const follow = (event) => {
    if (event.pointerType !== 'mouse') return;
    // A second button reports no press of its own, only a change of `buttons`.
    controls.hold(kBlowHolder, isLocked() && event.buttons & 1 ? Key.blow : 0);
    if (event.type !== 'pointermove') return;
    way += Math.hypot(event.movementX, event.movementY);
    if (isLocked() || dragging) controls.steer(-event.movementX * kLookScale, -event.movementY * kLookScale);
  };

  canvas.addEventListener('pointerdown', (event) => {
    pressedBy = event.pointerType;
    way = 0;
    if (pressedBy === 'mouse' && event.button === 0 && !isLocked()) {
      dragging = true;
      canvas.setPointerCapture(event.pointerId);
    }
    follow(event);
  });
  canvas.addEventListener('pointermove', follow);
  for (const end of ['pointerup', 'pointercancel']) {
    document.addEventListener(end, (event) => {
      dragging = false;
      follow(event);
    });
  }
  canvas.addEventListener('click', async () => {
    if (isLocked() || pressedBy !== 'mouse' || way > kClickSlack) return;
    if (!(await lockPointer(canvas))) onLock('refused');
  });
  canvas.addEventListener('contextmenu', (event) => event.preventDefault());
  document.addEventListener('pointerlockchange', () => {
    dragging = false;
    controls.release(kBlowHolder);
    onLock(isLocked() ? 'locked' : 'free');
  });
}

import { Key } from '../protocol.js';

/** By place on the keyboard, not by letter, so that the hand finds them on every layout. */
const kHeldKeys = {
  KeyW: Key.forward,
  ArrowUp: Key.forward,
  KeyS: Key.back,
  ArrowDown: Key.back,
  KeyA: Key.left,
  ArrowLeft: Key.left,
  KeyD: Key.right,
  ArrowRight: Key.right,
  ShiftLeft: Key.run,
  ShiftRight: Key.run,
  Space: Key.blow,
};

/** Radians a second. */
const kTurnRate = 1.6;
const kTurnKeys = {
  KeyQ: [kTurnRate, 0],
  KeyE: [-kTurnRate, 0],
  PageUp: [0, kTurnRate],
  PageDown: [0, -kTurnRate],
};

/** A focused button keeps its own keys. */
function belongsToButton(event) {
  return event.code === 'Space' && Boolean(event.target.closest?.('button'));
}

/**
 * Walks, turns and blows by keys, and runs `shortcuts`: functions by the key's lower-case name (`event.key`). All keys
 * are let go when the window loses the keyboard.
 */
export function listenToKeyboard(window, controls, shortcuts) {
  window.addEventListener('keydown', (event) => {
    if (event.ctrlKey || event.altKey || event.metaKey || belongsToButton(event)) return;
    const shortcut = shortcuts[event.key?.toLowerCase()];
    if (event.code in kHeldKeys) controls.hold(event.code, kHeldKeys[event.code]);
    else if (event.code in kTurnKeys) controls.turn(event.code, ...kTurnKeys[event.code]);
    else if (!shortcut) return;
    else if (!event.repeat) shortcut();
    event.preventDefault();
  });
  window.addEventListener('keyup', (event) => {
    // macOS sends no keyup for what was held together with the command key.
    if (event.key === 'Meta') controls.releaseAll();
    controls.release(event.code);
    controls.turn(event.code, 0, 0);
  });
  window.addEventListener('blur', () => controls.releaseAll());
  window.document.addEventListener('visibilitychange', () => {
    if (window.document.hidden) controls.releaseAll();
  });
}

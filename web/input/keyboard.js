import { Key } from '../stream/protocol.js';
import { actionOf } from './bindings.js';

/** Radians a second. */
const kTurnRate = 1.6;
const kTurns = {
  turnLeft: [kTurnRate, 0],
  turnRight: [-kTurnRate, 0],
  lookUp: [0, kTurnRate],
  lookDown: [0, -kTurnRate],
};

/** A focused button keeps the space bar; selects and text fields keep all keys. */
function belongsToPage({ code, target }) {
  if (target.closest?.('select, input:not([type=checkbox], [type=range])')) return true;
  return code === 'Space' && Boolean(target.closest?.('button, input'));
}

/** Within a panel, keys scroll and move sliders instead of walking. A closing panel keeps the focus for a moment. */
function isInPanel({ target }) {
  return Boolean(target.closest?.('dialog[open]'));
}

/**
 * Walks, turns and blows by keys, and runs `shortcuts`: functions by action (bindings.js). `keys()` returns the current
 * bindings. Releases all keys when the window loses the keyboard.
 */
export function listenToKeyboard(window, controls, keys, shortcuts) {
  window.addEventListener('keydown', (event) => {
    if (event.ctrlKey || event.altKey || event.metaKey || belongsToPage(event)) return;
    const action = actionOf(keys(), event.code);
    if (!action) return;
    if (action in shortcuts) {
      if (!event.repeat) shortcuts[action]();
    } else if (isInPanel(event)) {
      return;
    } else if (action in kTurns) {
      controls.turn(event.code, ...kTurns[action]);
    } else {
      controls.hold(event.code, Key[action]);
    }
    event.preventDefault();
  });
  window.addEventListener('keyup', (event) => {
    // macOS sends no keyup for keys held together with the command key.
    if (event.key === 'Meta') controls.releaseAll();
    controls.release(event.code);
    controls.turn(event.code, 0, 0);
  });
  window.addEventListener('blur', () => controls.releaseAll());
  window.document.addEventListener('visibilitychange', () => {
    if (window.document.hidden) controls.releaseAll();
  });
}

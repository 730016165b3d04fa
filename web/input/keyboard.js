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

/** A focused button keeps the key that presses it, and a field that is typed into keeps all. */
function belongsToPage({ code, target }) {
  if (target.closest?.('select, input:not([type=checkbox], [type=range])')) return true;
  return code === 'Space' && Boolean(target.closest?.('button, input'));
}

/** Keys scroll a panel and move its sliders: nobody walks from within one. One that closes has the focus a moment longer. */
function isInPanel({ target }) {
  return Boolean(target.closest?.('dialog[open]'));
}

/**
 * Walks, turns and blows by keys, and runs `shortcuts`: functions by the action of bindings.js. `keys()` gives the
 * bindings of now. All keys are let go when the window loses the keyboard.
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

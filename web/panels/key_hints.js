import { kActions, kKeys } from '../texts.js';

/** In the format of aria-keyshortcuts: F3 O PageUp. */
function shortcuts(codes, labels) {
  return codes
    .filter(Boolean)
    .map((code) => (labels.label(code).length === 1 ? labels.label(code) : code))
    .join(' ');
}

/**
 * Writes the current keys into elements with `data-keys`, an action or `walking`, and into the tips of buttons with
 * `data-shortcut`, their action.
 */
export function writeKeyHints(document, keys, labels) {
  for (const element of document.querySelectorAll('[data-keys]')) {
    const action = element.dataset.keys;
    element.textContent = action === 'walking' ? labels.walking(keys) : labels.names(keys[action]);
  }
  for (const button of document.querySelectorAll('[data-shortcut]')) {
    const codes = keys[button.dataset.shortcut];
    button.title = kKeys.tip(kActions[button.dataset.shortcut], labels.names(codes));
    button.setAttribute('aria-keyshortcuts', shortcuts(codes, labels));
  }
}

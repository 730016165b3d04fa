import { kActions, kKeys } from '../texts.js';

/** As aria-keyshortcuts has it: F3 O PageUp. */
function shortcuts(codes, labels) {
  return codes
    .filter(Boolean)
    .map((code) => (labels.label(code).length === 1 ? labels.label(code) : code))
    .join(' ');
}

/**
 * Writes the keys of now wherever the page names them: elements with `data-keys`, an action or `walking`, and buttons
 * with `data-shortcut`, the action that they do.
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

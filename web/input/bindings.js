/**
 * The keys of each action: two places on the keyboard (`KeyboardEvent.code`, the same place on every layout), '' for
 * none. No key has two actions.
 */
export const kDefaultKeys = Object.freeze({
  forward: ['KeyW', 'ArrowUp'],
  back: ['KeyS', 'ArrowDown'],
  left: ['KeyA', 'ArrowLeft'],
  right: ['KeyD', 'ArrowRight'],
  run: ['ShiftLeft', 'ShiftRight'],
  blow: ['Space', ''],
  turnLeft: ['KeyQ', ''],
  turnRight: ['KeyE', ''],
  lookUp: ['PageUp', ''],
  lookDown: ['PageDown', ''],
  figures: ['KeyO', 'F3'],
  settings: ['KeyP', ''],
  people: ['KeyV', ''],
  screenshot: ['KeyC', ''],
  latency: ['KeyL', ''],
  fullscreen: ['KeyF', ''],
});

export const kSlots = 2;

/** Keys of the browser and the system, keys that navigate in the page, and keys without a keyup. */
const kReserved =
  /^(Escape|Tab|Enter|NumpadEnter|(Control|Alt|Meta|OS)(Left|Right)|ContextMenu|CapsLock|F5|F11|F12)$/;
const kCode = /^[A-Z][A-Za-z0-9]{1,30}$/;

export function isBindable(code) {
  return kCode.test(code) && !kReserved.test(code) && code !== 'Unidentified';
}

/** The key's action, or `undefined`. */
export function actionOf(keys, code) {
  return code ? Object.keys(keys).find((action) => keys[action].includes(code)) : undefined;
}

/** Binds `code` to this slot of `action`. The former action of `code` gets the slot's former key. */
export function rebind(keys, action, slot, code) {
  const former = keys[action][slot];
  const next = Object.fromEntries(
    Object.entries(keys).map(([name, codes]) => [name, codes.map((each) => (each === code ? former : each))]),
  );
  next[action][slot] = code;
  return next;
}

/** Repairs stored keys, perhaps of another version of the page. Actions with invalid keys get their defaults. */
export function repairKeys(stored) {
  const isList = (codes) => Array.isArray(codes) && codes.every((code) => code === '' || isBindable(code));
  const own = (action) => Object.hasOwn(Object(stored), action) && isList(stored[action]) && stored[action];
  const actions = Object.keys(kDefaultKeys);
  const taken = new Set();
  const keys = {};
  // The visitor's choice has priority over a default with the same key.
  for (const action of [...actions.filter(own), ...actions.filter((name) => !own(name))]) {
    const codes = own(action) || kDefaultKeys[action];
    keys[action] = Array.from({ length: kSlots }, (_, slot) => {
      const code = codes[slot] ?? '';
      if (taken.has(code)) return '';
      if (code) taken.add(code);
      return code;
    });
  }
  return Object.fromEntries(actions.map((action) => [action, keys[action]]));
}

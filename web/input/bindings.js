/**
 * Which keys do what: for each action two places on the keyboard (`KeyboardEvent.code`, so that the hand finds them on
 * every layout), '' where there is none. No key does two things.
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

/** The browser's and the system's own, those that move about the page, and those that never tell when they are let go. */
const kReserved =
  /^(Escape|Tab|Enter|NumpadEnter|(Control|Alt|Meta|OS)(Left|Right)|ContextMenu|CapsLock|F5|F11|F12)$/;
const kCode = /^[A-Z][A-Za-z0-9]{1,30}$/;

export function isBindable(code) {
  return kCode.test(code) && !kReserved.test(code) && code !== 'Unidentified';
}

/** What the key does, or `undefined`. */
export function actionOf(keys, code) {
  return code ? Object.keys(keys).find((action) => keys[action].includes(code)) : undefined;
}

/** `code` now does `action`, in this of its slots. What `code` did before gets the slot's former key for it. */
export function rebind(keys, action, slot, code) {
  const former = keys[action][slot];
  const next = Object.fromEntries(
    Object.entries(keys).map(([name, codes]) => [name, codes.map((each) => (each === code ? former : each))]),
  );
  next[action][slot] = code;
  return next;
}

/** Keys as they were stored, perhaps by another version of the page: what cannot be is replaced, action by action. */
export function repairKeys(stored) {
  const isList = (codes) => Array.isArray(codes) && codes.every((code) => code === '' || isBindable(code));
  const own = (action) => Object.hasOwn(Object(stored), action) && isList(stored[action]) && stored[action];
  const actions = Object.keys(kDefaultKeys);
  const taken = new Set();
  const keys = {};
  // The visitor's own choice goes before a default of the same key.
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

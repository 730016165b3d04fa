import { isBindable, kSlots, rebind } from '../input/bindings.js';
import { kActions, kKeys } from '../texts.js';

/** The text about another action whose keys have changed, too; '' if there is none. */
export function consequence(before, after, action, labels) {
  const other = Object.keys(after).find((name) => name !== action && after[name].join() !== before[name].join());
  return other ? kKeys.also(kActions[other], labels.names(after[other])) : '';
}

/** The table of keys in the settings: a click on one of its buttons, then a key, binds that key to the action. */
export class KeyEditor {
  #settings;
  #labels;
  #say;
  #buttons = new Map();
  #waiting = null;
  #taken = '';

  /**
   * @param {HTMLTableSectionElement} body takes the rows
   * @param {import('./settings.js').Settings} settings
   * @param {import('../input/key_labels.js').KeyLabels} labels
   * @param {(text: string) => void} say writes to a live region
   */
  constructor(body, settings, labels, say) {
    this.#settings = settings;
    this.#labels = labels;
    this.#say = say;
    for (const [action, name] of Object.entries(kActions)) this.#addRow(body, action, name);
    settings.onChange(() => this.write());
    this.write();
  }

  /** Shows the current keys. */
  write() {
    for (const [button, { action, slot }] of this.#buttons) {
      const code = this.#settings.values.keys[action][slot];
      const name = code ? this.#labels.name(code) : kKeys.emptySlot;
      button.textContent = code ? this.#labels.label(code) : '\u2013';
      button.setAttribute('aria-label', kKeys.ofSlot(kActions[action], kKeys.slots[slot], name));
    }
  }

  #addRow(body, action, name) {
    const row = body.insertRow();
    const head = document.createElement('th');
    head.scope = 'row';
    head.textContent = name;
    row.append(head);
    for (let slot = 0; slot < kSlots; slot += 1) {
      const button = document.createElement('button');
      button.type = 'button';
      button.addEventListener('click', () => this.#await(button));
      button.addEventListener('keydown', (event) => this.#take(button, event));
      button.addEventListener('keyup', (event) => this.#release(event));
      button.addEventListener('blur', () => this.#stop(button));
      this.#buttons.set(button, { action, slot });
      row.insertCell().append(button);
    }
  }

  #await(button) {
    this.#waiting = button;
    // Safari does not focus a clicked button.
    button.focus();
    button.classList.add('waiting');
    button.textContent = kKeys.wait;
    this.#say(kKeys.press(kActions[this.#buttons.get(button).action]));
  }

  #stop(button) {
    if (this.#waiting !== button) return;
    this.#waiting = null;
    button.classList.remove('waiting');
    this.write();
  }

  #take(button, event) {
    if (this.#waiting !== button) return;
    event.preventDefault();
    event.stopPropagation();
    if (event.repeat) return;
    this.#taken = event.code;
    this.#labels.learn(event);
    const { action, slot } = this.#buttons.get(button);
    if (event.code === 'Escape') {
      this.#say(kKeys.kept(kActions[action]));
    } else if (!isBindable(event.code)) {
      this.#say(kKeys.reserved);
      return;
    } else {
      this.#bind(action, slot, event.code);
    }
    this.#stop(button);
  }

  /** A bound space bar would also press the button: in Firefox, even after preventDefault() on its keydown. */
  #release(event) {
    if (event.code === this.#taken) event.preventDefault();
    this.#taken = '';
  }

  #bind(action, slot, code) {
    const before = this.#settings.values.keys;
    this.#settings.change({ keys: rebind(before, action, slot, code) });
    const after = this.#settings.values.keys;
    const rest = consequence(before, after, action, this.#labels);
    this.#say(kKeys.bound(kActions[action], this.#labels.name(code)) + rest);
  }
}

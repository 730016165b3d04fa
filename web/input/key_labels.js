import { kKeys } from '../texts.js';

const kArrows = { ArrowUp: '\u2191', ArrowLeft: '\u2190', ArrowDown: '\u2193', ArrowRight: '\u2192' };

/** Labels of these keys if the layout is unknown. */
const kMarks = {
  Backquote: '`', Minus: '-', Equal: '=', BracketLeft: '[', BracketRight: ']', Backslash: '\\', IntlBackslash: '<',
  Semicolon: ';', Quote: "'", Comma: ',', Period: '.', Slash: '/',
};

const kWalking = ['forward', 'left', 'back', 'right'];

/** The labels of the visitor's keys, from the keyboard's layout or from key presses. */
export class KeyLabels {
  #marks = new Map();

  /** Requests the keyboard's layout. In browsers without it, key presses show the labels. */
  async ask(navigator) {
    try {
      for (const [code, mark] of await navigator.keyboard.getLayoutMap()) this.#marks.set(code, mark);
    } catch {
      // The browser has no such interface, or refuses it.
    }
  }

  /** Takes a label from a keyboard event. Returns whether it is new. */
  learn(event) {
    const { code, key } = event;
    const isMark = key?.length === 1 && key !== ' ' && !event.shiftKey && !event.getModifierState?.('AltGraph');
    if (!isMark || !code || this.label(code) === capital(key)) return false;
    this.#marks.set(code, key);
    return true;
  }

  /** Short, as on the key: W, \u2191, space. */
  label(code) {
    return kArrows[code] ?? this.name(code);
  }

  /** For reading aloud: W, up arrow, space. */
  name(code) {
    if (kKeys.names[code]) return kKeys.names[code];
    const mark = this.#marks.get(code) ?? kMarks[code];
    if (mark) return capital(mark);
    // KeyW, Digit1, Numpad7, ControlLeft, F3.
    const words = code.replace(/^(Key|Digit)/, '').replace(/([a-z])(?=[A-Z0-9])/g, '$1 ');
    return words.length === 1 || /^F\d+$/.test(words) ? words : words.toLowerCase();
  }

  /** All keys of one action in a sentence: `O or F3`. */
  names(codes) {
    const known = codes.filter(Boolean);
    if (known.length === 2 && known.every((code) => code.startsWith('Shift'))) return kKeys.shift;
    return known.map((code) => this.name(code)).join(kKeys.or) || kKeys.none;
  }

  /** The keys to walk with: `WASD or arrows`. */
  walking(keys) {
    const rows = [0, 1].map((slot) => kWalking.map((action) => keys[action][slot]));
    const words = rows.map((codes) => {
      if (codes.join() === 'ArrowUp,ArrowLeft,ArrowDown,ArrowRight') return kKeys.arrows;
      const labels = codes.filter(Boolean).map((code) => this.label(code));
      return labels.join(labels.every((label) => label.length === 1) ? '' : ' ');
    });
    return words.filter(Boolean).join(kKeys.or) || kKeys.none;
  }
}

/** As it is printed on the key; a few letters have no capital of one character. */
function capital(mark) {
  const upper = mark.toUpperCase();
  return upper.length === mark.length ? upper : mark;
}

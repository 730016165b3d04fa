import { bitRate, kUnknown } from '../figures.js';
import { kChoices, kSettings, kStatistics } from '../texts.js';

/** Time between updates of the line about the stream. Milliseconds. */
const kInterval = 500;

/** The current stream, from a reading of Telemetry. */
export function streamInWords({ codec, width, height, framesPerSecond, megabitsPerSecond }) {
  if (width === null) return kUnknown;
  const parts = [codec, `${width} \u00d7 ${height}`, kStatistics.framesPerSecond(framesPerSecond)];
  return [...parts, bitRate(megabitsPerSecond)].join(', ');
}

/** The control's value in the setting's type. */
function valueOf(control, setting) {
  if (control.type === 'checkbox') return control.checked;
  return typeof setting === 'number' ? Number(control.value) : control.value;
}

function addChoices(select) {
  const option = (value, text) => Object.assign(select.ownerDocument.createElement('option'), { value, text });
  select.append(...kChoices[select.dataset.setting].map(([value, text]) => option(value, text)));
}

/** The visitor's settings: a panel beside the world or, without room there, over it. Changes take effect at once. */
export class SettingsPanel {
  #dialog;
  #button;
  #settings;
  #read;
  #narrow;
  #timer;

  /**
   * @param {object} parts
   * @param {HTMLDialogElement} parts.dialog has a control with `data-setting` for each setting but the keys; gets the
   *     choices here
   * @param {HTMLButtonElement} parts.button opens and closes it; hidden if the browser has no dialogs
   * @param {import('./settings.js').Settings} parts.settings
   * @param {() => object} parts.read a reading of Telemetry
   * @param {MediaQueryList} parts.narrow whether there is no room beside the world
   */
  constructor({ dialog, button, settings, read, narrow }) {
    this.#dialog = dialog;
    this.#button = button;
    this.#settings = settings;
    this.#read = read;
    this.#narrow = narrow;
    for (const select of dialog.querySelectorAll('select')) addChoices(select);
    button.hidden = !dialog.show;
    button.addEventListener('click', () => this.toggle());
    dialog.querySelector('[data-close]').addEventListener('click', () => dialog.close());
    dialog.querySelector('[data-reset]').addEventListener('click', () => this.#reset());
    dialog.addEventListener('close', () => this.#closed());
    dialog.addEventListener('input', ({ target }) => this.#take(target));
    dialog.addEventListener('focusout', () => this.#write());
    settings.onChange(() => this.#write());
    this.#listen(dialog.ownerDocument);
    this.#write();
  }

  toggle() {
    if (this.#dialog.open) this.#dialog.close();
    else if (this.#dialog.show) this.#open();
  }

  /** Writes to the panel's live region. */
  say(text) {
    this.#dialog.querySelector('[role=status]').textContent = text;
  }

  /** Disables a setting, or one `option` of it, because this browser cannot fulfil it; shows the reason. */
  disable(setting, reason, option = null) {
    const control = this.#control(setting);
    if (option === null) {
      control.disabled = true;
      this.#dialog.querySelector(`#${control.getAttribute('aria-describedby')}`).textContent = reason;
    } else {
      const choice = control.querySelector(`option[value="${option}"]`);
      choice.disabled = true;
      choice.textContent = kSettings.unavailable(choice.textContent, reason);
    }
  }

  /** Disables a setting for now, and shows the reason; '' enables it again. */
  explain(setting, reason) {
    const control = this.#control(setting);
    const words = this.#dialog.querySelector(`#${control.getAttribute('aria-describedby')}`);
    words.dataset.about ??= words.textContent;
    control.disabled = reason !== '';
    words.textContent = reason || words.dataset.about;
  }

  #control(setting) {
    return this.#dialog.querySelector(`[data-setting=${setting}]`);
  }

  /** Browsers close only modal dialogs on Escape. A visitor who locks the pointer is done with the panel. */
  #listen(document) {
    document.addEventListener('keydown', (event) => {
      if (event.code === 'Escape' && this.#dialog.open) this.#dialog.close();
    });
    document.addEventListener('pointerlockchange', () => {
      if (document.pointerLockElement && this.#dialog.open) this.#dialog.close();
    });
  }

  #open() {
    const { ownerDocument: document } = this.#dialog;
    if (document.pointerLockElement) document.exitPointerLock();
    if (this.#narrow.matches) this.#dialog.showModal();
    else this.#dialog.show();
    this.#button.setAttribute('aria-expanded', 'true');
    this.#tell();
    this.#timer = setInterval(() => this.#tell(), kInterval);
  }

  #closed() {
    clearInterval(this.#timer);
    this.say('');
    this.#button.setAttribute('aria-expanded', 'false');
  }

  #take(control) {
    const { setting } = control.dataset;
    this.#settings.change({ [setting]: valueOf(control, this.#settings.values[setting]) });
    const { isKept } = this.#settings;
    this.say(isKept ? '' : kSettings.notKept);
  }

  #reset() {
    this.#settings.reset();
    this.say(kSettings.reset);
  }

  #write() {
    const { values } = this.#settings;
    for (const control of this.#dialog.querySelectorAll('[data-setting]')) {
      const value = values[control.dataset.setting];
      if (control.type === 'checkbox') control.checked = value;
      // Text is repaired after typing, not during it.
      else if (control.type !== 'text' || control !== control.ownerDocument.activeElement) control.value = value;
    }
    const times = values.sensitivity.toFixed(1);
    this.#dialog.querySelector('output').textContent = `\u00d7 ${times}`;
    this.#control('sensitivity').setAttribute('aria-valuetext', kSettings.times(times));
  }

  #tell() {
    this.#dialog.querySelector('[data-stream]').textContent = streamInWords(this.#read());
  }
}

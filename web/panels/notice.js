import { kStates, kWaiting } from '../texts.js';

/** The text in the middle of the page while there is no live picture. */
export class Notice {
  #element;
  #title;
  #text;
  #progress;
  #button;

  /** `onAction()` runs when the visitor presses the notice's button. */
  constructor(element, onAction) {
    this.#element = element;
    this.#title = element.querySelector('[data-notice=title]');
    this.#text = element.querySelector('[data-notice=text]');
    this.#progress = element.querySelector('progress');
    this.#button = element.querySelector('button');
    this.#button.addEventListener('click', onAction);
  }

  show(state, reason) {
    const { title, text, next, action } = kStates[state];
    this.#say(title, [text ?? sentence(reason), next].filter(Boolean).join(' '));
    this.#progress.hidden = true;
    this.#button.textContent = action ?? '';
    this.#button.hidden = !action;
    this.#element.hidden = false;
  }

  /** Progress as in the message Waiting. */
  wait({ percent, step }) {
    this.#say(kWaiting.title, step ? `${capitalised(step)}\u2026` : kWaiting.moment);
    // Not in the text: screen readers would read out every percent.
    this.#progress.hidden = false;
    this.#progress.value = percent;
    this.#button.hidden = true;
    this.#element.hidden = false;
  }

  hide() {
    this.#element.hidden = true;
  }

  /** Writes only changed texts, because screen readers read out each write. */
  #say(title, text) {
    if (this.#title.textContent !== title) this.#title.textContent = title;
    if (this.#text.textContent !== text) this.#text.textContent = text;
  }
}

function capitalised(text) {
  return text[0].toUpperCase() + text.slice(1);
}

/** A close reason as a sentence. */
function sentence(reason) {
  if (!reason) return kWaiting.noReason;
  const capital = capitalised(reason);
  return /[.!?]$/.test(capital) ? capital : `${capital}.`;
}

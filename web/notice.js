/** What a visitor reads in each state of the connection; `open` needs no words. */
const kTexts = {
  connecting: { title: 'Grove', text: 'Entering the grove\u2026' },
  lost: { title: 'The world is out of reach', text: 'Trying again\u2026' },
  full: {
    title: 'The world is full',
    text: 'Everyone it has room for is inside already. We knock again every fifteen seconds.',
    action: 'Try again now',
  },
  outdated: { title: 'The world has moved on', text: 'Please reload the page to follow.', action: 'Reload' },
  refused: { title: 'The world let go', action: 'Try again' },
};

/** The words in the middle of the page while there is no living picture. */
export class Notice {
  #element;
  #title;
  #text;
  #button;

  /** `onAction()` runs when the visitor presses the notice's button. */
  constructor(element, onAction) {
    this.#element = element;
    this.#title = element.querySelector('[data-notice=title]');
    this.#text = element.querySelector('[data-notice=text]');
    this.#button = element.querySelector('button');
    this.#button.addEventListener('click', onAction);
  }

  show(state, reason) {
    const { title, text, action } = kTexts[state];
    this.#title.textContent = title;
    this.#text.textContent = text ?? sentence(reason);
    this.#button.textContent = action ?? '';
    this.#button.hidden = !action;
    this.#element.hidden = false;
  }

  hide() {
    this.#element.hidden = true;
  }
}

/** A close reason as a sentence. */
function sentence(reason) {
  if (!reason) return 'It gave no reason.';
  const capital = reason[0].toUpperCase() + reason.slice(1);
  return /[.!?]$/.test(capital) ? capital : `${capital}.`;
}

/** What a visitor reads in each state of the connection; `open` needs no words. */
const kTexts = {
  connecting: { title: 'Grove', text: 'Entering the grove\u2026' },
  silent: { title: 'The world does not answer\u2026', text: 'What you see may be out of date.' },
  lost: { title: 'The world is out of reach', text: 'Trying again\u2026' },
  full: { title: 'No place for you yet', next: 'We knock again every fifteen seconds.', action: 'Try again now' },
  away: { title: 'Your place was given away', next: 'Trying to enter again\u2026', action: 'Try again now' },
  outdated: { title: 'The world has moved on', text: 'Please reload the page to follow.', action: 'Reload' },
  refused: { title: 'The world let go', action: 'Try again' },
};

/** The words in the middle of the page while there is no living picture. */
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
    const { title, text, next, action } = kTexts[state];
    this.#say(title, [text ?? sentence(reason), next].filter(Boolean).join(' '));
    this.#progress.hidden = true;
    this.#button.textContent = action ?? '';
    this.#button.hidden = !action;
    this.#element.hidden = false;
  }

  /** How the wait for the world gets on, or, once one is in, for one of one's own; as in the message Waiting. */
  wait({ place, percent, step, isIn }) {
    const title = isIn ? 'Your world is being made' : 'The world is being made';
    if (place === 1) this.#say(title, step ? `${capitalised(step)}\u2026` : 'A moment\u2026');
    else this.#say(`Place ${place} in line`, `Everyone gets a world of their own here. ${before(place - 1)}`);
    // Not among the words: a screen reader would say every percent of it.
    this.#progress.hidden = place !== 1;
    this.#progress.value = percent;
    this.#button.hidden = true;
    this.#element.hidden = false;
  }

  hide() {
    this.#element.hidden = true;
  }

  /** What stays the same is left alone, or it would be read out again. */
  #say(title, text) {
    if (this.#title.textContent !== title) this.#title.textContent = title;
    if (this.#text.textContent !== text) this.#text.textContent = text;
  }
}

function before(visitors) {
  return visitors === 1 ? 'One visitor is before you.' : `${visitors} visitors are before you.`;
}

function capitalised(text) {
  return text[0].toUpperCase() + text.slice(1);
}

/** A close reason as a sentence. */
function sentence(reason) {
  if (!reason) return 'It gave no reason.';
  const capital = capitalised(reason);
  return /[.!?]$/.test(capital) ? capital : `${capital}.`;
}

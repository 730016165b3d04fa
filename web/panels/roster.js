import { kPeople } from '../texts.js';

/** The page's address for others, without the visitor's own name. */
export function sharedLink({ href }) {
  const url = new URL(href);
  for (const own of ['name', 'latency']) url.searchParams.delete(own);
  url.hash = '';
  return url.href;
}

/** The panel that lists the visitors and copies the link to this world. Hidden at first. */
export class Roster {
  #panel;
  #button;
  #people;
  #say;
  #othersWereLost = false;

  /**
   * @param {object} parts
   * @param {HTMLElement} parts.panel has a list, and a button with `data-copy`
   * @param {HTMLButtonElement} parts.button opens and closes it
   * @param {import('./people.js').People} parts.people
   * @param {(text: string) => Promise<void>} parts.copy rejects where the browser refuses
   * @param {() => string} parts.link
   * @param {(text: string) => void} parts.say
   */
  constructor({ panel, button, people, copy, link, say }) {
    this.#panel = panel;
    this.#button = button;
    this.#people = people;
    this.#say = say;
    button.addEventListener('click', () => this.toggle());
    panel.querySelector('[data-copy]').addEventListener('click', async () => {
      try {
        await copy(link());
        say(kPeople.copied);
      } catch {
        say(kPeople.notCopied(link()));
      }
    });
    people.onChange(() => this.#write());
  }

  toggle() {
    this.#panel.hidden = !this.#panel.hidden;
    this.#button.setAttribute('aria-pressed', String(!this.#panel.hidden));
  }

  #write() {
    const { all, self, othersAreLost } = this.#people;
    if (othersAreLost !== this.#othersWereLost) this.#say(othersAreLost ? kPeople.lost : kPeople.found);
    this.#othersWereLost = othersAreLost;
    this.#panel.querySelector('[data-lost]').hidden = !othersAreLost;
    this.#panel.querySelector('h2').textContent = kPeople.here(all.length);
    const rows = all.map(({ visitor, name, colour }) => {
      const row = this.#panel.ownerDocument.createElement('li');
      row.style.setProperty('--who', colour);
      const text = row.appendChild(this.#panel.ownerDocument.createElement('bdi'));
      text.textContent = name;
      if (visitor === self) row.append(kPeople.self);
      return row;
    });
    this.#panel.querySelector('ul').replaceChildren(...rows);
  }
}

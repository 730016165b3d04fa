/** The world's visitors, as in the newest message People. */
export class People {
  #people = new Map();
  #listeners = [];

  /** The server's number of the page's visitor; `null` before the first Welcome. */
  self = null;

  /** Visitors on other servers of this world are out of reach. */
  othersAreLost = false;

  /** Calls `listener()` after each change. */
  onChange(listener) {
    this.#listeners.push(listener);
  }

  /** Applies the message People. */
  update({ othersAreLost, people }) {
    this.othersAreLost = othersAreLost;
    this.#people = new Map(
      people.map(({ visitor, red, green, blue, name }) => [visitor, { visitor, name, colour: `rgb(${red} ${green} ${blue})` }]),
    );
    for (const listener of this.#listeners) listener();
  }

  /** Name and colour of a visitor, or `undefined`. */
  find(visitor) {
    return this.#people.get(visitor);
  }

  /** All visitors: the page's own first, the others in order of arrival. */
  get all() {
    const isSelf = ({ visitor }) => visitor === this.self;
    const all = [...this.#people.values()];
    return [...all.filter(isSelf), ...all.filter((person) => !isSelf(person))];
  }
}

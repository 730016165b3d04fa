/** Who is here, as the server told last. */
export class People {
  #people = new Map();
  #listeners = [];

  /** Oneself, by the server's number; `null` before the first welcome. */
  self = null;

  /** Visitors of other servers that show this world are out of reach. */
  othersAreLost = false;

  /** `listener()` hears of every change. */
  onChange(listener) {
    this.#listeners.push(listener);
  }

  /** Takes over the message People. */
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

  /** All of them, oneself first, the others in the order in which they came. */
  get all() {
    const isSelf = ({ visitor }) => visitor === this.self;
    const all = [...this.#people.values()];
    return [...all.filter(isSelf), ...all.filter((person) => !isSelf(person))];
  }
}

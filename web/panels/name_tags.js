import { coverPlace, liftsOf } from './name_layout.js';

/**
 * Visitors' names over the picture, in the browser's fonts, which cover every script. They follow the shown frame, and
 * move apart if they would overlap. Names are plain text, never HTML.
 */
export class NameTags {
  #element;
  #people;
  #tags = new Map();
  #shown = { labels: [], width: 1, height: 1 };

  /**
   * @param {HTMLElement} element covers the window
   * @param {import('./people.js').People} people
   * @param {Window} window
   */
  constructor(element, people, window) {
    this.#element = element;
    this.#people = people;
    people.onChange(() => this.#forget());
    window.addEventListener('resize', () => this.#forget());
  }

  /**
   * `labels`: visitor, place in the window (shares) and opacity, nearest first. `width` and `height`: of the picture.
   */
  show({ labels, width, height }) {
    this.#shown = { labels, width, height };
    const known = labels.filter(({ visitor }) => this.#people.find(visitor));
    const kept = new Set(known.map(({ visitor }) => visitor));
    for (const [visitor, tag] of this.#tags) if (!kept.has(visitor)) this.#remove(visitor, tag);
    const window = { width: this.#element.clientWidth, height: this.#element.clientHeight };
    const boxes = known.map(({ visitor, place }) => {
      const { size } = this.#tags.get(visitor) ?? this.#add(visitor);
      const { x, y } = coverPlace(place, { width, height }, window);
      const half = size.width / 2;
      return { x: Math.min(Math.max(x, half), window.width - half), y: Math.max(y, size.height), ...size };
    });
    const lifts = liftsOf(boxes);
    known.forEach(({ visitor, opacity }, i) => this.#place(this.#tags.get(visitor), boxes[i], lifts[i], opacity));
  }

  /** Fonts, sizes or names have changed: makes every tag again. */
  #forget() {
    for (const [visitor, tag] of this.#tags) this.#remove(visitor, tag);
    this.show(this.#shown);
  }

  #add(visitor) {
    const { name, colour } = this.#people.find(visitor);
    const element = this.#element.ownerDocument.createElement('span');
    element.textContent = name;
    element.dir = 'auto';
    element.style.setProperty('--who', colour);
    element.style.opacity = 0;
    this.#element.append(element);
    const tag = { element, size: { width: element.offsetWidth, height: element.offsetHeight } };
    this.#tags.set(visitor, tag);
    return tag;
  }

  #remove(visitor, { element }) {
    element.remove();
    this.#tags.delete(visitor);
  }

  /** Only the lift has a transition (style.css), so that the tag follows its figure at once. */
  #place({ element, size }, box, lift, opacity) {
    element.style.transform = `translate(${box.x - size.width / 2}px, ${box.y - size.height}px)`;
    element.style.translate = `0 ${-(lift ?? 0)}px`;
    element.style.opacity = lift === null ? 0 : opacity;
  }
}

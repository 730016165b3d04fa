/** The span of the charts. Milliseconds. */
export const kHistory = 120_000;

/** The last two minutes of some figures; unknown figures are `null`. Times in milliseconds. */
export class History {
  #points = [];

  add(time, figures) {
    this.#points.push({ time, ...figures });
    while (this.#points[0].time < time - kHistory) this.#points.shift();
  }

  /** The points of one figure, oldest first. */
  of(name) {
    return this.#points.map((point) => ({ time: point.time, value: point[name] ?? null }));
  }
}

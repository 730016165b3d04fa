import { kOperator } from '../texts.js';
import { kHistory } from './history.js';

/** Max time between two connected readings: a longer line would show a time without readings. Milliseconds. */
const kLongestGap = 3000;
const kWidth = 240;
const kHeight = 60;

/** The next 1, 2 or 5 times a power of ten that is not below `value`. */
export function roundUp(value) {
  const power = 10 ** Math.floor(Math.log10(value));
  return [1, 2, 5, 10].find((step) => step * power >= value * (1 - 1e-9)) * power;
}

/** The known points, divided at gaps. */
function pieces(points) {
  const found = [];
  let last = null;
  for (const point of points) {
    if (point.value !== null) {
      if (last === null || point.time - last.time > kLongestGap) found.push([]);
      found.at(-1).push(point);
    }
    last = point.value === null ? null : point;
  }
  return found;
}

/** The line, and the area under it, as paths in a box of kWidth x kHeight; `end` is at its right edge. */
export function paths(points, end, most) {
  const x = (time) => (kWidth * (1 - (end - time) / kHistory)).toFixed(1);
  const y = (value) => (kHeight * (1 - Math.min(value, most) / most)).toFixed(1);
  const lines = pieces(points).map((piece) => {
    const corners = piece.map(({ time, value }) => `${x(time)} ${y(value)}`);
    const line = `M${corners.join('L')}${piece.length === 1 ? 'h.1' : ''}`;
    return { line, area: `${line}L${x(piece.at(-1).time)} ${kHeight}L${x(piece[0].time)} ${kHeight}Z` };
  });
  return { line: lines.map(({ line }) => line).join(''), area: lines.map(({ area }) => area).join('') };
}

/** A small line chart of the last two minutes, from zero to the largest value. */
export class Chart {
  #figure;
  #least;
  #tell;

  /** `figure` has the parts of the page's chart template; `least` is the min top of the scale; `tell` formats. */
  constructor(figure, { least, tell }) {
    this.#figure = figure;
    this.#least = least;
    this.#tell = tell;
  }

  /** `end` is now, by the points' clock; `least` replaces the constructor's, if only now known. */
  draw(points, end, least = this.#least) {
    const values = points.map(({ value }) => value).filter((value) => value !== null);
    const most = roundUpFrom(least, values);
    const { line, area } = paths(points, end, most);
    const part = (name) => this.#figure.querySelector(`[data-chart=${name}]`);
    part('line').setAttribute('d', line);
    part('area').setAttribute('d', area);
    part('most').textContent = most.toLocaleString('en');
    part('now').textContent = this.#tell(points.at(-1)?.value ?? null);
    part('picture').setAttribute('aria-label', this.#words(values));
  }

  #words(values) {
    if (values.length === 0) return kOperator.chartEmpty;
    return kOperator.chartRange(this.#tell(Math.min(...values)), this.#tell(Math.max(...values)));
  }
}

function roundUpFrom(least, values) {
  const largest = Math.max(...values, 0);
  return largest <= least ? least : roundUp(largest);
}

import { plain, share, whole } from '../figures.js';
import { kOperator } from '../texts.js';
import { Chart } from './chart.js';

const kCharts = [
  { name: 'visitors', least: 4, tell: whole },
  { name: 'cores', least: 1, tell: plain },
  { name: 'alpha', least: 1, tell: share },
  { name: 'fps', least: 30, tell: plain },
];

/** Fills `place` with the charts. Returns a function that draws them from a History up to `end`. */
export function makeCharts(place, template) {
  const charts = kCharts.map(({ name, least, tell }) => {
    const figure = template.content.cloneNode(true).firstElementChild;
    figure.querySelector('figcaption span').textContent = kOperator.charts[name];
    place.append(figure);
    return { name, chart: new Chart(figure, { least, tell }) };
  });
  return (history, end, machineCores) => {
    for (const { name, chart } of charts) {
      chart.draw(history.of(name), end, name === 'cores' && machineCores ? machineCores : undefined);
    }
  };
}

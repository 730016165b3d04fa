import { at, kRates } from './curves.mjs';

// Pixels.
const kWidth = 470;
const kHeight = 330;
const kHead = 84;
const kColumns = 2;
const kPlot = { left: 66, right: 450, top: 34, bottom: 278 };
/** Okabe and Ito's colours, which most colour-blind people can distinguish. */
const kColours = ['#d55e00', '#0072b2', '#009e73', '#404040', '#cc79a7', '#8a6d00', '#56b4e9', '#e69f00'];
const kTicksOfCpu = [1, 2, 5, 10, 20, 50, 100, 200, 500, 1000];

const text = (x, y, words, attributes = '') =>
  `<text x="${x.toFixed(1)}" y="${y.toFixed(1)}" font-size="12" fill="#333" ${attributes}>${words}</text>`;
const line = (x1, y1, x2, y2, colour, width = 1) =>
  `<line x1="${x1.toFixed(1)}" y1="${y1.toFixed(1)}" x2="${x2.toFixed(1)}" y2="${y2.toFixed(1)}" ` +
  `stroke="${colour}" stroke-width="${width}"/>`;
/** Of the first rate a ring, of the others a disc. */
const mark = (x, y, rate, colour) =>
  `<circle cx="${x.toFixed(1)}" cy="${y.toFixed(1)}" r="4.5" stroke="${colour}" stroke-width="2" ` +
  `fill="${rate === kRates[0] ? '#fdfdfb' : colour}"/>`;

/** Maps values to pixels. */
const scale = (low, high, from, to) => (value) => from + ((value - low) / (high - low)) * (to - from);

function axesOf(marks) {
  const cpus = marks.map(({ cpu }) => cpu);
  const ssims = marks.map(({ ssim }) => ssim);
  const first = kTicksOfCpu.findLastIndex((tick) => tick < Math.min(...cpus));
  const last = kTicksOfCpu.findIndex((tick) => tick > Math.max(...cpus));
  const xTicks = kTicksOfCpu.slice(Math.max(0, first), last + 1);
  const [low, high] = [Math.floor(Math.min(...ssims) * 100 - 0.1), Math.ceil(Math.max(...ssims) * 100 + 0.1)];
  const yTicks = Array.from({ length: high - low + 1 }, (_, i) => (low + i) / 100);
  const logarithm = scale(Math.log(xTicks[0]), Math.log(xTicks.at(-1)), kPlot.left, kPlot.right);
  const y = scale(yTicks[0], yTicks.at(-1), kPlot.bottom, kPlot.top);
  return { xTicks, yTicks, x: (value) => logarithm(Math.log(value)), y };
}

function gridOf({ xTicks, yTicks, x, y }) {
  const kThin = '#e2e2dc';
  return [
    ...xTicks.flatMap((tick) => [
      line(x(tick), kPlot.top, x(tick), kPlot.bottom, kThin),
      text(x(tick), kPlot.bottom + 17, tick, 'text-anchor="middle"'),
    ]),
    ...yTicks.flatMap((tick) => [
      line(kPlot.left, y(tick), kPlot.right, y(tick), kThin),
      text(kPlot.left - 7, y(tick) + 4, tick.toFixed(2), 'text-anchor="end"'),
    ]),
    text((kPlot.left + kPlot.right) / 2, kPlot.bottom + 36, 'CPU per frame, ms', 'text-anchor="middle"'),
    text(18, 156, 'SSIM of luma', 'text-anchor="middle" transform="rotate(-90 18 156)"'),
  ];
}

function panelOf({ walk, encoders }, colours) {
  const found = encoders.map(({ name, points }) => ({
    colour: colours.get(name),
    marks: kRates.flatMap((rate) => {
      const figures = at(rate, points);
      return figures ? [{ rate, ...figures }] : [];
    }),
  }));
  const title = text(kPlot.left, 20, walk, 'style="font-size: 14px; font-weight: 600"');
  const all = found.flatMap(({ marks }) => marks);
  if (all.length === 0) return [title, text(kPlot.left, 150, 'no encoder was measured around these rates')];
  const axes = axesOf(all);
  const place = ({ cpu, ssim }) => [axes.x(cpu), axes.y(ssim)];
  return [
    title,
    ...gridOf(axes),
    ...found.flatMap(({ colour, marks }) => [
      ...marks.slice(1).map((end, i) => line(...place(marks[i]), ...place(end), colour, 1.5)),
      ...marks.map((one) => mark(...place(one), one.rate, colour)),
    ]),
  ];
}

function legendOf(colours) {
  const kEntry = 130;
  const names = [...colours].flatMap(([name, colour], i) => [
    mark(kPlot.left + i * kEntry, 28, kRates.at(-1), colour),
    text(kPlot.left + 10 + i * kEntry, 32, name),
  ]);
  const rates = kRates.flatMap((rate, i) => [
    mark(kPlot.left + i * kEntry, 54, rate, '#777'),
    text(kPlot.left + 10 + i * kEntry, 58, `${rate / 1000} Mbit/s`),
  ]);
  return [...names, ...rates, text(kPlot.left + kRates.length * kEntry, 58, 'Left and up is better.')];
}

/** CPU per frame against SSIM at each rate, as SVG: a panel for each walk. */
export function plotOf({ walks, processor, cores, score }) {
  const names = [...new Set(walks.flatMap(({ encoders }) => encoders.map(({ name }) => name)))];
  const colours = new Map(names.map((name, i) => [name, kColours[i % kColours.length]]));
  const width = Math.min(kColumns, Math.max(2, walks.length)) * kWidth;
  const height = kHead + Math.ceil(walks.length / kColumns) * kHeight + 24;
  const panels = walks.map((walk, i) => {
    const place = `${(i % kColumns) * kWidth} ${kHead + Math.floor(i / kColumns) * kHeight}`;
    return `<g transform="translate(${place})">\n${panelOf(walk, colours).join('\n')}\n</g>`;
  });
  const family = "system-ui, 'DejaVu Sans', Helvetica, Arial, sans-serif";
  return [
    `<svg xmlns="http://www.w3.org/2000/svg" width="${width}" height="${height}" ` +
      `viewBox="0 0 ${width} ${height}" font-family="${family}">`,
    `<rect x="0.5" y="0.5" width="${width - 1}" height="${height - 1}" rx="10" fill="#fdfdfb" stroke="#d4d4cc"/>`,
    ...legendOf(colours),
    ...panels,
    text(kPlot.left, height - 16, `1280x720, one thread each; ${processor}, ${cores} cores, score ${score}`),
    '</svg>\n',
  ].join('\n');
}

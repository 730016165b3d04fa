import { megabytes, milliseconds, percent, plain, share, whole } from '../figures.js';
import { versionOf } from '../world_statistics.js';
import { write } from './live_table.js';

/** The figure and the words under it, of `{ statistics, amortization }`; `amortization` may be `null`. */
const kTiles = {
  visitors: ({ statistics }) => [whole(statistics.visitors), 'inside now'],
  fps: ({ amortization: told }) => [plain(told?.framesPerSecond), 'each visitor gets, on average'],
  alpha: ({ amortization: told }) => [share(told?.alpha), shared('work behind a frame', told, told?.alpha)],
  beta: ({ amortization: told }) => [share(told?.beta), shared('memory for one visitor', told, told?.beta)],
  cores: ({ amortization: told }) => [
    plain(told?.cpuCores),
    told?.cores ? `of ${whole(told.cores)}; one more visitor takes ${plain(told.visitorCores)}` : 'of this machine',
  ],
  fit: ({ amortization: told }) => [whole(told?.visitorsFit), room(told)],
};

function shared(what, told, value) {
  if (told?.isPrivate) return `of the ${what} could be shared`;
  return (value ?? null) === null ? `part of the ${what} that is shared` : `${percent(value)} of the ${what} is shared`;
}

function room(told) {
  if (!told || told.privateVisitorsFit === null) return 'at the full frame rate';
  if (told.isPrivate) return 'each with a world of their own';
  if (told.visitorsFit === 0) return 'not even one gets the full frame rate';
  if (told.privateVisitorsFit === 0) return 'in private mode not even one';
  const times = told.visitorsFit / told.privateVisitorsFit;
  const most = `at most ${whole(told.privateVisitorsFit)}`;
  if (times <= 1) return `in private mode ${most}`;
  return `${Number(times.toFixed(1))} times as many as in private mode (${most})`;
}

const kQuality = ({ quality }) => {
  if (!Number.isInteger(quality?.step) || !Number.isInteger(quality.steps)) return '\u2013';
  const place = `step ${quality.step + 1} of ${quality.steps}`;
  return `${place}, ${quality.automatic ? 'raised while visitors share the bill' : 'fixed'}`;
};

/** Writes the big figures and the small ones at the end. `root` is the document. */
export function writeFigures(root, now) {
  for (const [name, tell] of Object.entries(kTiles)) {
    const [figure, note] = tell(now);
    write(root.querySelector(`[data-figure=${name}]`), figure);
    write(root.querySelector(`[data-note=${name}]`), note);
  }
  write(root.querySelector('[data-figure=version]'), versionOf(now.statistics) ?? '');
  write(root.querySelector('[data-figure=hits]'), percent(now.cacheHits));
  write(root.querySelector('[data-figure=quality]'), kQuality(now.statistics));
}

/** Where the memory is, in a sentence. */
export function memoryWords(memory) {
  if (memory === null) return 'This server does not tell.';
  const told = memory.holders.length > 0 ? `, of which ${megabytes(memory.told)} have a name` : '';
  return `The process holds ${megabytes(memory.resident)}${told}.`;
}

/** What the bars mean, in a sentence; empty where they are not known. */
export function verdict(cost, sums) {
  if (!cost?.alone || sums.now <= 0) return '';
  const times = sums.alone / sums.now;
  const more = times >= 1.05 ? `${plain(times)} times as much` : 'about as much';
  return `With a world of their own each visitor would cost at least ${milliseconds(sums.alone)} a frame: ${more}.`;
}

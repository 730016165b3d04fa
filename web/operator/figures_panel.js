import { kUnknown, megabytes, milliseconds, percent, plain, share, whole } from '../figures.js';
import { kOperator } from '../texts.js';
import { versionOf } from '../world_statistics.js';
import { write } from './live_table.js';

/** Figure and note of each tile, from `{ statistics, amortization }`; `amortization` may be `null`. */
const kTiles = {
  visitors: ({ statistics }) => [whole(statistics.visitors), kOperator.visitorsNote],
  fps: ({ statistics, amortization }) => [plain(amortization?.framesPerSecond), frameRateNote(statistics)],
  alpha: ({ amortization }) => [share(amortization?.alpha), shared(kOperator.work, amortization?.alpha)],
  beta: ({ amortization }) => [share(amortization?.beta), shared(kOperator.memory, amortization?.beta)],
  cores: ({ amortization }) => [
    plain(amortization?.cpuCores),
    amortization?.cores
      ? kOperator.coresNote(whole(amortization.cores), plain(amortization.visitorCores))
      : kOperator.coresUnknown,
  ],
  fit: ({ amortization }) => [whole(amortization?.visitorsFit), room(amortization)],
};

function frameRateNote({ picture_scale: scale, moved_pictures_per_second: rate }) {
  const limits = [
    scale > 0 && scale < 1 ? kOperator.fpsSmaller(percent(scale)) : null,
    rate > 0 ? kOperator.fpsFewer(whole(rate)) : null,
  ].filter(Boolean);
  return limits.length > 0 ? kOperator.fpsBusy(limits.join(' and ')) : kOperator.fpsNote;
}

function shared(what, value) {
  return (value ?? null) === null ? kOperator.isShared(what) : kOperator.sharedPart(percent(value), what);
}

function room(amortization) {
  if (!amortization || amortization.privateVisitorsFit === null) return kOperator.fit;
  if (amortization.visitorsFit === 0) return kOperator.fitNone;
  if (amortization.privateVisitorsFit === 0) return kOperator.fitNoneAlone;
  const times = amortization.visitorsFit / amortization.privateVisitorsFit;
  const most = whole(amortization.privateVisitorsFit);
  return times <= 1 ? kOperator.fitAlone(most) : kOperator.fitTimes(Number(times.toFixed(1)), most);
}

const kQuality = ({ quality }) => {
  if (!Number.isInteger(quality?.step) || !Number.isInteger(quality.steps)) return kUnknown;
  return kOperator.quality(quality.step + 1, quality.steps, quality.automatic);
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

/** A sentence about the memory of a process. */
export function memoryWords(memory) {
  if (memory === null) return kOperator.memoryUnknown;
  const used = megabytes(memory.resident);
  return memory.holders.length > 0 ? kOperator.memoryUseOf(used, megabytes(memory.amortization)) : kOperator.memoryUse(used);
}

/** The result of the bars in a sentence; '' if unknown. */
export function verdict(cost, sums) {
  if (!cost?.alone || sums.now <= 0) return '';
  const times = sums.alone / sums.now;
  const more = times >= 1.05 ? kOperator.timesAsMuch(plain(times)) : kOperator.aboutAsMuch;
  return kOperator.verdict(milliseconds(sums.alone), more);
}

import { reportOf } from '../grove.mjs';

export const name = 'capacity';
export const commands = ['bench amortize --capacity --codec CODEC --size 640x360 --seconds 8 --json'];

/** The trials that decide: those with the capacity and with one visitor more. */
function servedOf(report, mode, visitors) {
  const trials = report.trials.filter((trial) => trial.mode === mode && trial.visitors === visitors);
  if (trials.length === 0) return '';
  return trials
    .map((trial) => `${trial.fps.p50.toFixed(1)} fps, ${Math.round(trial.latency_ms.p99)} ms, ${trial.lines_min} lines`)
    .join('; ');
}

const costOf = (report, mode) => {
  const alone = report.trials.find((trial) => trial.mode === mode && trial.visitors === 1);
  return alone ? alone.cpu_ms_per_frame.toFixed(1) : '';
};

export async function measure() {
  const rows = [];
  for (const codec of ['jpeg', 'h264']) {
    const report = await reportOf(commands[0].replace('CODEC', codec));
    const law = report.law;
    for (const mode of ['shared', 'private']) {
      const capacity = report.capacity[mode];
      rows.push({
        codec,
        mode,
        capacity,
        'trials with that number': servedOf(report, mode, capacity),
        'trials with one more': servedOf(report, mode, capacity + 1),
        'one alone, ms per frame': costOf(report, mode),
        'by the law': mode === 'private' && law ? `${law.private_min} to ${law.private_max} (α ${law.alpha})` : '',
      });
    }
  }
  return rows;
}

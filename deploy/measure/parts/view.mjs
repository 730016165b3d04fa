import { median, reportOf } from '../grove.mjs';

export const name = 'view';
export const commands = ['bench view --walk FILE --seconds 5 --json'];

const kRuns = 3;
/** Columns of the table, and the layers of the report. */
const kLayers = {
  'light fields': 'lightfield',
  backdrop: 'backdrop',
  JPEG: 'JPEG',
  meshes: 'mesh',
  ground: 'ground',
  sky: 'sky',
  smoke: 'fluid',
};

async function rowOf(walk) {
  const runs = [];
  for (let i = 0; i < kRuns; ++i) runs.push(await reportOf(commands[0].replace('FILE', `tests/walks/${walk}.walk`)));
  const middle = (value, digits) => median(runs.map(value)).toFixed(digits);
  const layer = ([column, key]) => [column, middle((run) => run.layers[key] ?? 0, 1)];
  return {
    walk: walk.replace('_', ' '),
    'CPU per frame, ms': middle((run) => run.cpu_ms_per_frame, 1),
    'without reuse': middle((run) => run.cpu_ms_per_frame_whole, 1),
    'in a loop': middle((run) => run.cpu_ms_per_frame_in_loop, 1),
    ...Object.fromEntries(Object.entries(kLayers).map(layer)),
    'MB touched': middle((run) => run.bytes_per_frame * 1e-6, 0),
    'PSNR, worst frame, dB': `${middle((run) => run.psnr_db.mean, 1)}, ${middle((run) => run.psnr_db.worst, 1)}`,
    'flicker, without backdrops': `${middle((run) => run.flicker, 3)}, ${middle((run) => run.flicker_reference, 3)}`,
  };
}

export async function measure() {
  const rows = [];
  for (const walk of ['clearing', 'crowd', 'edge', 'under_trees']) rows.push(await rowOf(walk));
  return rows;
}

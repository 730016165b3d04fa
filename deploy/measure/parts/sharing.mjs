import { kMeasured } from '../paths.mjs';
import { reportOf } from '../grove.mjs';

export const name = 'sharing';
export const commands = [
  'bench amortize --users 1,2,3,4,5,6 --codec jpeg,h264 --seconds 8 --size 640x360 --json --plot FILE.svg',
];

/** Milliseconds of CPU of the process, or of all processes, for a frame of one visitor. */
const costOf = (row) => (1e3 * row.cpu_cores) / (row.fps * row.users);

export async function measure() {
  const report = await reportOf(commands[0].replace('FILE.svg', `${kMeasured}/amortize.svg`));
  return report.rows.map((row) => ({
    codec: row.codec,
    visitors: row.users,
    mode: row.mode,
    c_i: row.c_i_ms.toFixed(1),
    c_b1: row.c_b1_ms.toFixed(1),
    c_f: row.c_f_ms.toFixed(1),
    α1: row.alpha1.toFixed(2),
    β: row.beta.toFixed(2),
    'CPU per frame of one, ms': costOf(row).toFixed(1),
    cores: row.cpu_cores.toFixed(2),
    fps: row.fps.toFixed(1),
    'p99, ms': Math.round(row.latency_ms.p99),
  }));
}

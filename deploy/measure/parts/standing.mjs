import { reportOf } from '../grove.mjs';

export const name = 'standing';
export const commands = ['bench view --walk tests/walks/clearing.walk --stand --visitors N --seconds 5 --json'];

export async function measure() {
  const rows = [];
  for (const visitors of [1, 32]) {
    const report = await reportOf(commands[0].replace('N', visitors));
    rows.push({
      visitors,
      'CPU per frame of each, ms': report.cpu_ms_per_frame.toFixed(1),
      'of it JPEG': (report.layers.JPEG).toFixed(1),
      'memory of each, MB': (report.bytes_per_visitor * 1e-6).toFixed(1),
    });
  }
  return rows;
}

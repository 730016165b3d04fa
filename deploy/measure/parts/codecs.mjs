import { reportOf } from '../grove.mjs';

export const name = 'codecs';
export const commands = ['bench encode --walk tests/walks/clearing.walk --seconds 8 --json'];

export async function measure() {
  const report = await reportOf(commands[0]);
  return report.rows.map((row) => ({
    encoder: row.encoder,
    walk: row.walk,
    'wanted, kbit/s': row.wanted_kbit_per_s,
    'kbit/s': Math.round(row.kbit_per_s),
    'CPU per frame, ms': row.cpu_ms_per_frame.toFixed(1),
    'p99, ms': row.p99_ms.toFixed(1),
    SSIM: row.ssim.toFixed(3),
  }));
}

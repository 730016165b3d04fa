import { reportOf } from '../grove.mjs';

export const name = 'machine';
export const commands = ['bench machine --json'];

export async function measure() {
  const report = await reportOf(commands[0]);
  const times = Object.entries(report.kernels).map(([kernel, time]) => ({
    kernel,
    'hot, ms': time.hot_cpu_ms.toFixed(2),
    'cold, ms': time.cold_cpu_ms.toFixed(2),
  }));
  return [...times, { kernel: 'score', 'hot, ms': report.hot.toFixed(0), 'cold, ms': report.cold.toFixed(0) }];
}

import { reportOf } from '../grove.mjs';

export const name = 'pipeline';
export const commands = ['bench pipeline --frames-in-flight 1,2,4 --seconds 8 --json'];

export async function measure() {
  const report = await reportOf(commands[0]);
  return report.rows.map((row) => ({
    'frames in flight': row.frames_in_flight,
    'frames per second': row.frames_per_second.toFixed(0),
    'latency, p50, ms': row.latency_ms.p50.toFixed(0),
    'p99, ms': row.latency_ms.p99.toFixed(0),
    'busiest stage': row.bottleneck,
    'its share of the time': row.stages[row.bottleneck].utilisation.toFixed(2),
  }));
}

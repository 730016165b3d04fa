import { reportOf, withServer } from '../grove.mjs';

export const name = 'load';
export const commands = ['load ws://127.0.0.1:8080/ --sessions N --seconds 20 --walk --codec CODEC --json'];

const kVisitors = { jpeg: [1, 2, 4, 6, 8, 12, 16], h264: [1, 2, 4, 6] };

export function rowOf(report, first) {
  return {
    ...first,
    'frames per second, p50': report.fps.p50.toFixed(1),
    min: report.fps.min.toFixed(1),
    'lines, p50': report.lines.p50,
    'latency, p50, ms': Math.round(report.latency_ms.p50),
    'p95, ms': Math.round(report.latency_ms.p95),
    'p99, ms': Math.round(report.latency_ms.p99),
    'longest gap, ms': Math.round(report.longest_gap_ms),
  };
}

export async function measure() {
  const rows = [];
  for (const [codec, counts] of Object.entries(kVisitors)) {
    for (const visitors of counts) {
      const report = await withServer((url) =>
        reportOf(`load ${url} --sessions ${visitors} --seconds 20 --walk --codec ${codec} --json`),
      );
      const limited = report.limited_by;
      const limits = ['line', 'machine'].map((by) => (limited[by] * 100).toFixed(0));
      rows.push({ ...rowOf(report, { codec, visitors }), 'limited by line, machine, %': limits.join(', ') });
    }
  }
  return rows;
}

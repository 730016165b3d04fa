import { reportOf, withServer } from '../grove.mjs';
import { rowOf } from './load.mjs';

export const name = 'lines';
export const commands = ['load ws://127.0.0.1:8080/ --shape LINE --seconds 15 --walk --json'];

const kLines = ['20mbit,20ms', '5mbit,80ms', '2mbit,80ms', '5mbit@0s/500kbit@8s,80ms'];

export async function measure() {
  const rows = [];
  for (const line of kLines) {
    const report = await withServer((url) => reportOf(`load ${url} --shape ${line} --seconds 15 --walk --json`));
    rows.push(rowOf(report, { line, codec: report.codec }));
  }
  return rows;
}

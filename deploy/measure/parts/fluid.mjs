import { kMeasured } from '../paths.mjs';
import { reportOf, runGrove } from '../grove.mjs';

export const name = 'fluid';
export const commands = ['bench fluid --grid N --steps 100 --threads 1 --json'];

export async function measure() {
  await runGrove(`bench fluid --grid 64 --solvers --plot ${kMeasured}/solvers.svg`);
  const rows = [];
  for (const grid of [32, 64, 96, 128]) {
    const report = await reportOf(commands[0].replace('N', grid));
    rows.push({
      cells: `${grid}³`,
      'CPU per step, ms': report.cpu_ms_per_step.toFixed(1),
      'relative residual': report.residual.toExponential(1),
      'max. divergence': report.max_divergence.toExponential(1),
    });
  }
  return rows;
}

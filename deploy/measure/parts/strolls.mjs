import { reportOf } from '../grove.mjs';

export const name = 'strolls';
export const commands = [
  'bench amortize --users 1,2,4 --walk together,apart,standing --seconds 5 --size 640x360 --json',
];

export async function measure() {
  const report = await reportOf(commands[0]);
  return report.rows
    .filter((row) => row.mode === 'shared')
    .map((row) => ({
      walk: row.walk,
      visitors: row.users,
      c_i: row.c_i_ms.toFixed(1),
      'of it, views': row.c_i_on_demand_ms.toFixed(2),
      c_b1: row.c_b1_ms.toFixed(1),
      'views of one': row.c_b_on_demand_ms.toFixed(2),
      c_f: row.c_f_ms.toFixed(1),
      α1: row.alpha1.toFixed(2),
      'views made': row.reuse.views_made,
      'for several': row.reuse.views_of_several,
      'uses again': row.reuse.uses_again,
      'by others': row.reuse.uses_by_others,
    }));
}

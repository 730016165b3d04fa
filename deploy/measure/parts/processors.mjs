import { reportOf } from '../grove.mjs';

export const name = 'processors';
export const commands = [
  'bench fluid --grid 64 --steps 100 --threads 1 --json',
  'bench lightfield --size 512 --requests 100 --json',
  'bench pipeline --frames-in-flight 1 --seconds 8 --json',
];

export async function measure() {
  const rows = [];
  const native = (await reportOf('bench machine --json')).simd;
  for (const simd of [native, 'avx2', 'sse4'].filter((target, i, all) => all.indexOf(target) === i)) {
    const env = { GROVE_SIMD: simd };
    const fluid = await reportOf(commands[0], env);
    const field = await reportOf(commands[1], env);
    const [row] = (await reportOf(commands[2], env)).rows;
    rows.push({
      '`GROVE_SIMD`': simd,
      'a step of the fluid, ms': fluid.cpu_ms_per_step.toFixed(1),
      'a picture of an oak, ms': field.cpu_ms_per_request.toFixed(1),
      'frames per second': row.frames_per_second.toFixed(0),
    });
  }
  return rows;
}

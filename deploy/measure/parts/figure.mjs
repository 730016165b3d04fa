import { reportOf } from '../grove.mjs';

export const name = 'figure';
export const commands = ['bench amortize --users 1 --frames 60 --figure-5.6 --json'];

/** The paper's Figure 5.6: milliseconds, and shares, by frames and frontends. */
const kPaper = [
  { frames: 100, frontends: 1, c_i: 67.11, c_b0: 0.76, c_b1: 17.95, c_f: 9.56, α0: 0.87, α1: 0.71 },
  { frames: 100, frontends: 4, c_i: 49.14, c_b0: 1.61, c_b1: 37.09, c_f: 4.98, α0: 0.88, α1: 0.54 },
  { frames: 500, frontends: 1, c_i: 59.88, c_b0: 0.61, c_b1: 14.58, c_f: 7.77, α0: 0.88, α1: 0.73 },
  { frames: 500, frontends: 4, c_i: 63.94, c_b0: 2.72, c_b1: 59.32, c_f: 9.69, α0: 0.84, α1: 0.48 },
];

/** "67.11, 12.34": the paper's value and ours. */
const pairOf = (paper, ours, digits) => `${paper.toFixed(2)}, ${ours.toFixed(digits)}`;

function rowOf(paper, column) {
  return {
    cells: `${column.grid}³`,
    frames: paper.frames,
    frontends: paper.frontends,
    c_i: pairOf(paper.c_i, column.c_i_ms, 2),
    c_b0: pairOf(paper.c_b0, column.c_b0_ms, 3),
    c_b1: pairOf(paper.c_b1, column.c_b1_ms, 3),
    c_f: pairOf(paper.c_f, column.c_f_ms, 2),
    α0: pairOf(paper.α0, column.alpha0, 2),
    α1: pairOf(paper.α1, column.alpha1, 2),
  };
}

export async function measure() {
  const { figure_5_6: columns } = await reportOf(commands[0]);
  return columns.map((column) => {
    const paper = kPaper.find(({ frames, frontends }) => frames === column.frames && frontends === column.frontends);
    return rowOf(paper, column);
  });
}

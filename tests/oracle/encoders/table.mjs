import { at, kRates } from './curves.mjs';

const cells = (words) => `| ${words.join(' | ')} |`;

/** A row for each walk and encoder; a dash where an encoder was not measured on both sides of a rate. */
export function tableOf({ walks }) {
  const figures = ['CPU, ms', 'SSIM', 'PSNR, dB'];
  const heads = kRates.flatMap((rate) => figures.map((figure) => `${rate / 1000} Mbit/s: ${figure}`));
  const rows = walks.flatMap(({ walk, encoders }) =>
    encoders.map(({ name, points }) => {
      const values = kRates.flatMap((rate) => {
        const found = at(rate, points);
        if (!found) return figures.map(() => '–');
        return [found.cpu.toFixed(1), found.ssim.toFixed(4), found.psnr.toFixed(1)];
      });
      return cells([walk, name, ...values]);
    }),
  );
  const head = ['walk', 'encoder', ...heads];
  return [cells(head), `|${'---|'.repeat(head.length)}`, ...rows].join('\n');
}

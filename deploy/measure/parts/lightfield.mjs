import { reportOf } from '../grove.mjs';

export const name = 'lightfield';
export const commands = ['bench lightfield --size 512 --requests 300 --json'];

export async function measure() {
  const report = await reportOf(commands[0]);
  return [
    {
      'light field': report.source,
      views: report.views,
      'requests per second, all cores': Math.round(report.requests_per_s),
      'CPU per request, ms': report.cpu_ms_per_request.toFixed(1),
      'PSNR of held-out views, dB': report.psnr_db.toFixed(1),
      'without depth, dB': report.psnr_db_without_depth.toFixed(1),
    },
  ];
}

import { spawn } from 'node:child_process';

/** Runs FFmpeg with these words; returns what it logs. Rejects if it fails. */
function ffmpeg(words) {
  return new Promise((resolve, reject) => {
    const all = ['-hide_banner', '-nostdin', '-y', ...words];
    const child = spawn('ffmpeg', all, { stdio: ['ignore', 'ignore', 'pipe'] });
    let log = '';
    child.stderr.on('data', (data) => (log += data));
    child.on('error', reject);
    child.on('close', (code) => (code === 0 ? resolve(log) : reject(new Error(`ffmpeg ${words.join(' ')}:\n${log}`))));
  });
}

function figure(log, pattern) {
  const found = pattern.exec(log);
  if (!found) throw new Error(`ffmpeg does not report ${pattern}:\n${log}`);
  return Number(found[1]);
}

/** Seconds of CPU, user and system, that FFmpeg takes to do this. */
async function cpuSeconds(words) {
  const log = await ffmpeg(['-benchmark', ...words]);
  return figure(log, /bench: utime=([\d.]+)s/) + figure(log, /bench: utime=\S+ stime=([\d.]+)s/);
}

const readWords = (film) => ['-threads', '1', '-i', film];

/** Seconds of CPU to read a film without encoding it: the least of three runs. */
export async function readingSeconds(film) {
  const runs = [];
  for (let i = 0; i < 3; ++i) runs.push(await cpuSeconds([...readWords(film), '-f', 'null', '-']));
  return Math.min(...runs);
}

/** Encodes a film with these options into a file, on one thread; returns seconds of CPU, with those of reading. */
export const encode = (film, options, file) =>
  cpuSeconds([...readWords(film), '-fps_mode', 'passthrough', ...options, '-threads', '1', file]);

/**
 * Compares the luma of a stream with that of the film, frame by frame. Streams differ in how they name full range, or
 * cannot name it, so FFmpeg must not convert what it believes to be another.
 */
export async function compare(film, stream, frames) {
  const alike = 'setrange=full,scale=in_range=full:out_range=full,format=yuv420p,settb=1/30,setpts=N';
  const graph =
    `[0:v]${alike},split[a][b];[1:v]${alike},split[c][d];` +
    '[a][c]ssim=shortest=1[e];[b][d]psnr=shortest=1[f]';
  const log = await ffmpeg([
    ...['-r', '30', '-i', stream, '-i', film, '-lavfi', graph, '-fps_mode', 'passthrough'],
    ...['-map', '[e]', '-f', 'null', '-', '-map', '[f]', '-f', 'null', '-'],
  ]);
  const compared = Number([...log.matchAll(/frame= *(\d+)/g)].at(-1)?.[1]);
  if (compared !== frames) throw new Error(`${stream} has ${compared} frames of ${frames}`);
  return { ssim: figure(log, /SSIM Y:([\d.]+)/), psnr: figure(log, /PSNR y:(\d+\.\d+|inf)/) };
}

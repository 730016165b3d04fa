// Compares Grove's H.264 encoders with x264 and libvpx on the same pictures, see README.md.
//   node tests/oracle/encoders.mjs [--seconds S] [--others NAME,…|none] [--write] [FILE…]
// FILE is a walk (default: all of tests/walks); NAME an encoder of encoders/others.mjs. Prints a table, and writes the
// plot and the points of its curves to build/encoders/; --write puts table and plot into this folder, too.
import { mkdirSync, mkdtempSync, readFileSync, readdirSync, rmSync, statSync, writeFileSync } from 'node:fs';
import { tmpdir } from 'node:os';
import { basename, join } from 'node:path';
import { fileURLToPath } from 'node:url';
import { parseArgs } from 'node:util';

import { reportOf } from '../../deploy/measure/grove.mjs';
import { pointsAround } from './encoders/curves.mjs';
import { compare, encode, readingSeconds } from './encoders/ffmpeg.mjs';
import { kOthers } from './encoders/others.mjs';
import { plotOf } from './encoders/plot.mjs';
import { tableOf } from './encoders/table.mjs';

const kRoot = fileURLToPath(new URL('../..', import.meta.url));
const kReadme = 'tests/oracle/README.md';
const kPointsFolder = 'build/encoders';
const kFramesPerSecond = 30;

const say = (words) => console.error(`${new Date().toISOString().slice(11, 19)} ${words}`);

const rateOf = (file, frames) => (statSync(file).size * 8e-3 * kFramesPerSecond) / frames;

async function pointOf(film, stream, frames, quantiser, cpu) {
  return { quantiser, rate: rateOf(stream, frames), cpu, ...(await compare(film, stream, frames)) };
}

/** Grove's encoders, whose streams `grove bench encode` has kept. */
async function ownEncoders(folder, film, rows) {
  const encoders = new Map();
  for (const row of rows.filter(({ codec }) => codec === 'h264')) {
    if (row.pictures !== row.frames) throw new Error(`${row.encoder} left out ${row.frames - row.pictures} pictures`);
    const stream = join(folder, `${row.encoder}-${row.quantiser}.h264`);
    const point = await pointOf(film, stream, row.frames, row.quantiser, row.cpu_ms_mean);
    encoders.set(row.encoder, [...(encoders.get(row.encoder) ?? []), point]);
  }
  return [...encoders].map(([name, points]) => ({ name, points }));
}

async function otherEncoder(other, folder, film, frames, reading) {
  const stream = join(folder, `other.${other.ending}`);
  const points = await pointsAround(other.quantisers, async (quantiser) => {
    const seconds = await encode(film, other.options(String(quantiser)), stream);
    return pointOf(film, stream, frames, quantiser, ((seconds - reading) * 1000) / frames);
  });
  return { name: other.name, points };
}

async function measureWalk(file, seconds, others) {
  const walk = basename(file, '.walk');
  const folder = mkdtempSync(join(tmpdir(), 'grove-encoders-'));
  try {
    const film = join(folder, 'frames.y4m');
    say(`${walk}: grove bench encode`);
    const words = `bench encode --walk ${file} --seconds ${seconds} --keep ${folder} --json`;
    const { rows } = await reportOf(words);
    const encoders = await ownEncoders(folder, film, rows);
    const reading = await readingSeconds(film);
    for (const other of others) {
      say(`${walk}: ${other.name}`);
      encoders.push(await otherEncoder(other, folder, film, rows[0].frames, reading));
    }
    return { walk, frames: rows[0].frames, encoders };
  } finally {
    rmSync(folder, { recursive: true });
  }
}

function othersOf(names) {
  if (names === 'none') return [];
  return names.split(',').map((wanted) => {
    const other = kOthers.find(({ name }) => name === wanted);
    if (!other) throw new Error(`no encoder ${wanted}; there are ${kOthers.map(({ name }) => name).join(', ')}`);
    return other;
  });
}

function writeReadme(table, { processor, cores, score, date }, seconds) {
  const machine = `${processor}, ${cores} cores, score ${score}`;
  const source = `\`grove bench encode\` and FFmpeg, ${seconds} s per walk; ${machine}, ${date}:`;
  const part = /(<!-- encoders -->\n).*?(<!-- end -->)/s;
  const text = readFileSync(kReadme, 'utf8');
  if (!part.test(text)) throw new Error(`${kReadme} has no place for the table`);
  writeFileSync(kReadme, text.replace(part, (_, begin, end) => `${begin}${source}\n\n${table}\n${end}`));
}

const { values, positionals } = parseArgs({
  options: {
    seconds: { type: 'string', default: '6' },
    others: { type: 'string', default: kOthers.map(({ name }) => name).join(',') },
    write: { type: 'boolean', default: false },
  },
  allowPositionals: true,
});
process.chdir(kRoot);
const others = othersOf(values.others);
const walks = positionals.length > 0 ? positionals : readdirSync('tests/walks').map((file) => `tests/walks/${file}`);

const machine = await reportOf('bench machine --json');
const result = {
  processor: machine.processor,
  cores: machine.cores,
  score: Math.round(machine.score),
  date: new Date().toISOString().slice(0, 10),
  walks: [],
};
mkdirSync(kPointsFolder, { recursive: true });
for (const walk of walks) {
  result.walks.push(await measureWalk(walk, values.seconds, others));
  writeFileSync(join(kPointsFolder, 'encoders.json'), `${JSON.stringify(result, null, 1)}\n`);
}
const table = tableOf(result);
console.log(table);
writeFileSync(join(kPointsFolder, 'encoders.svg'), plotOf(result));
if (values.write) {
  writeFileSync('tests/oracle/encoders.svg', plotOf(result));
  writeReadme(table, result, values.seconds);
}

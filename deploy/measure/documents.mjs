import { execFileSync } from 'node:child_process';
import { existsSync, readFileSync, writeFileSync } from 'node:fs';
import { join } from 'node:path';

import { kMeasured, kRoot } from './paths.mjs';

const kBlock = /(<!-- measured: (\w+) -->\n).*?(<!-- end -->)/gs;

const cellOf = (value) => (value === null || value === undefined ? '' : String(value));
const lineOf = (cells) => `| ${cells.join(' | ')} |`.replaceAll('|  |', '| |');

/** The caption and the table of a part, in Markdown. */
function tableOf(part) {
  const document = JSON.parse(readFileSync(join(kRoot, kMeasured, `${part}.json`), 'utf8'));
  const columns = Object.keys(document.rows[0]);
  const commands = document.commands.map((command) => `\`grove ${command}\``).join(', ');
  return [
    `${commands}; ${document.processor}, ${document.cores} cores, score ${document.score}, ${document.date}:`,
    '',
    lineOf(columns),
    `|${'---|'.repeat(columns.length)}`,
    ...document.rows.map((row) => lineOf(columns.map((column) => cellOf(row[column])))),
    '',
  ].join('\n');
}

/** The text of a page with its tables as they were measured; a part that was not measured keeps its text. */
export function filled(text) {
  return text.replaceAll(kBlock, (block, begin, part, end) =>
    existsSync(join(kRoot, kMeasured, `${part}.json`)) ? `${begin}${tableOf(part)}${end}` : block,
  );
}

/** The names of the parts whose tables a page shows. */
export const partsIn = (text) => [...text.matchAll(kBlock)].map(([, , part]) => part);

/** All Markdown files, relative to the root. */
export const pages = () =>
  execFileSync('git', ['ls-files', '*.md'], { cwd: kRoot, encoding: 'utf8' }).trim().split('\n');

export function writeDocuments() {
  for (const page of pages()) {
    const path = join(kRoot, page);
    const text = readFileSync(path, 'utf8');
    const written = filled(text);
    if (written !== text) writeFileSync(path, written);
  }
}

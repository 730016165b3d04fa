import { execFileSync } from 'node:child_process';
import { readFileSync } from 'node:fs';
import { join } from 'node:path';
import { fileURLToPath } from 'node:url';

export const kRoot = fileURLToPath(new URL('../../..', import.meta.url));

export const read = (file) => readFileSync(join(kRoot, file), 'utf8');

/** The repository's files, each with its mode, as git knows them. */
const kModes = new Map(
  execFileSync('git', ['ls-files', '--stage'], { cwd: kRoot, encoding: 'utf8' })
    .trim()
    .split('\n')
    .map((line) => [line.split('\t')[1], line.slice(0, 6)]),
);

export const files = [...kModes.keys()];
export const isExecutable = (file) => kModes.get(file) === '100755';
/** Whether git has this file, or files in this folder or of this pattern. */
export function exists(path) {
  const pattern = path
    .replace(/\/$/, '')
    .replaceAll(/[.+()[\]]/g, '\\$&')
    .replaceAll('*', '[^/]*');
  return files.some((file) => new RegExp(`^${pattern}(/|$)`).test(file));
}

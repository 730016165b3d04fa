import assert from 'node:assert/strict';
import { execFileSync } from 'node:child_process';
import { readFileSync } from 'node:fs';
import { basename, join } from 'node:path';
import { test } from 'node:test';
import { fileURLToPath } from 'node:url';

const kRoot = fileURLToPath(new URL('../..', import.meta.url));
const kPage = 'docs/extending.md';

const read = (file) => readFileSync(join(kRoot, file), 'utf8');
const filesLike = (...patterns) =>
  execFileSync('git', ['ls-files', ...patterns], { cwd: kRoot, encoding: 'utf8' })
    .trim()
    .split('\n');
/** Without indentation and empty lines at the end, as an excerpt may be indented otherwise than its source. */
const linesOf = (text) =>
  text
    .trimEnd()
    .split('\n')
    .map((line) => line.trim());

/** The blocks of code of the page, commands excepted: named file, line and text. */
function excerpts() {
  const page = read(kPage);
  return [...page.matchAll(/^```(\w+)[ \t]*(\S*)\n(.*?)^```$/gms)]
    .filter(([, language]) => language !== 'sh')
    .map(({ 2: file, 3: text, index }) => ({
      file,
      line: page.slice(0, index).split('\n').length,
      text,
    }));
}

/** Whether the lines stand in the file, one after the other. */
function stands(text, file) {
  return `\n${linesOf(read(file)).join('\n')}\n`.includes(`\n${linesOf(text).join('\n')}\n`);
}

/** Whether a test compiles or runs the file: a program lists it, or a test includes or imports it. */
function isTested(file) {
  const name = basename(file);
  if (name === 'CMakeLists.txt') return true;
  if (name.endsWith('.cpp')) return filesLike('*CMakeLists.txt').some((list) => read(list).includes(name));
  if (name.endsWith('.h')) {
    const included = `#include "${file.replace(/^(server|tests)\//, '')}"`;
    return filesLike('tests/*.cpp', 'tests/*.h', 'server/*.cpp').some((source) => read(source).includes(included));
  }
  return filesLike('tests/*.test.mjs').some((source) => read(source).includes(`/${name}'`));
}

// Faults: code that was changed and not on the page; a block that nobody compares.
test('the code of the tutorial stands in the files that it names', () => {
  const faults = excerpts().flatMap(({ file, line, text }) => {
    if (file === '') return [`${kPage}:${line}: names no file`];
    if (!filesLike(file).includes(file)) return [`${kPage}:${line}: ${file} does not exist`];
    return stands(text, file) ? [] : [`${kPage}:${line}: is not in ${file}`];
  });
  assert.deepEqual(faults, []);
  assert.ok(excerpts().length >= 15, `${excerpts().length} blocks`);
});

// Fault: an example that was taken out of the build, and rots.
test('tests compile or run each file of the tutorial', () => {
  const files = new Set(excerpts().map(({ file }) => file));
  assert.deepEqual(
    [...files].filter((file) => !isTested(file)),
    [],
  );
});

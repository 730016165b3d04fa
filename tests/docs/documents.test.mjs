import assert from 'node:assert/strict';
import { execFileSync } from 'node:child_process';
import { existsSync, readFileSync } from 'node:fs';
import { dirname, join, normalize } from 'node:path';
import { test } from 'node:test';
import { fileURLToPath } from 'node:url';

const kRoot = fileURLToPath(new URL('../..', import.meta.url));
const kBinary = process.env.GROVE_BINARY ?? join(kRoot, 'build/release/grove');
const kPages = execFileSync('git', ['ls-files', '*.md'], { cwd: kRoot, encoding: 'utf8' }).trim().split('\n');

const read = (page) => readFileSync(join(kRoot, page), 'utf8');
const proseOf = (text) => text.replaceAll(/^```.*?^```/gms, '');
const lineCount = (text) => text.trimEnd().split('\n').length;

/** The anchors of a page's headings, as GitHub makes them. */
function anchorsOf(page) {
  const headings = proseOf(read(page)).matchAll(/^#+ (.*)$/gm);
  return [...headings].map(([, heading]) =>
    heading
      .toLowerCase()
      .replaceAll(/[^\p{L}\p{N}\- ]/gu, '')
      .replaceAll(' ', '-'),
  );
}

/** What is wrong with a link of a page; nothing if it resolves. */
function faultOf(page, link) {
  const [path, anchor] = link.split('#');
  const target = path === '' ? page : normalize(join(dirname(page), path));
  if (!existsSync(join(kRoot, target))) return `${page}: ${link} does not exist`;
  if (anchor && target.endsWith('.md') && !anchorsOf(target).includes(anchor)) return `${page}: ${link} has no heading`;
  return null;
}

/** The options that a command's help lists. */
function optionsOf(...command) {
  const help = execFileSync(kBinary, [...command, '--help'], { encoding: 'utf8' });
  return new Set([...help.matchAll(/^ {2}(?:-\w,)?(--[\w.-]+)/gm)].map(([, option]) => option));
}

// Fault: a link to a page or a heading that has moved.
test('links between documents resolve', () => {
  const faults = kPages.flatMap((page) => {
    const links = [...proseOf(read(page)).matchAll(/\]\(([^)\s]+)\)/g)].map(([, link]) => link);
    return links.filter((link) => !/^https?:/.test(link)).map((link) => faultOf(page, link));
  });
  assert.deepEqual(faults.filter(Boolean), []);
});

// Fault: pages that nobody reads to their end.
test('the README and ARCHITECTURE are short, and no page is long', () => {
  const readme = read('README.md');
  assert.ok(lineCount(readme) <= 200, `${lineCount(readme)} lines`);
  const words = readme.trim().split(/\s+/).length;
  assert.ok(words <= 1800, `${words} words`);
  assert.ok(lineCount(read('ARCHITECTURE.md')) <= 250);
  for (const page of kPages.filter((path) => path !== 'CHANGELOG.md')) assert.ok(lineCount(read(page)) <= 300, page);
});

// Fault: a page that no reader finds.
test('the README names each page of docs, and ARCHITECTURE each README of the source', () => {
  const isNamed = (page) => read(/^(server|web)\//.test(page) ? 'ARCHITECTURE.md' : 'README.md').includes(`(${page})`);
  const pages = kPages.filter((page) => /^docs\/|^(server|web)\/.*README\.md$/.test(page));
  assert.deepEqual(pages.filter((page) => !isNamed(page)), []);
});

// Fault: a folder in which a newcomer finds nothing.
test('no folder of the source holds more than 25 files', () => {
  const files = execFileSync('git', ['ls-files', 'server', 'web'], { cwd: kRoot, encoding: 'utf8' }).trim().split('\n');
  const counts = {};
  for (const file of files.filter((path) => existsSync(join(kRoot, path)))) {
    counts[dirname(file)] = (counts[dirname(file)] ?? 0) + 1;
  }
  assert.deepEqual(Object.entries(counts).filter(([, count]) => count > 25), []);
});

// Faults: a new option that the page lacks; one that is gone and still there.
test('the page of options has those of grove serve, and no others', () => {
  const rows = read('docs/options.md').matchAll(/^\| (`--.*?) \|/gm);
  const told = new Set([...rows].flatMap(([, cell]) => [...cell.matchAll(/--[\w-]+/g)].map(([option]) => option)));
  const known = optionsOf('serve');
  known.delete('--help');
  assert.deepEqual([...told].sort(), [...known].sort());
});

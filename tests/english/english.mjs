// Checks the English of documents and of comments with write-good and the phrases of house_style.mjs. Prints each
// finding as FILE:LINE and exits with 1 if there is one.
import { execFileSync } from 'node:child_process';
import { existsSync, readFileSync } from 'node:fs';
import { join } from 'node:path';
import { fileURLToPath } from 'node:url';
import writeGood from 'write-good';
import { oddPhrases } from './house_style.mjs';

const kRoot = fileURLToPath(new URL('../..', import.meta.url));
const kSources = ['*.md', 'server/*.h', 'server/*.cpp', 'web/*.js', 'shaders/*', ':!CHANGELOG.md'];
// Leaves repeated words and clichés. What the others find has its place in a description.
const kChecks = { passive: false, adverb: false, weasel: false, tooWordy: false, so: false, thereIs: false };

const blank = (part) => part.replaceAll(/[^\n]/g, ' ');
/** A word of the same length, so that the words beside it are no neighbours; `place` makes words differ. */
const word = (part, place) => 'abcdefghijklmnopqrstuvwxyz'[place % 26].repeat(part.length);

/** The paragraphs of a document as {line, text}; code is blank. */
function paragraphsOf(text) {
  const lines = text.replaceAll(/^```.*?^```/gms, blank).replaceAll(/`[^`\n]*`|\]\([^)\n]*\)/g, word).split('\n');
  return blocksOf(lines.map((line) => (/^\s*$/.test(line) ? null : line)));
}

/** Comments as {line, text}: those on lines of their own that follow each other are one, those behind code one each. */
function commentsOf(text) {
  const withoutStrings = text.replaceAll(/"(?:\\.|[^"\\\n])*"/g, word).replaceAll(/`[^`\n]*`/g, word);
  const lines = withoutStrings.split('\n').map((line) => {
    const [, code, comment] = line.match(/^(.*?)(?:\/\/+<?|\/\*\*?|^\s*\*(?!\/))(.*)$/) ?? [];
    const isTable = /^ {4}/.test(comment ?? '');
    if (comment === undefined || isTable || /^\s*(namespace|NOLINT)\b/.test(comment)) return null;
    return { alone: code.trim() === '', text: comment.replace(/\*\/\s*$/, '') };
  });
  const alone = blocksOf(lines.map((line) => (line?.alone ? line.text : null)));
  const behind = lines.flatMap((line, i) => (line && !line.alone ? [{ line: i + 1, text: line.text }] : []));
  return [...alone, ...behind];
}

/** Joins lines that follow each other; null ends a block. */
function blocksOf(lines) {
  const blocks = [];
  lines.forEach((text, i) => {
    if (text === null) return;
    if (i > 0 && lines[i - 1] !== null) blocks.at(-1).text += `\n${text}`;
    else blocks.push({ line: i + 1, text });
  });
  return blocks;
}

function findingsOf(file) {
  const source = readFileSync(join(kRoot, file), 'utf8');
  const blocks = file.endsWith('.md') ? paragraphsOf(source) : commentsOf(source);
  return blocks.flatMap(({ line, text }) =>
    [...writeGood(text, kChecks), ...oddPhrases(text)].map(
      ({ index, reason }) => `${file}:${line + text.slice(0, index).split('\n').length - 1}: ${reason}`,
    ),
  );
}

const files = execFileSync('git', ['ls-files', ...kSources], { cwd: kRoot, encoding: 'utf8' }).trim().split('\n');
const findings = files.filter((file) => existsSync(join(kRoot, file))).flatMap(findingsOf);
for (const finding of findings) console.log(finding);
if (findings.length > 0) {
  console.log(`${findings.length} findings; tests/english/house_style.mjs has the phrases`);
  process.exit(1);
}

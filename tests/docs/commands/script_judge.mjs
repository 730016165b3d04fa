import { faultOfGrove } from './grove_judge.mjs';
import { exists, isExecutable, read } from './repository.mjs';

/** The comment at the head of a script, which describes its use. */
const usageOf = (script) => read(script).match(/^#!.*\n((?:#.*\n)*)/)?.[1] ?? '';

/** Whether words of a usage, one after the other, are these. */
const hasWords = (usage, words) => new RegExp(`(^|[\\s\`,])${words}(?=[\\s\`,.:]|$)`, 'm').test(usage);

function faultOfOptions(script, words) {
  if (hasWords(usageOf(script), words[0])) return null;
  // Its options are those of the server that it starts.
  if (/\bserve "\$@"/.test(read(script))) return faultOfGrove(['serve', ...words]);
  return `${script} has no ${words[0]}`;
}

/** Scripts of deploy/, and files there that prose names. */
export function faultOfScript(script, words, typed) {
  if (!exists(script)) return `${script} does not exist`;
  if ((typed || words.length > 0) && !isExecutable(script)) return `${script} is not executable`;
  if (words.length === 0) return null;
  if (words[0].startsWith('-')) return faultOfOptions(script, words);
  if (!hasWords(usageOf(script), `${script} ${words[0]}`)) return `${script} does not know ${words[0]}`;
  const below = `deploy/checks/${words[0]}`;
  const usage = usageOf(script) + (exists(below) ? usageOf(below) : '');
  const unknown = words.slice(1).find((word) => !hasWords(usage, word));
  return unknown ? `${script} ${words[0]} does not know ${unknown}` : null;
}

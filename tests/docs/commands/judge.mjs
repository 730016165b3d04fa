import { faultOfCmake, faultOfCtest, faultOfNode, faultOfNpm, faultOfTestProgram } from './build_judge.mjs';
import { faultOfGrove } from './grove_judge.mjs';
import { exists } from './repository.mjs';
import { faultOfScript } from './script_judge.mjs';

/** Commands that nothing here can judge, each with the reason. */
export const kUnjudged = [
  { starts: 'apt ', reason: 'needs root; deploy/test package installs and purges the package' },
  { starts: 'systemctl ', reason: 'needs systemd and root; deploy/test package runs the service' },
  { starts: 'journalctl ', reason: 'needs systemd' },
  { starts: 'man grove', reason: 'needs the installed page; ManualPage in tests/cli compares it with help' },
  { starts: 'openssl req ', reason: "another project's program; tests/base/tls makes certificates with it" },
  { starts: 'blender ', reason: "another project's program; the file of its script is checked" },
  { starts: 'cp ', reason: 'its files are checked, not its options' },
];

const kBuiltins = {
  cmake: faultOfCmake,
  ctest: faultOfCtest,
  npm: faultOfNpm,
  node: faultOfNode,
  grove: faultOfGrove,
  'build/release/grove': faultOfGrove,
};

/** The rule of an unjudged command. */
export const unjudgedBy = (command) => kUnjudged.find(({ starts }) => `${command} `.startsWith(starts));

/** A file of the repository that a command names and that is not there. */
function missingFile(words) {
  return words
    .filter((word) => /^(tests|server|shaders|docs|web)\/[\w./*-]+$/.test(word))
    .find((word) => !exists(word));
}

/** What is wrong with a command; null if nothing. One that is `typed` is complete, others are parts of a sentence. */
export function faultOf(command, typed = false) {
  const [program, ...words] = command.replaceAll('"', '').split(/\s+/);
  const missing = missingFile(words);
  if (missing) return `${missing} does not exist`;
  if (unjudgedBy(command)) return null;
  if (kBuiltins[program]) return kBuiltins[program](words, typed);
  if (/^(deploy|\.ci)\//.test(program)) return faultOfScript(program, words, typed);
  if (/^build\/\w+\/tests\//.test(program)) return faultOfTestProgram(program, words);
  return `nobody knows how to judge ${program}`;
}

import assert from 'node:assert/strict';
import { execFileSync } from 'node:child_process';
import { test } from 'node:test';
import { commandsOf, loneOptionsOf, optionsOfCommandsOf } from './commands/extract.mjs';
import { kBinary } from './commands/grove_help.mjs';
import { faultOfLoneOption } from './commands/grove_judge.mjs';
import { faultOf, kUnjudged, unjudgedBy } from './commands/judge.mjs';
import { files, read } from './commands/repository.mjs';

const kPages = files.filter((file) => file.endsWith('.md'));
const kCommands = kPages.flatMap((page) => [...commandsOf(page), ...optionsOfCommandsOf(page)]);
const kGrove = /^(build\/release\/)?grove /;

/** Commands that end at once and need nothing: help, the version, and a bench of the smallest size. */
function isQuick(command) {
  if (!kGrove.test(command)) return false;
  return /^\S+ (--version|(.* )?--help)$|^\S+ bench fluid (?=.*--grid 16\b)(?=.*--steps \d\b).*--json$/.test(command);
}

// Faults: a sub-command, an option, a preset, a target, a test, a script or a file that is gone, and still on a page.
test('what the commands of all documents name exists', () => {
  const faults = kCommands.flatMap(({ page, line, command, fenced }) => {
    const fault = faultOf(command, fenced);
    return fault ? [`${page}:${line}: ${command}: ${fault}`] : [];
  });
  assert.deepEqual(faults, []);
  assert.ok(kCommands.length > 150, `${kCommands.length} commands`);
});

// Fault: commands in a block whose language is written otherwise, so that nothing here reads them.
test('blocks of documents have a language that the tests know', () => {
  const known = ['', 'sh', 'ini', 'cpp', 'cmake', 'js'];
  const faults = kPages.flatMap((page) => {
    const blocks = [...read(page).matchAll(/^ *```(\w*).*\n(.*?)^ *```$/gms)];
    const isFault = ([, language, text]) =>
      !known.includes(language) || (language === '' && /^\s*\$ |^grove /m.test(text));
    return blocks.filter(isFault).map(([block]) => `${page}: ${block.split('\n')[0]}`);
  });
  assert.deepEqual(faults, []);
});

// Fault: an option in prose that no command has.
test('a command of grove has each option that a page names alone', () => {
  const faults = kPages.flatMap(loneOptionsOf).flatMap(({ page, line, option }) => {
    const fault = faultOfLoneOption(option);
    return fault ? [`${page}:${line}: ${fault}`] : [];
  });
  assert.deepEqual(faults, []);
});

// Fault: a quick command that a page shows, and that fails.
test('quick commands run', () => {
  const quick = new Set(kCommands.map(({ command }) => command).filter(isQuick));
  assert.ok(quick.size >= 2, [...quick].join(', '));
  for (const command of quick) {
    const output = execFileSync(kBinary, command.split(' ').slice(1), { encoding: 'utf8' });
    assert.notEqual(output.trim(), '', command);
    if (command.endsWith('--json')) assert.equal(typeof JSON.parse(output), 'object', command);
  }
});

// Fault: a rule that excuses commands that no page shows any more.
test('each rule for commands that cannot be judged is needed', () => {
  const needed = new Set(kCommands.map(({ command }) => unjudgedBy(command)));
  assert.deepEqual(
    kUnjudged.filter((rule) => !needed.has(rule)),
    [],
  );
});

// Fault: a judge that finds nothing, with which every page is right.
test('the judges find what is wrong', () => {
  const wrong = [
    'grove serf',
    'grove serve --listn 127.0.0.1:0',
    'grove bake --plant palm -o palm.glf',
    'grove bake --plant oak',
    'grove load --sessions 2',
    'grove bench',
    'grove bench fluid 64',
    'build/release/grove bench view --walk tests/walks/none.walk',
    'deploy/rum',
    'deploy/run --listn 0.0.0.0:80',
    'deploy/tables --listen 0.0.0.0:80',
    'deploy/packages/build.txt',
    'deploy/test everything',
    'deploy/test pack',
    'deploy/test soak showers',
    'deploy/common.sh now',
    'cmake --preset fast',
    'cmake --preset release -DGROVE_TEST=ON',
    'cmake --build build/release --target groves',
    'ctest --preset dev -R no_such_test',
    'ctest --test-dir build/fast',
    'build/release/tests/gl/stream_encode_test',
    "build/release/tests/stream/stream_encode_test --gtest_filter='NoSuite.*'",
    'npm run photos --prefix tests/browser',
    'npm run pictures --prefix tests/none',
    'node tests/none.mjs',
    'make all',
  ];
  assert.deepEqual(
    wrong.filter((command) => faultOf(command, true) === null),
    [],
  );
});

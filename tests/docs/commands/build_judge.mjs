import { exists, files, read } from './repository.mjs';

const kPresets = JSON.parse(read('CMakePresets.json'));
const kLists = files.filter((file) => file.endsWith('CMakeLists.txt'));
const kTargets = new Set(['all', 'all_verify_interface_header_sets']);
const kTests = new Map();
for (const list of kLists) {
  for (const [, name] of read(list).matchAll(
    /\b(?:grove_library|add_library|add_executable|add_custom_target)\((\w+)/g,
  )) {
    kTargets.add(name);
  }
  for (const [, name] of read(list).matchAll(/\bgrove_test\((\w+)/g))
    kTests.set(name, list.replace('/CMakeLists.txt', ''));
}

const valueOf = (words, option) => (words.includes(option) ? words[words.indexOf(option) + 1] : undefined);
const hasPreset = (kind, name) => kPresets[kind].some((preset) => preset.name === name && !preset.hidden);
const faultOfPreset = (kind, name) =>
  name && !hasPreset(kind, name) ? `CMakePresets.json has no ${kind} ${name}` : null;
/** A build folder is named after its preset. */
const faultOfFolder = (folder) =>
  folder && !folder.startsWith('-') ? faultOfPreset('configurePresets', folder.replace(/^build\//, '')) : null;

function faultOfTarget(name) {
  return name && !kTargets.has(name) && !kTests.has(name) ? `there is no target ${name}` : null;
}

export function faultOfCmake(words) {
  const folder = valueOf(words, '--build') ?? valueOf(words, '--install');
  const kind = words[0] === '--build' ? 'buildPresets' : 'configurePresets';
  const unknown = words.filter(
    (word) => /^-/.test(word) && !/^(-D\w+=\w+|--(build|install|preset|target))$/.test(word),
  );
  if (unknown.length > 0) return `cmake's ${unknown[0]} is not known to this test`;
  const switches = words.filter((word) => /^-DGROVE_/.test(word)).map((word) => word.match(/^-D(\w+)/)[1]);
  const missing = switches.find((name) => !new RegExp(`\\b${name}\\b`).test(read('CMakeLists.txt')));
  if (missing) return `CMakeLists.txt has no ${missing}`;
  return (
    faultOfPreset(kind, valueOf(words, '--preset')) ??
    faultOfFolder(folder) ??
    faultOfTarget(valueOf(words, '--target'))
  );
}

export function faultOfCtest(words) {
  const wanted = valueOf(words, '-R');
  const isKnown = !wanted || [...kTests.keys()].some((name) => new RegExp(wanted).test(name));
  if (!isKnown) return `no test is called ${wanted}`;
  return faultOfPreset('testPresets', valueOf(words, '--preset')) ?? faultOfFolder(valueOf(words, '--test-dir'));
}

/** A test program in a build folder, with the suite that its filter names. */
export function faultOfTestProgram(program, words) {
  const [, preset, folder, name] = program.match(/^build\/(\w+)\/(tests\/[\w/]+)\/(\w+)$/) ?? [];
  if (!name) return `${program} is no test program`;
  const isFuzzer = preset === 'fuzz' && kTargets.has(name);
  if (kTests.get(name) !== folder && !isFuzzer) return `${folder} has no test program ${name}`;
  const [, suite] = words.join(' ').match(/--gtest_filter='?(\w+)\./) ?? [];
  const sources = files.filter((file) => file.startsWith(`${folder}/`) && file.endsWith('_test.cpp'));
  const isThere = !suite || sources.some((file) => new RegExp(`^TEST(_F|_P)?\\(${suite},`, 'm').test(read(file)));
  return isThere ? faultOfPreset('configurePresets', preset) : `${name} has no suite ${suite}`;
}

export function faultOfNpm(words) {
  const folder = valueOf(words, '--prefix') ?? '.';
  if (!exists(`${folder}/package.json`)) return `${folder} has no package.json`;
  const script = words[0] === 'run' ? words[1] : words[0];
  if (script === 'ci') return null;
  const { scripts = {} } = JSON.parse(read(`${folder}/package.json`));
  return script in scripts ? null : `${folder} has no script ${script}`;
}

export function faultOfNode(words) {
  const missing = words.filter((word) => !word.startsWith('-') && !exists(word));
  return missing.length > 0 ? `${missing[0]} does not exist` : null;
}

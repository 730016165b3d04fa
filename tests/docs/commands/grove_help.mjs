import { execFileSync } from 'node:child_process';
import { join } from 'node:path';
import { kRoot } from './repository.mjs';

export const kBinary = process.env.GROVE_BINARY ?? join(kRoot, 'build/release/grove');

const known = new Map();

/** What `grove COMMAND --help` lists: options (with the values that they can have), sub-commands, positionals. */
export function helpOf(command) {
  const key = command.join(' ');
  if (!known.has(key)) {
    const text = execFileSync(kBinary, [...command, '--help'], { encoding: 'utf8' });
    const options = new Map();
    for (const [, short, long, about] of text.matchAll(/^ {2}(?:(-\w),)?(--[\w.-]+)(.*)$/gm)) {
      const [, values] = about.match(/^ \{([^}]*)\}/) ?? [];
      const names = [short, long].filter(Boolean);
      const option = {
        names,
        values: values?.split(','),
        isList: /^ \{[^}]*\} \.\.\./.test(about),
        isFlag: !/^ [A-Z{[]/.test(about),
        isRequired: about.includes(' REQUIRED'),
      };
      for (const name of names) options.set(name, option);
    }
    const [, commands = ''] = text.split(/^Subcommands:$/m);
    const [, positionals = ''] = text.match(/^Positionals:\n(.*?)\n\n/ms) ?? [];
    known.set(key, {
      options,
      commands: [...commands.matchAll(/^ {2}([a-z]+) /gm)].map(([, name]) => name),
      positionals: [...positionals.matchAll(/^ {2}(\w+) (.*)$/gm)].map(([, name, about]) => ({
        name,
        isRequired: about.includes('REQUIRED'),
      })),
    });
  }
  return known.get(key);
}

/** Every command as a list of words, `grove` itself first. */
export function allCommands(above = []) {
  return [above, ...helpOf(above).commands.flatMap((name) => allCommands([...above, name]))];
}

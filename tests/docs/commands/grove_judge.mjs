import { allCommands, helpOf } from './grove_help.mjs';

const isOption = (word) => /^--?[a-z]/.test(word);
/** `--link-tls-…` stands for all options that begin so. */
const isIn = (options, name) =>
  name.endsWith('…') ? [...options.keys()].some((known) => known.startsWith(name.slice(0, -1))) : options.has(name);
/** A name for a value, as in `--walk FILE`; such words are not checked. */
const isPlaceholder = (word) => /^[A-Z][A-Z:./_a-z]*$/.test(word) || word === 'SUBSTITUTED';

/** Options that prose names alone. */
export function faultOfLoneOption(name) {
  const isKnown = allCommands().some((command) => isIn(helpOf(command).options, name));
  return isKnown ? null : `no command of grove has ${name}`;
}

function faultOfOption(command, words, at) {
  const [name, joined] = words[at].split('=');
  const { options, commands } = helpOf(command);
  // Of `grove bench --transport grpc`, several benches have the option.
  const below = commands.map((sub) => helpOf([...command, sub]).options);
  if (!isIn(options, name) && !below.some((known) => isIn(known, name))) return `${command.join(' ')} has no ${name}`;
  const value = joined ?? words[at + 1];
  const { values, isList } = options.get(name) ?? {};
  if (!values || !value || isOption(value) || isPlaceholder(value)) return null;
  const given = isList ? value.split(',') : [value];
  return given.every((one) => values.includes(one)) ? null : `${name} of ${command.join(' ')} cannot be ${value}`;
}

/** What a command that is to be typed lacks. */
function missingOf(command, rest, places) {
  const { options, commands, positionals } = helpOf(command);
  if (commands.length > 0 && rest.length === 0) return `grove ${command.join(' ')} needs a sub-command`;
  const option = [...options.values()].find(
    ({ names, isRequired }) => isRequired && !names.some((name) => rest.includes(name)),
  );
  if (option) return `grove ${command.join(' ')} needs ${option.names.at(-1)}`;
  const given = positionals.length - places;
  const place = positionals.find(({ isRequired }, i) => isRequired && i >= given);
  return place ? `grove ${command.join(' ')} needs ${place.name}` : null;
}

/** What is wrong with the arguments of `grove`; null if nothing. One that is `typed` is complete. */
export function faultOfGrove(words, typed = false) {
  const plain = words.map((word) => word.replace(/^\[|\]$/g, ''));
  const command = [];
  while (helpOf(command).commands.includes(plain[command.length])) command.push(plain[command.length]);
  const rest = plain.slice(command.length);
  const { options, positionals } = helpOf(command);
  let places = positionals.length;
  for (let i = 0; i < rest.length; i += 1) {
    if (isOption(rest[i])) {
      const fault = faultOfOption(command, rest, i);
      if (fault) return fault;
      const takesNext = !rest[i].includes('=') && !(options.get(rest[i])?.isFlag ?? false);
      if (takesNext && i + 1 < rest.length && !isOption(rest[i + 1])) i += 1;
    } else if (places > 0) {
      places -= 1;
    } else {
      return `grove ${command.join(' ')} does not take ${rest[i]}`;
    }
  }
  return typed ? missingOf(command, rest, places) : null;
}

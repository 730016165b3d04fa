import { read } from './repository.mjs';

/** Programs that make inline code a command; other inline code is a name. */
const kPrograms =
  /^(?:[A-Z_]+=\S* )*(?:sudo )?(?:grove|build\/release\/grove|build\/\w+\/tests\/\S+|deploy\/\S+|\.ci\/\S+|cmake|ctest|npm|node|npx|apt|systemctl|journalctl|man|openssl)(?= |$)/;
const kShellWords = /^(?:for .*|do|done|then|fi|if .*)$/;

/**
 * What a page says of the present program. Of the history: the next version only, without what it removes, because
 * earlier versions had options of their own.
 */
function presentOf(page) {
  const text = read(page);
  if (page !== 'CHANGELOG.md') return text;
  const [next] = text.split(/^(?=## \[\d)/m);
  return next.replace(/^### Removed$.*?(?=^### |(?![^]))/ms, (part) => part.replaceAll(/[^\n]/g, ''));
}

/** The simple commands of a line of shell, without comments, assignments, redirections and `sudo`. */
function commandsOfLine(line) {
  const inner = [...line.matchAll(/\$\(([^()]*)\)/g)].flatMap(([, part]) => commandsOfLine(part));
  const outer = line
    .replaceAll(/\$\([^()]*\)/g, 'SUBSTITUTED')
    .replace(/(^|\s)#.*$/, '')
    .split(/&&|\|\||[;&]|(?<!\\)\|/)
    .map((part) =>
      part
        .trim()
        .replace(/^do /, '')
        .replace(/^(?:[A-Z_]+=\S* )+/, '')
        .replace(/^sudo /, ''),
    );
  return [...inner, ...outer.filter((command) => command !== '' && !kShellWords.test(command))];
}

/** The commands of fenced blocks of shell, as {page, line, command, fenced}. */
function fenced(page, text) {
  return [...text.matchAll(/^ *```sh\n(.*?)^ *```$/gms)].flatMap(({ 1: block, index }) => {
    let line = text.slice(0, index).split('\n').length + 1;
    return block.split(/(?<!\\)\n/).flatMap((logical) => {
      const commands = commandsOfLine(logical.replaceAll(/\\\n\s*/g, ''));
      const found = commands.map((command) => ({ page, line, command, fenced: true }));
      line += logical.split('\n').length;
      return found;
    });
  });
}

/** A fenced block with nothing but its comments. */
const commentsOf = (block) =>
  block
    .split('\n')
    .map((line) => line.match(/\s# .*$/)?.[0] ?? '')
    .join('\n');

/** Inline code of prose, as {page, line, code}. */
function inlineCode(page, text) {
  const prose = text.replaceAll(/^ *```.*?^ *```/gms, commentsOf);
  return [...prose.matchAll(/`([^`]+)`/g)].map(({ 1: code, index }) => ({
    page,
    line: prose.slice(0, index).split('\n').length,
    code: code.replaceAll(/\s+/g, ' ').replaceAll('\\|', '|'),
  }));
}

/** All commands of a page. */
export function commandsOf(page) {
  const text = presentOf(page);
  const inline = inlineCode(page, text).filter(({ code }) => kPrograms.test(code));
  return [
    ...fenced(page, text),
    ...inline.map(({ line, code }) => ({
      page,
      line,
      command: code.replace(/^(?:[A-Z_]+=\S* )*(?:sudo )?/, ''),
      fenced: false,
    })),
  ];
}

/** Options with their command behind them, as in "`--view-error PX` of `grove node`", as commands. */
export function optionsOfCommandsOf(page) {
  const text = presentOf(page);
  return [...text.matchAll(/`(--[\w.-]+…?)[^`]*`\s+of\s+`(grove[a-z ]*)`/g)].map(({ 1: option, 2: grove, index }) => ({
    page,
    line: text.slice(0, index).split('\n').length,
    command: `${grove} ${option}`,
    fenced: false,
  }));
}

/** Options that a page names without their command. */
export function loneOptionsOf(page) {
  return inlineCode(page, presentOf(page)).flatMap(({ line, code }) =>
    code.startsWith('--')
      ? [...code.matchAll(/(?:^| )(--[\w.-]+…?)/g)].map(([, option]) => ({ page, line, option }))
      : [],
  );
}

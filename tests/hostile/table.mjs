/** The table that a person reads, a row at a time. */

const kColumns = [
  ['attack', 48, (row) => row.attack],
  ['alone', 6, ({ visitor }) => number(visitor?.calmFramesPerSecond, 1)],
  ['fps', 6, ({ visitor }) => number(visitor?.framesPerSecond, 1)],
  ['p99 ms', 7, ({ visitor }) => number(visitor?.p99Milliseconds)],
  ['wait s', 7, ({ visitor }) => number(visitor?.longestGapSeconds, 2)],
  ['MB before/peak/after', 21, ({ resident }) => threeOf(resident)],
  ['descriptors', 14, ({ descriptors }) => threeOf(descriptors)],
  ['cores', 11, ({ cores }) => (cores ? `${number(cores.before, 2)} ${number(cores.during, 2)}` : '–')],
  ['lines', 6, (row) => (row.visitor ? number(row.log.lines) : '–')],
  ['bounds', 7, (row) => (row.met ? 'ok' : 'MISSED')],
];

const number = (value, digits = 0) => (typeof value === 'number' ? value.toFixed(digits) : '–');
const threeOf = (held) => (held ? [held.before, held.peak, held.after].map((value) => number(value)).join('/') : '–');

const inColumns = (texts) =>
  kColumns
    .map(([, width], index) => (index === 0 ? texts[index].padEnd(width) : texts[index].padStart(width)))
    .join(' ');

/** `closedByServer: 3` becomes `closed by server 3`. */
function inWords(did) {
  const word = (key) => key.replace(/[A-Z]/g, (letter) => ` ${letter.toLowerCase()}`);
  const text = (value) => {
    if (typeof value === 'number') return number(value, Number.isInteger(value) ? 0 : 1);
    if (Array.isArray(value)) return value.join(' ');
    return value !== null && typeof value === 'object' ? `(${inWords(value)})` : String(value);
  };
  return Object.entries(did)
    .filter(([, value]) => value !== undefined && value !== '')
    .map(([key, value]) => `${word(key)} ${text(value)}`)
    .join(', ');
}

export const header = () => inColumns(kColumns.map(([title]) => title));

export function textOf(row) {
  const lines = [inColumns(kColumns.map(([, , cell]) => cell(row)))];
  if (row.did) lines.push(`    ${inWords(row.did)}`);
  for (const { bound, measured, met } of row.bounds) if (!met) lines.push(`    MISSED ${bound}: ${measured}`);
  return lines.join('\n');
}

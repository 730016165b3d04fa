import { kStatistics } from './texts.js';

/** Stands for an unknown figure. */
export const kUnknown = '\u2013';

/** A server's count, time or size; `null` for any other value. */
export function known(value) {
  return typeof value === 'number' && Number.isFinite(value) && value >= 0 ? value : null;
}

/** As many digits as a reader takes in at a glance: 1,234, 48.2, 1.31, 0.02. */
export function plain(value) {
  if (known(value) === null) return kUnknown;
  if (value >= 99.95) return Math.round(value).toLocaleString('en');
  return fixed(value, value >= 9.995 ? 1 : 2);
}

/** For columns: a fixed number of decimals, and `< 0.01` instead of a value that rounds to zero. */
export function fixed(value, decimals) {
  if (known(value) === null) return kUnknown;
  if (value === 0) return '0';
  const least = 10 ** -decimals;
  if (value < least / 2) return `< ${least.toFixed(decimals)}`;
  return value.toLocaleString('en', { minimumFractionDigits: decimals, maximumFractionDigits: decimals });
}

export function whole(value) {
  return known(value) === null ? kUnknown : Math.round(value).toLocaleString('en');
}

/** A share (0..1), such as alpha and beta: 0.78. Only 0 and 1 themselves look like 0 and 1. */
export function share(value) {
  if (known(value) === null) return kUnknown;
  if (value > 0.99 && value < 1) return '> 0.99';
  return value > 0 && value < 0.005 ? '< 0.01' : value.toFixed(2);
}

export function percent(value) {
  if (known(value) === null) return kUnknown;
  if (value > 0.99 && value < 1) return '> 99 %';
  return value > 0 && value < 0.005 ? '< 1 %' : `${Math.round(value * 100)} %`;
}

export function milliseconds(value) {
  return known(value) === null ? kUnknown : `${plain(value)} ms`;
}

/** From decimal megabytes: 752 MB, 1.44 GB. */
export function megabytes(value) {
  if (known(value) === null) return kUnknown;
  return value >= 999.5 ? `${plain(value / 1000)} GB` : `${plain(value)} MB`;
}

/** From megabits a second: 40 kbit/s, 4.2 Mbit/s. */
export function bitRate(value) {
  if (known(value) === null) return kUnknown;
  return value < 0.9995 ? `${plain(value * 1000)} kbit/s` : `${value.toFixed(1)} Mbit/s`;
}

/** `1 visitor`, `8 visitors`. */
export function visitors(count) {
  return kStatistics.visitors(count, whole(count));
}

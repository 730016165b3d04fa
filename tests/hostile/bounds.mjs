/** What must hold in spite of an attack: `{ bound, measured, met }`. */

const kKeptShare = 0.93;

const rounded = (number) => (typeof number === 'number' ? Math.round(number * 100) / 100 : number);

export function atMost(what, measured, limit, unit = '') {
  const met = typeof measured === 'number' && measured <= limit;
  return { bound: `${what} at most ${rounded(limit)}${unit}`, measured: rounded(measured), met };
}

export function atLeast(what, measured, limit, unit = '') {
  const met = typeof measured === 'number' && measured >= limit;
  return { bound: `${what} at least ${rounded(limit)}${unit}`, measured: rounded(measured), met };
}

export function is(what, measured, expected = true) {
  return { bound: expected === true ? what : `${what}: ${expected}`, measured, met: measured === expected };
}

/** The innocent visitor has nearly the frames that he had on the same server just before. */
export function keepsHisRate({ visitor }, share = kKeptShare) {
  return atLeast('frames a second', visitor.framesPerSecond, share * visitor.calmFramesPerSecond);
}

/** He is not sent away, and never waits longer for a frame. */
export function neverStops({ visitor }, seconds = 1) {
  if (visitor.ended !== null) return { bound: 'he stays', measured: visitor.ended, met: false };
  return atMost('his longest wait for a frame', visitor.longestGapSeconds, seconds, ' s');
}

/** The attack was really carried out: so much was sent. */
export const carriedOut = (what, count, least = 1) => atLeast(`carried out: ${what}`, count, least);

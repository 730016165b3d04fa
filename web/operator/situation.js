import { kSituations } from '../texts.js';

/**
 * What has to be said before the figures can be read, `null` if they speak for themselves. `state` is `asking`, `live`,
 * `paused` or `lost`; `heard` is the time of day of the newest answer, or `null`.
 */
export function situation(state, statistics, heard) {
  if (state === 'asking') return heard ? null : kSituations.asking;
  if (state === 'lost') {
    const { title, text } = kSituations.lost;
    return { title, text: `${heard ? kSituations.lastHeard(heard) : ''}${text}` };
  }
  if (state === 'paused') return kSituations.paused;
  const { amortization } = statistics;
  if (amortization === undefined) return kSituations.older;
  if (amortization === null) return statistics.visitors > 0 ? kSituations.first : kSituations.empty;
  return amortization.mode === 'private' ? kSituations.private : null;
}

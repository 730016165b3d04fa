import { kSituations } from '../texts.js';

/** A notice about the owner of the server's world, or `null`. */
function ownerSituation(world) {
  if (world?.state === 'refused') return kSituations.refused(world.reason);
  if (world?.state === 'connecting') return kSituations.connecting;
  return world?.state === 'lost' ? kSituations.ownerLost : null;
}

/**
 * The notice above the figures, or `null`. `state` is `asking`, `live`, `paused` or `lost`; `answeredAt` is the time of
 * day of the newest answer, or `null`.
 */
export function situation(state, statistics, answeredAt) {
  if (state === 'asking') return answeredAt ? null : kSituations.asking;
  if (state === 'lost') {
    const { title, text } = kSituations.lost;
    return { title, text: `${answeredAt ? kSituations.lastHeard(answeredAt) : ''}${text}` };
  }
  if (state === 'paused') return kSituations.paused;
  const owner = ownerSituation(statistics.world);
  if (owner) return owner;
  const { amortization } = statistics;
  if (amortization === undefined) return kSituations.older;
  if (amortization === null) return statistics.visitors > 0 ? kSituations.first : kSituations.empty;
  return null;
}

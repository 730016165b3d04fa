import { perUser } from '../amortization.js';

/**
 * The cost of one frame of one visitor, in milliseconds of CPU: the visitor's share of the work for everybody, own work
 * on backends and on the frontend, and the rest outside all stages (sockets, clocks, drivers). `alone` is the min cost
 * of the same frame in a separate world. `null` if the server has not reported enough.
 */
export function frameCost(amortization) {
  const { visitors, acrossUser, backend, frontend, privateFrame } = amortization;
  const own = perUser(amortization);
  if (acrossUser === null || own === null || !visitors) return null;
  const other = amortization.other ?? 0;
  const now = { shared: acrossUser / Math.max(1, visitors), backend, frontend, other };
  if (privateFrame === null) return { now, alone: null };
  return { now, alone: { shared: Math.max(now.shared, privateFrame - own - other), backend, frontend, other } };
}

export const total = (parts) => parts.shared + parts.backend + parts.frontend + parts.other;

import { perUser } from '../amortization.js';

/**
 * What one frame of one visitor costs, in milliseconds of CPU, part by part: his share of the work for everybody, his
 * own work on backends and on the frontend, and what no stage accounts for (sockets, clocks, drivers). Beside it what
 * the same frame costs at least if he has the world for himself. `null` if the server has not told enough; `alone` is
 * `null` if he is alone by `--private`.
 */
export function frameCost(amortization) {
  const { isPrivate, visitors, acrossUser, backend, frontend, privateFrame } = amortization;
  const own = perUser(amortization);
  if (acrossUser === null || own === null || !visitors) return null;
  const other = amortization.other ?? 0;
  const now = { shared: isPrivate ? acrossUser : acrossUser / Math.max(1, visitors), backend, frontend, other };
  if (isPrivate || privateFrame === null) return { now, alone: null };
  return { now, alone: { shared: Math.max(now.shared, privateFrame - own - other), backend, frontend, other } };
}

export const total = (parts) => parts.shared + parts.backend + parts.frontend + parts.other;

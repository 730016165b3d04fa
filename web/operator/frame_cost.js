import { perUser } from '../amortization.js';

/**
 * What one frame of one visitor costs, in milliseconds of CPU, part by part: his share of the work for everybody, his
 * own work on backends and on the frontend, and what no stage accounts for (sockets, clocks, drivers). Beside it what
 * the same frame costs at least if he has the world for himself: the server tells that in cores, relative to what a
 * visitor costs now. `null` if the server has not told enough; `alone` is `null` if he is alone by `--private`.
 */
export function frameCost(amortization) {
  const { isPrivate, visitors, framesPerSecond, acrossUser, backend, frontend } = amortization;
  const own = perUser(amortization);
  if (acrossUser === null || own === null || !visitors || !framesPerSecond) return null;
  const shared = isPrivate ? acrossUser : acrossUser / Math.max(1, visitors);
  const process = ((amortization.cpuCores ?? 0) * 1000) / (visitors * framesPerSecond);
  const other = Math.max(0, process - shared - own);
  const now = { shared, backend, frontend, other };
  return { now, alone: isPrivate ? null : alone(amortization, now) };
}

function alone({ visitors, visitorCores, privateCores }, { shared, backend, frontend, other }) {
  if (!visitorCores || privateCores === null) return null;
  const whole = (backend + frontend + other) * (privateCores / visitors / visitorCores);
  return { shared: Math.max(shared, whole - backend - frontend - other), backend, frontend, other };
}

export const total = (parts) => parts.shared + parts.backend + parts.frontend + parts.other;

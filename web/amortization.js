import { known } from './figures.js';

const isObject = (value) => typeof value === 'object' && value !== null && !Array.isArray(value);

/** `null` if `value` is no share (0..1), or if all `wholes` are 0. */
function part(value, wholes) {
  const number = known(value);
  return number !== null && number <= 1 && wholes.some((whole) => whole !== 0) ? number : null;
}

function costs(told) {
  const { c_i_ms: i, c_b_ms: b, c_f_ms: f, across_user_mb: across, per_visitor_mb: each } = told;
  return {
    acrossUser: known(i),
    backend: known(b),
    frontend: known(f),
    alpha: part(told.alpha, [i, b, f]),
    beta: part(told.beta, [across, each]),
    acrossUserMb: known(across),
    perVisitorMb: known(each),
  };
}

/**
 * The savings by sharing, from an answer of `/statistics.json` or `/sharing.json`; `null` if the server does not report
 * them. Missing or impossible figures are `null`. Times are milliseconds of CPU in one frame. `types` lists the costs
 * of each type of object; the entry without a name serves no single type.
 */
export function amortizationOf(statistics) {
  const told = statistics?.amortization;
  if (!isObject(told)) return null;
  const types = Object.entries(isObject(told.types) ? told.types : {}).filter(([, type]) => isObject(type));
  return {
    visitors: known(told.visitors),
    framesPerSecond: known(told.frames_per_second),
    ...costs(told),
    other: known(told.other_ms),
    privateFrame: known(told.private_frame_ms),
    cpuCores: known(told.cpu_cores),
    cores: known(told.cores),
    visitorCores: known(told.visitor_cores),
    visitorsFit: known(told.visitors_fit),
    privateCores: known(told.private_cores),
    privateVisitorsFit: known(told.private_visitors_fit),
    types: types.map(([name, type]) => ({ name, ...costs(type) })),
  };
}

/** Milliseconds of one frame that serve one visitor only; `null` if unknown. */
export function perUser({ backend, frontend }) {
  return backend === null || frontend === null ? null : backend + frontend;
}

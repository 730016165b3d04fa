import { known } from './figures.js';

const isObject = (value) => typeof value === 'object' && value !== null && !Array.isArray(value);

/** A share of one, else `null`. */
function part(value) {
  const number = known(value);
  return number !== null && number <= 1 ? number : null;
}

function costs(told) {
  return {
    acrossUser: known(told.c_i_ms),
    backend: known(told.c_b_ms),
    frontend: known(told.c_f_ms),
    alpha: part(told.alpha),
    beta: part(told.beta),
    acrossUserMb: known(told.across_user_mb),
    perVisitorMb: known(told.per_visitor_mb),
  };
}

/**
 * What sharing saves, of an answer of `/statistics.json`; `null` if the server does not tell. Figures that it does not
 * tell, or that cannot be, are `null`. Times are milliseconds of CPU in one frame. `types` is a list with the costs of
 * each type of object; the one without a name serves no single type.
 */
export function amortizationOf(statistics) {
  const told = statistics?.amortization;
  if (!isObject(told)) return null;
  const types = Object.entries(isObject(told.types) ? told.types : {}).filter(([, type]) => isObject(type));
  return {
    isPrivate: told.mode === 'private',
    visitors: known(told.visitors),
    framesPerSecond: known(told.frames_per_second),
    ...costs(told),
    cpuCores: known(told.cpu_cores),
    cores: known(told.cores),
    visitorCores: known(told.visitor_cores),
    visitorsFit: known(told.visitors_fit),
    privateCores: known(told.private_cores),
    privateVisitorsFit: known(told.private_visitors_fit),
    types: types.map(([name, type]) => ({ name, ...costs(type) })),
  };
}

/** Milliseconds of one frame that are for one visitor only; `null` if not known. */
export function perUser({ backend, frontend }) {
  return backend === null || frontend === null ? null : backend + frontend;
}

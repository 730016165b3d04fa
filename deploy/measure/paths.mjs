import { fileURLToPath } from 'node:url';

export const kRoot = fileURLToPath(new URL('../..', import.meta.url));
/** What was measured: a JSON file for each part, and the plots. Relative to the root. */
export const kMeasured = 'deploy/measured';

export const say = (words) => console.error(`\x1b[1m${words}\x1b[0m`);

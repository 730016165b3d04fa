/**
 * Who comes from where. The server limits what one address may have, except the loopback address itself, from which the
 * innocent visitor comes as the one behind a reverse proxy does.
 */
export const kInnocent = '127.0.0.1';
export const kAttacker = '127.0.0.2';
export const kNewcomer = '127.0.0.3';

/** An address for each of a crowd. */
export const addressOfVisitor = (index) => `127.0.1.${index + 1}`;

import { kOperator } from '../texts.js';

/** Links to other processes: to the nodes, and to the owner of the world if that is another process. */
export function linksOf({ nodes, world }) {
  const isJoined = world && world.state !== 'own';
  return [...(nodes ?? []), ...(isJoined ? [{ ...world, name: kOperator.owner }] : [])];
}

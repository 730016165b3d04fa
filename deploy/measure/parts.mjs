import * as capacity from './parts/capacity.mjs';
import * as codecs from './parts/codecs.mjs';
import * as figure from './parts/figure.mjs';
import * as fluid from './parts/fluid.mjs';
import * as lightfield from './parts/lightfield.mjs';
import * as lines from './parts/lines.mjs';
import * as load from './parts/load.mjs';
import * as machine from './parts/machine.mjs';
import * as pipeline from './parts/pipeline.mjs';
import * as processors from './parts/processors.mjs';
import * as sharing from './parts/sharing.mjs';
import * as standing from './parts/standing.mjs';
import * as strolls from './parts/strolls.mjs';
import * as view from './parts/view.mjs';

/** Each has a name, commands as the documents show them, and measure(), which returns rows: columns and their values. */
export const kParts = [
  machine,
  fluid,
  lightfield,
  processors,
  view,
  standing,
  pipeline,
  codecs,
  load,
  lines,
  sharing,
  strolls,
  capacity,
  figure,
];

/** The named parts, or all. */
export function partsOf(names) {
  for (const name of names) {
    if (kParts.some((part) => part.name === name)) continue;
    console.error(`deploy/tables: no part is named ${name}; there are ${kParts.map((part) => part.name).join(', ')}`);
    process.exit(2);
  }
  return kParts.filter((part) => names.length === 0 || names.includes(part.name));
}

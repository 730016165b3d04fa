import { attackNamed } from './attacks/all.mjs';
import { answerCalls } from './helper_process.mjs';
import { cachedMegabytes, descriptors, residentMegabytes } from './readings.mjs';

/** The process of who attacks. */

async function attack({ name, ...target }) {
  const measure = async () => ({
    resident: residentMegabytes(target.pid),
    cached: await cachedMegabytes(target.operatorPort),
    descriptors: descriptors(target.pid),
  });
  return attackNamed(name).attack({ ...target, measure });
}

answerCalls({ attack });

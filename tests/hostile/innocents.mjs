import { kInnocent, kNewcomer } from './addresses.mjs';
import { answerCalls } from './helper_process.mjs';
import { pause } from './time.mjs';
import { Visitor } from './visitor.mjs';

/** The process of those whom an attack must not harm. */

let visitor = null;

async function enter({ port }) {
  visitor = await Visitor.enter({ port, from: kInnocent, name: 'Innocent', width: 1280, height: 720 });
}

async function read() {
  return visitor.read();
}

/** How many of so many newcomers, one a second, are let in and get a frame. */
async function newcomers({ port, count }) {
  let entered = 0;
  const failures = [];
  const come = async (index) => {
    await pause(index);
    try {
      const newcomer = await Visitor.enter({ port, from: kNewcomer, name: '', width: 160, height: 90, patience: 5 });
      entered += 1;
      newcomer.leave();
    } catch (error) {
      failures.push(error.message);
    }
  };
  await Promise.all(Array.from({ length: count }, (_, index) => come(index)));
  return { entered, failures };
}

answerCalls({ enter, read, newcomers });

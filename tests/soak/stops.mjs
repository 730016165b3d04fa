import { Server } from '../hostile/server.mjs';
import { now, pause } from '../hostile/time.mjs';
import { Visitor } from '../hostile/visitor.mjs';

/** Servers that are stopped at any moment: while visitors enter, walk and leave. */

const kVisitors = 3;
/** A stop comes so long after the first visitor, at most. Seconds. */
const kLongestVisit = 1.5;
/** Visitors leave about when the stop comes: sessions that end on two threads at once have hung. Seconds. */
const kAbout = 0.03;
const kPatience = 5;
const kOptions = ['--scene', 'tests/browser/clearing.toml'];

/** Comes, and leaves at this time; whether he got in by then does not matter. */
async function visit(port, index, leaveAt) {
  await pause(Math.random() * 0.3);
  const size = { width: 320, height: 180 };
  const visitor = await Visitor.enter({ port, name: `Visitor ${index}`, ...size }).catch(() => null);
  await pause(Math.max(0, leaveAt - now()));
  if (Math.random() < 0.5) visitor?.leave();
  else visitor?.drop();
}

async function stopOnce() {
  const server = await Server.listening({ options: kOptions });
  const stopAt = now() + Math.random() * kLongestVisit;
  const visits = Array.from({ length: kVisitors }, (_, index) =>
    visit(server.port, index, stopAt + (Math.random() - 0.5) * kAbout),
  );
  await pause(stopAt - now());
  const seconds = await server.stop('SIGTERM', kPatience);
  await Promise.all(visits);
  return { seconds, end: server.end };
}

export async function stopServers({ stops }) {
  const faults = [];
  const took = [];
  const began = now();
  for (let stop = 1; stop <= stops; ++stop) {
    const { seconds, end } = await stopOnce();
    if (seconds === null) faults.push(`stop ${stop} of ${stops} took more than ${kPatience} s`);
    else if (end.code !== 0) faults.push(`stop ${stop} of ${stops} ended with ${end.code ?? end.signal}`);
    took.push(seconds ?? kPatience);
    if (stop % 50 === 0) {
      console.error(`${stop} of ${stops} stops, ${faults.length} faults, ${Math.round(now() - began)} s`);
    }
  }
  took.sort((a, b) => a - b);
  return { result: { stops, median: took[Math.floor(stops / 2)], longest: took.at(-1) }, faults };
}

import { Server } from '../hostile/server.mjs';
import { pause } from '../hostile/time.mjs';
import { Visitor } from '../hostile/visitor.mjs';

/** Three visitors of the default world with as many frames in flight as there may be: no stream may stop. */

const kVisitors = 3;
const kFramesInFlight = 8;
/** No frame for so long is a stream that has stopped. Seconds. */
const kLongestGap = 2;
const kFewestFrames = 5;

export async function framesInFlight({ minutes }) {
  const server = await Server.listening({ options: ['--frames-in-flight', String(kFramesInFlight)] });
  const names = Array.from({ length: kVisitors }, (_, index) => `Visitor ${index}`);
  const enter = (name) => Visitor.enter({ port: server.port, name, width: 1280, height: 720 });
  const visitors = await Promise.all(names.map(enter));
  for (const visitor of visitors) visitor.read();
  await pause(minutes * 60);
  const faults = [];
  const result = visitors.map((visitor, index) => {
    const { framesPerSecond, p99Milliseconds, longestGapSeconds, ended } = visitor.read();
    if (ended !== null) faults.push(`visitor ${index} was sent away: ${ended}`);
    if (longestGapSeconds > kLongestGap) faults.push(`visitor ${index} saw nothing for ${longestGapSeconds.toFixed(1)} s`);
    if (framesPerSecond < kFewestFrames) faults.push(`visitor ${index} got ${framesPerSecond.toFixed(1)} frames a second`);
    return { framesPerSecond, p99Milliseconds, longestGapSeconds };
  });
  for (const visitor of visitors) visitor.leave();
  if ((await server.stop()) === null || server.end.code !== 0) faults.push('the server did not end as it should');
  for (const line of server.logged) if (/error|fail/i.test(line)) faults.push(`the log: ${line}`);
  return { result, faults };
}

/** Seconds of a clock that never goes back. */
export const now = () => performance.now() / 1000;

export const pause = (seconds) => new Promise((resolve) => setTimeout(resolve, seconds * 1000));

/** What the promise gives, or an error about `what` after so many seconds. */
export async function within(seconds, what, promise) {
  let timer;
  const late = new Promise((_, reject) => {
    timer = setTimeout(() => reject(new Error(`${what} took more than ${seconds} s`)), seconds * 1000);
  });
  try {
    return await Promise.race([promise, late]);
  } finally {
    clearTimeout(timer);
  }
}

/** Whether `condition` became true within so many seconds. */
export async function becomes(condition, seconds) {
  const end = now() + seconds;
  while (!(await condition())) {
    if (now() > end) return false;
    await pause(0.05);
  }
  return true;
}

/** Runs `step` again and again until the seconds are over. */
export async function repeat(seconds, step) {
  const end = now() + seconds;
  while (now() < end) {
    await step();
    // A step that fails at once must not keep the timers and sockets of its process from their turn.
    await new Promise((resolve) => setImmediate(resolve));
  }
}

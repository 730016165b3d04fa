import { spawn } from 'node:child_process';

const kGrove = process.env.GROVE_BINARY ?? 'build/release/grove';

/** Runs `grove` with these arguments, separated by blanks; returns its stdout. Rejects if it fails. */
export function runGrove(words, env = {}) {
  return new Promise((resolve, reject) => {
    const child = spawn(kGrove, words.split(' '), {
      env: { ...process.env, ...env },
      stdio: ['ignore', 'pipe', 'inherit'],
    });
    let output = '';
    child.stdout.on('data', (data) => (output += data));
    child.on('error', reject);
    child.on('close', (code) => (code === 0 ? resolve(output) : reject(new Error(`grove ${words}: exit ${code}`))));
  });
}

export const reportOf = async (words, env) => JSON.parse(await runGrove(words, env));

/** Calls `use` with the URL of a server; stops the server afterwards. */
export async function withServer(use) {
  const server = spawn(kGrove, ['serve', '--listen', '127.0.0.1:0'], { stdio: ['ignore', 'pipe', 'inherit'] });
  try {
    const port = await new Promise((resolve, reject) => {
      let output = '';
      server.stdout.on('data', (data) => {
        output += data;
        const found = /listening on http:\/\/127\.0\.0\.1:(\d+)/.exec(output);
        if (found) resolve(found[1]);
      });
      server.on('error', reject);
      server.on('close', (code) => reject(new Error(`grove serve: exit ${code}`)));
    });
    return await use(`ws://127.0.0.1:${port}/`);
  } finally {
    server.kill();
  }
}

export const median = (values) => [...values].sort((a, b) => a - b)[Math.floor(values.length / 2)];

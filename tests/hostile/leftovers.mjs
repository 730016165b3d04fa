import { mkdtempSync, rmSync } from 'node:fs';
import { tmpdir } from 'node:os';
import { join } from 'node:path';

/** What must not outlive the run, however it ends: child processes and folders. */

const processes = new Set();
const folders = new Set();

/** Kills this child process with the run, unless it ends before. */
export function keepTrackOf(child) {
  processes.add(child);
  const forget = () => processes.delete(child);
  child.once('exit', forget);
  child.once('error', forget);
  return child;
}

/** An empty folder that goes with the run. */
export function temporaryFolder() {
  const folder = mkdtempSync(join(tmpdir(), 'grove-hostile-'));
  folders.add(folder);
  return folder;
}

process.on('exit', () => {
  for (const child of processes) child.kill('SIGKILL');
  for (const folder of folders) rmSync(folder, { recursive: true, force: true });
});
for (const signal of ['SIGINT', 'SIGTERM', 'SIGHUP']) process.on(signal, () => process.exit(130));

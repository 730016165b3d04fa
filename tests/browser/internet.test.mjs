import assert from 'node:assert/strict';
import { execFileSync, spawn } from 'node:child_process';
import { mkdtempSync, readFileSync, rmSync, writeFileSync } from 'node:fs';
import { connect } from 'node:net';
import { tmpdir } from 'node:os';
import { join } from 'node:path';
import { after, before, test } from 'node:test';
import { fileURLToPath } from 'node:url';

import { Server, Visitor, freePort, launchBrowser, pause } from './helpers.mjs';

const kConfigurations = fileURLToPath(new URL('../../deploy/proxies/', import.meta.url));
const kScene = fileURLToPath(new URL('clearing.toml', import.meta.url));
const kHost = 'localhost';

let browser;
let folder;
let certificate;
let key;

before(async () => {
  browser = await launchBrowser();
  folder = mkdtempSync(join(tmpdir(), 'grove-internet-'));
  [certificate, key] = ['cert.pem', 'key.pem'].map((name) => join(folder, name));
  execFileSync('openssl', [
    ...['req', '-x509', '-newkey', 'ec', '-pkeyopt', 'ec_paramgen_curve:prime256v1', '-nodes', '-days', '2'],
    ...['-subj', `/CN=${kHost}`, '-addext', `subjectAltName=DNS:${kHost}`, '-keyout', key, '-out', certificate],
  ], { stdio: 'ignore' });
  writeFileSync(join(folder, 'grove.pem'), readFileSync(certificate, 'utf8') + readFileSync(key, 'utf8'));
});

after(async () => {
  await browser?.close();
  rmSync(folder, { recursive: true, force: true });
});

/** Somebody walks in by https, and pictures come by wss. */
async function visit(port) {
  const visitor = await Visitor.arrive(browser, `https://${kHost}:${port}/?name=Ada`, { ignoreHTTPSErrors: true });
  await visitor.until('connection', 'open');
  await visitor.frames(5);
  assert.equal(await visitor.page.evaluate(() => window.isSecureContext), true);
  await visitor.leave();
}

test('an https page streams by wss from the same port', async () => {
  const server = await Server.start({ options: ['--scene', kScene, '--tls-cert', certificate, '--tls-key', key] });
  try {
    assert.match(server.url, /^https:/);
    await visit(new URL(server.url).port);
  } finally {
    await server.end();
  }
});

/** The configuration that is handed out, with ports and files of this test, and what only a system's own file would say. */
const kProxies = {
  nginx: {
    file: 'nginx.conf',
    adapt: (text, port, backend) =>
      `daemon off; worker_processes 1; pid ${folder}/nginx.pid; error_log stderr; events {}\n` +
      'http { access_log off;\n' +
      ['client_body', 'proxy', 'fastcgi', 'uwsgi', 'scgi'].map((n) => `${n}_temp_path ${folder}/${n};\n`).join('') +
      text
        .replace('listen 443', `listen 127.0.0.1:${port}`)
        .replace('server_name grove.example.org', `server_name ${kHost}`)
        .replace(/\/etc\/letsencrypt\/\S*fullchain.pem/, certificate)
        .replace(/\/etc\/letsencrypt\/\S*privkey.pem/, key)
        .replace('127.0.0.1:8080', backend) +
      '}\n',
    command: (file) => ['nginx', ['-c', file, '-e', 'stderr']],
  },
  haproxy: {
    file: 'haproxy.cfg',
    adapt: (text, port, backend) =>
      text
        .replace('bind :443', `bind 127.0.0.1:${port}`)
        .replace('/etc/haproxy/grove.pem', join(folder, 'grove.pem'))
        .replace('127.0.0.1:8080', backend),
    command: (file) => ['haproxy', ['-f', file]],
  },
  caddy: {
    file: 'Caddyfile',
    adapt: (text, port, backend) =>
      '{\n\tadmin off\n\tauto_https off\n}\n' +
      text
        .replace('grove.example.org {', `https://${kHost}:${port} {\n\tbind 127.0.0.1\n\ttls ${certificate} ${key}`)
        .replace('127.0.0.1:8080', backend),
    command: (file) => ['caddy', ['run', '--config', file, '--adapter', 'caddyfile']],
  },
};

function isInstalled(program) {
  try {
    execFileSync('sh', ['-c', `PATH=$PATH:/usr/sbin command -v ${program}`], { stdio: 'ignore' });
    return true;
  } catch {
    return false;
  }
}

/** Resolves when somebody listens there. */
async function listens(port, process) {
  for (;;) {
    assert.equal(process.exitCode, null, 'the proxy has ended');
    const isOpen = await new Promise((resolve) => {
      const socket = connect(port, '127.0.0.1', () => resolve(true)).on('error', () => resolve(false));
      socket.on('connect', () => socket.destroy());
    });
    if (isOpen) return;
    await pause(50);
  }
}

for (const [name, proxy] of Object.entries(kProxies)) {
  test(`a visitor comes through ${name}`, async () => {
    assert.ok(isInstalled(name), `${name} is not installed: deploy/packages/test.txt names it`);
    const server = await Server.start({ options: ['--scene', kScene, '--proxy', '127.0.0.1'] });
    const port = await freePort();
    const file = join(folder, proxy.file);
    const text = readFileSync(kConfigurations + proxy.file, 'utf8');
    writeFileSync(file, proxy.adapt(text, port, new URL(server.url).host));
    const [program, options] = proxy.command(file);
    const environment = { ...process.env, PATH: `${process.env.PATH}:/usr/sbin`, HOME: folder };
    const running = spawn(program, options, { stdio: 'ignore', env: environment });
    try {
      await listens(port, running);
      await visit(port);
      assert.match(server.log, / through 127\.0\.0\.1:\d+ is visitor 1, Ada/, 'what the proxy says is believed');
    } finally {
      running.kill();
      await server.end();
    }
  });
}

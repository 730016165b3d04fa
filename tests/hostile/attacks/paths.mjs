import { kAttacker } from '../addresses.mjs';
import { carriedOut, is, keepsHisRate, neverStops } from '../bounds.mjs';
import { now } from '../time.mjs';
import { exchange } from './requests.mjs';

/** Requests for files outside of what is served, and requests that are none. */

const kPaths = [
  '/../../../../../../etc/passwd',
  '/..%2f..%2f..%2f..%2f..%2fetc/passwd',
  '/%2e%2e/%2e%2e/%2e%2e/%2e%2e/etc/passwd',
  '/....//....//....//etc/passwd',
  '/..\\..\\..\\etc\\passwd',
  '//etc/passwd',
  'file:///etc/passwd',
  'http://127.0.0.1/etc/passwd',
  '/operator/../../../../etc/passwd',
  '/index.html%00.js',
  '/%c0%ae%c0%ae/%c0%ae%c0%ae/etc/passwd',
  '/proc/self/environ',
  `/${'a/'.repeat(3000)}`,
  `/?${'x'.repeat(20_000)}`,
  '*',
  '',
];

export const paths = {
  name: 'path traversal and requests that are none',
  seconds: 4,
  async attack({ port, seconds }) {
    const did = { requests: 0, answers: {}, leaks: 0 };
    const send = async (bytes) => {
      const { text, hungUp } = await exchange({ port, from: kAttacker, bytes, patience: 0.5 });
      const answer = /^HTTP\/1\.[01] (\d+)/.exec(text)?.[1] ?? (hungUp ? 'hung up' : 'silence');
      did.requests += 1;
      did.answers[answer] = (did.answers[answer] ?? 0) + 1;
      if (/root:.*:0:0:|GROVE_CACHE=|PATH=/.test(text)) did.leaks += 1;
    };
    const host = `Host: 127.0.0.1:${port}\r\n`;
    const end = now() + seconds;
    do {
      const requests = [
        ...kPaths.map((path) => `GET ${path} HTTP/1.1\r\n${host}Connection: close\r\n\r\n`),
        `POST / HTTP/1.1\r\n${host}Content-Length: 99999999999999999999\r\n\r\nx`,
        `GET / HTTP/1.1\r\n${host}Transfer-Encoding: chunked\r\n\r\nFFFFFFFFFFFFFFFFF\r\n`,
        `GET / HTTP/1.1\r\n${'X-Long: '}${'y'.repeat(100_000)}\r\n\r\n`,
        `GET / HTTP/1.1\r\n${'X: y\r\n'.repeat(2000)}\r\n`,
        `GET / HTTP/9.9\r\n\r\n`,
        `CONNECT 127.0.0.1:22 HTTP/1.1\r\n${host}\r\n`,
      ];
      // One after the other: each has to reach the parser, not the limit of connections.
      for (const bytes of requests) await send(bytes);
    } while (now() < end);
    return did;
  },
  bounds: (row) => [
    carriedOut('requests', row.did.requests, kPaths.length),
    is('files that leaked', row.did.leaks, 0),
    keepsHisRate(row),
    neverStops(row),
  ],
};

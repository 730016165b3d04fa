import { kAttacker } from '../addresses.mjs';
import { carriedOut, is, neverStops } from '../bounds.mjs';
import { now, pause } from '../time.mjs';
import { Opcode, encodeFrame, openWebSocket } from '../websocket.mjs';

/** Names end up in the log and before other visitors. */

const kForged = 'forged line';
const kNames = [
  `Eve\n23:59:59 error   ${kForged}`,
  `Eve\r\n${kForged}`,
  '\u001b[2J\u001b[31mred',
  '\u202Eevol\u202D\u2066\u200B\uFEFF',
  '\0\0\0',
  '\u{1F9D9}\u200D\u2642\uFE0F'.repeat(4),
  'Z\u0335\u0321\u0322\u0323\u0324\u0325\u0326\u0327\u0328\u0329\u0330\u0331\u0332',
  '%s%n%x{}',
  '<script>alert(1)</script>',
  ' '.repeat(64),
  Buffer.from([0xff, 0xfe, 0xc0, 0xaf]),
  Buffer.from([0xed, 0xa0, 0x80, 0xf4, 0x90, 0x80, 0x80]),
  Buffer.alloc(64, 0x80),
  Buffer.alloc(65, 0x41),
];

function helloOf(name, told) {
  const bytes = Buffer.from(name);
  const head = Buffer.alloc(12);
  head.set([1, 1]);
  head.writeUInt16LE(told ?? bytes.length, 2);
  head.writeUInt32LE(160, 4);
  head.writeUInt32LE(90, 8);
  return encodeFrame(Buffer.concat([head, bytes]));
}

/** A line that a name has made, or that does something to the terminal that shows it. */
const isOdd = (line) => /[\p{Cc}\p{Cf}]/u.test(line) || new RegExp(`^(23:59:59 error +)?${kForged}`).test(line);

export const names = {
  name: 'names of odd characters',
  seconds: 4,
  async attack({ port, seconds }) {
    const did = { said: 0, welcomed: 0, hungUp: 0, refused: 0 };
    const hellos = [...kNames.map((name) => helloOf(name)), helloOf('short', 60), helloOf('long', 2)];
    const end = now() + seconds;
    for (const hello of hellos) {
      const client = await openWebSocket({ port, from: kAttacker }).catch(() => null);
      if (!client) {
        did.refused += 1;
        continue;
      }
      client.onMessage = (opcode, bytes) => (did.welcomed += opcode === Opcode.binary && bytes[0] === 0x81 ? 1 : 0);
      client.onEnd = () => (did.hungUp += 1);
      client.socket.write(hello);
      did.said += 1;
      await pause(Math.max(0.05, (end - now()) / hellos.length));
      client.onEnd = () => {};
      client.drop();
    }
    return did;
  },
  bounds: (row) => [
    carriedOut('names said', row.did.said, 5),
    is('odd or forged lines in the log', row.logged.filter(isOdd).length, 0),
    neverStops(row),
  ],
};

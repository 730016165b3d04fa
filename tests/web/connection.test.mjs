import assert from 'node:assert/strict';
import { readFileSync } from 'node:fs';
import { test } from 'node:test';

import { Backoff } from '../../web/stream/backoff.js';
import { Connection } from '../../web/stream/connection.js';
import { FakeClock } from './fake_clock.mjs';

const golden = JSON.parse(readFileSync(new URL('../stream/protocol/golden_messages.json', import.meta.url), 'utf8'));
const bytesOf = (name) => Uint8Array.from(Buffer.from(golden.find((entry) => entry.name === name).hex, 'hex')).buffer;
const hexOf = (buffer) => Buffer.from(buffer).toString('hex');

/** The network's end of a connection: records what the page does to a socket. */
class Wire {
  protocol = 'grove.v1.1';
  readyState = 0;
  sent = [];
  closedWith = null;

  send(bytes) {
    this.sent.push(hexOf(bytes));
  }

  close(code) {
    this.closedWith = code;
  }

  open() {
    this.readyState = 1;
    this.onopen();
  }

  receive(data) {
    this.onmessage({ data });
  }

  end(code, reason = '') {
    this.readyState = 3;
    this.onclose({ code, reason });
  }
}

function setUp({ mayRetry = () => true, protocol = 'grove.v1.1' } = {}) {
  const clock = new FakeClock();
  const sockets = [];
  const states = [];
  const frames = [];
  const waits = [];
  const refining = [];
  const connection = new Connection({
    openSocket: () => {
      sockets.push(new Wire());
      sockets.at(-1).protocol = protocol;
      return sockets.at(-1);
    },
    offer: () => [2, 1],
    hello: () => ({ name: 'Ada', width: 1280, height: 720 }),
    on: {
      state: (state, reason) => states.push(reason ? `${state}: ${reason}` : state),
      welcome: () => {},
      waiting: ({ percent, step }) => waits.push([percent, step]),
      refining: ({ percent, secondsLeft }) => refining.push([percent, secondsLeft]),
      picture: (picture) => frames.push(picture.frame),
      status: ({ limitedBy }) => frames.push(`limited by ${limitedBy}`),
    },
    backoff: new Backoff(() => 0.5),
    mayRetry,
    clock,
  });
  connection.start();
  const letIn = () => {
    sockets.at(-1).open();
    sockets.at(-1).receive(bytesOf('welcome'));
  };
  return { clock, sockets, states, frames, waits, refining, connection, letIn };
}

test('sends only hello before the welcome', () => {
  const { sockets, connection } = setUp();
  connection.sendResize({ width: 100, height: 100 });
  sockets[0].open();
  connection.sendInput({ number: 1, keys: 0, yaw: 0, pitch: 0 });
  connection.acknowledge({ frame: 3, arrived: 0 });
  assert.deepEqual(sockets[0].sent, [golden.find((entry) => entry.name === 'hello').hex]);
});

test('delivers frames and acknowledges each once, in order', () => {
  const { sockets, states, frames, connection, letIn } = setUp();
  letIn();
  sockets[0].receive(bytesOf('frame'));
  assert.deepEqual(frames, [66051]);
  connection.acknowledge({ frame: 5, arrived: 0 });
  connection.acknowledge({ frame: 4, arrived: 0 });
  connection.acknowledge({ frame: 5, arrived: 0 });
  connection.acknowledge({ frame: 6, arrived: 0 });
  assert.deepEqual(sockets[0].sent.slice(1), ['0300000005000000', '0300000006000000']);
  assert.deepEqual(states, ['connecting', 'open']);
});

test('requests a size once', () => {
  const { sockets, connection, letIn } = setUp();
  letIn();
  connection.sendResize({ width: 1280, height: 720 });
  connection.sendResize({ width: 1920, height: 1080 });
  connection.sendResize({ width: 1920, height: 1080 });
  assert.deepEqual(sockets[0].sent.slice(1), ['040000008007000038040000']);
});

test('reconnects with growing delays, reset by a frame', () => {
  const { clock, sockets, states, letIn } = setUp();
  letIn();
  sockets[0].end(1006);
  for (const delay of [500, 1000, 2000, 4000, 5000, 5000]) {
    const before = sockets.length;
    clock.advance(delay - 1);
    assert.equal(sockets.length, before, `too soon after ${delay}`);
    clock.advance(1);
    assert.equal(sockets.length, before + 1, `too late after ${delay}`);
    sockets.at(-1).end(1006);
  }
  clock.advance(5000);
  letIn();
  sockets.at(-1).receive(bytesOf('frame'));
  sockets.at(-1).end(1001);
  const before = sockets.length;
  clock.advance(500);
  assert.equal(sockets.length, before + 1);
  assert.deepEqual(states, ['connecting', 'open', 'lost', 'open', 'lost']);
});

test('does not send acknowledgements of a former connection', () => {
  const { clock, sockets, connection, letIn } = setUp();
  letIn();
  connection.acknowledge({ frame: 900, arrived: 0 });
  sockets[0].end(1006);
  clock.advance(500);
  connection.acknowledge({ frame: 901, arrived: 0 });
  letIn();
  connection.acknowledge({ frame: 1, arrived: 0 });
  assert.deepEqual(sockets[1].sent.slice(1), ['0300000001000000']);
});

test('retries a full server later', () => {
  const { clock, sockets, states, connection } = setUp();
  sockets[0].open();
  sockets[0].end(4002, 'there is no room');
  clock.advance(14_999);
  assert.equal(sockets.length, 1);
  clock.advance(1);
  assert.equal(sockets.length, 2);
  sockets[1].end(4002);
  clock.advance(14_000);
  connection.retry();
  assert.equal(sockets.length, 3);
  connection.retry();
  assert.equal(sockets.length, 3, 'one attempt at a time');
  clock.advance(2_000);
  assert.equal(sockets.length, 3, 'a retry by hand takes the place of the planned one');
  assert.deepEqual(states, ['connecting', 'full: there is no room']);
});

for (const [code, state] of [[4000, 'refused: too odd'], [4004, 'refused: too odd'], [4001, 'outdated: too odd']]) {
  test(`close code ${code} is reported and not retried`, () => {
    const { clock, sockets, states } = setUp();
    sockets[0].open();
    sockets[0].end(code, 'too odd');
    clock.advance(60_000);
    assert.equal(sockets.length, 1);
    assert.deepEqual(states, ['connecting', state]);
  });
}

test('malformed bytes end the connection with the reason', () => {
  const { sockets, states, letIn } = setUp();
  letIn();
  sockets[0].receive(new Uint8Array([0x55]).buffer);
  assert.equal(sockets[0].closedWith, 4000);
  assert.deepEqual(states, ['connecting', 'open', 'refused: the message type 85 is unknown']);
});

test('a server that falls silent counts as lost', () => {
  const { clock, sockets, states, letIn } = setUp();
  letIn();
  clock.advance(9_000);
  sockets[0].receive(bytesOf('frame'));
  clock.advance(9_999);
  assert.deepEqual(states, ['connecting', 'open']);
  clock.advance(1);
  assert.deepEqual(states, ['connecting', 'open', 'lost']);
  assert.equal(sockets[0].closedWith, 1000);
});

test('early visitors get progress and enter on the same connection', () => {
  const { clock, sockets, states, waits, letIn } = setUp();
  sockets[0].open();
  for (let i = 0; i < 3; i += 1) {
    clock.advance(9_000);
    sockets[0].receive(bytesOf('waiting'));
  }
  assert.deepEqual(waits, Array(3).fill([40, 'painting the sky']));
  assert.deepEqual(states, ['connecting']);
  letIn();
  assert.deepEqual(states, ['connecting', 'open']);
  assert.equal(sockets.length, 1);
});

test('refinement is reported apart from frames, after the welcome', () => {
  const { sockets, frames, refining, letIn } = setUp();
  sockets[0].open();
  sockets[0].receive(bytesOf('refining'));
  letIn();
  sockets[0].receive(bytesOf('refining'));
  sockets[0].receive(bytesOf('refining for an unknown time'));
  assert.deepEqual(refining, [[37, 75], [0, null]]);
  assert.deepEqual(frames, []);
});

test('a hidden page reconnects when visible', () => {
  let visible = false;
  const { clock, sockets, connection, letIn } = setUp({ mayRetry: () => visible });
  letIn();
  clock.advance(60_000);
  assert.equal(connection.state, 'open', 'silence means nothing while hidden');
  sockets[0].end(4005);
  clock.advance(60_000);
  assert.equal(sockets.length, 1);
  visible = true;
  connection.retry();
  assert.equal(sockets.length, 2);
});

test('a place lost while hidden is explained and restored when visible', () => {
  let visible = false;
  const { clock, sockets, states, connection, letIn } = setUp({ mayRetry: () => visible });
  letIn();
  sockets[0].end(4006, 'your place went to a newcomer');
  clock.advance(60_000);
  assert.equal(sockets.length, 1, 'a page that nobody looks at takes no place');
  visible = true;
  connection.retry();
  letIn();
  assert.deepEqual(states, ['connecting', 'open', 'away: your place went to a newcomer', 'open']);
});

test('delays are jittered and at most five seconds', () => {
  const early = new Backoff(() => 0);
  const late = new Backoff(() => 1);
  assert.equal(early.next(), 450);
  assert.equal(late.next(), 550);
  for (let i = 0; i < 10; i += 1) assert.ok(late.next() <= 5000);
  late.reset();
  assert.equal(late.next(), 550);
});

test('offers codecs before the hello to servers that choose', () => {
  const { sockets } = setUp({ protocol: 'grove.v1.2' });
  sockets[0].open();
  assert.deepEqual(sockets[0].sent, ['05020201', golden.find((entry) => entry.name === 'hello').hex]);
});

test('sends no newer messages to an older server', () => {
  const { sockets, connection, letIn } = setUp();
  letIn();
  const limits = { hidden: true, border: false, framesPerSecond: 0, kilobitsPerSecond: 0, lines: 0 };
  connection.sendOffer([1]);
  connection.sendLimits(limits);
  connection.sendBroken(7);
  assert.equal(sockets[0].sent.length, 1);
});

test('reports arrival and display time of pictures', () => {
  const { clock, sockets, connection, letIn } = setUp({ protocol: 'grove.v1.2' });
  letIn();
  clock.advance(1000);
  connection.acknowledge({ frame: 9, arrived: 991.5 });
  connection.acknowledge({ frame: 9, arrived: 991.5 });
  connection.acknowledge({ frame: 8, arrived: 991.5 });
  // 85 tenths of milliseconds; 991500 microseconds.
  assert.deepEqual(sockets[0].sent.slice(2), ['0800550009000000' + '0c210f00']);
});

test('reports a silent server until it speaks or is lost', () => {
  const { clock, sockets, states, letIn } = setUp({ protocol: 'grove.v1.2' });
  letIn();
  clock.advance(9_000);
  sockets[0].receive(bytesOf('picture'));
  clock.advance(1_499);
  sockets[0].receive(bytesOf('status'));
  clock.advance(1_499);
  assert.deepEqual(states, ['connecting', 'open'], 'before the first picture it may take its time');
  clock.advance(1);
  assert.deepEqual(states.slice(2), ['silent']);
  sockets[0].receive(bytesOf('status'));
  assert.deepEqual(states.slice(3), ['open']);
  clock.advance(9_999);
  assert.deepEqual(states.slice(4), ['silent']);
  clock.advance(1);
  assert.deepEqual(states.slice(5), ['lost']);
});

test('older servers may be silent longer', () => {
  const { clock, sockets, states, letIn } = setUp();
  letIn();
  sockets[0].receive(bytesOf('frame'));
  clock.advance(9_999);
  assert.deepEqual(states, ['connecting', 'open']);
});

test('ignores silence while hidden and shortly after', () => {
  let visible = true;
  const { clock, sockets, states, connection, letIn } = setUp({ protocol: 'grove.v1.2', mayRetry: () => visible });
  letIn();
  sockets[0].receive(bytesOf('picture'));
  visible = false;
  clock.advance(7_400);
  visible = true;
  connection.listen();
  clock.advance(1_499);
  assert.deepEqual(states, ['connecting', 'open']);
  clock.advance(1);
  assert.deepEqual(states.slice(2), ['silent']);
});

test('a stalled page reads pending messages first', () => {
  const { clock, sockets, states, letIn } = setUp({ protocol: 'grove.v1.2' });
  letIn();
  sockets[0].receive(bytesOf('picture'));
  clock.stall(5_000);
  assert.deepEqual(states, ['connecting', 'open']);
  sockets[0].receive(bytesOf('status'));
  clock.advance(1_000);
  assert.deepEqual(states, ['connecting', 'open']);
  clock.advance(500);
  assert.deepEqual(states.slice(2), ['silent']);
});

test('reports decoding and painting times to 1.3 and not to 1.2', () => {
  for (const [protocol, type] of [['grove.v1.4', '09'], ['grove.v1.3', '09'], ['grove.v1.2', '08']]) {
    const { sockets, clock, connection, letIn } = setUp({ protocol });
    letIn();
    clock.advance(12.3);
    connection.acknowledge({ frame: 1, arrived: 0 }, { decode: 4.5, paint: 0.8 });
    const sent = sockets[0].sent.at(-1);
    assert.equal(sent.slice(0, 8), `${type}007b00`, protocol);
    if (type === '09') assert.equal(sent.slice(24), '2d000800');
  }
});

test('requests a capture only from servers that support it', () => {
  for (const [protocol, count] of [['grove.v1.4', 1], ['grove.v1.3', 1], ['grove.v1.2', 0]]) {
    const { sockets, connection, letIn } = setUp({ protocol });
    letIn();
    connection.sendCapture(7);
    assert.equal(sockets[0].sent.filter((hex) => hex === '0a00000007000000').length, count, protocol);
  }
});

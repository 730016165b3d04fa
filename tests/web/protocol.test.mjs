import assert from 'node:assert/strict';
import { readFileSync } from 'node:fs';
import { test } from 'node:test';

import {
  encodeAck,
  encodeBroken,
  encodeCapture,
  encodeHello,
  encodeInput,
  encodeLimits,
  encodeOffer,
  encodePainted,
  encodePresented,
  encodeResize,
} from '../../web/stream/client_messages.js';
import { kSubProtocols } from '../../web/stream/protocol.js';
import { ProtocolError } from '../../web/stream/protocol_error.js';
import { decodeServerMessage } from '../../web/stream/server_messages.js';

const golden = JSON.parse(readFileSync(new URL('../stream/protocol/golden_messages.json', import.meta.url), 'utf8'));
const bytesOf = (hex) => Uint8Array.from(Buffer.from(hex, 'hex')).buffer;
const hexOf = (buffer) => Buffer.from(buffer).toString('hex');
const find = (message) => golden.find((entry) => entry.fields.message === message);
const encoders = {
  Hello: encodeHello,
  Input: encodeInput,
  Ack: encodeAck,
  Resize: encodeResize,
  Offer: encodeOffer,
  Limits: encodeLimits,
  Broken: encodeBroken,
  Presented: encodePresented,
  Painted: encodePainted,
  Capture: encodeCapture,
};

test('every message type has golden bytes', () => {
  const types = new Set(golden.map((entry) => entry.fields.message));
  assert.deepEqual([...types].sort(), [
    'Ack', 'Broken', 'Capture', 'Captured', 'Frame', 'Ground', 'Hello', 'Input', 'Limits', 'Offer', 'Painted', 'People', 'Picture', 'Presented',
    'Refining', 'Resize', 'Status', 'Times', 'Waiting', 'Welcome',
  ]);
});

for (const { name, fields, hex } of golden) {
  const encode = encoders[fields.message];
  if (encode) {
    test(`writes golden ${name}`, () => assert.equal(hexOf(encode(fields)), hex));
  } else {
    test(`reads golden ${name}`, () => {
      const message = decodeServerMessage(bytesOf(hex));
      if (message.picture) message.picture = hexOf(message.picture);
      if (message.space) message.space.nearness = hexOf(message.space.nearness);
      assert.deepEqual(message, fields.message === 'Picture' ? { space: null, ...fields } : fields);
    });
  }
}

test('truncates a long name between characters', () => {
  const bytes = new Uint8Array(encodeHello({ name: '\u{1F525}'.repeat(20), width: 640, height: 360 }));
  assert.equal(bytes.length, 12 + 64);
  const cut = new Uint8Array(encodeHello({ name: 'x' + '\u{1F525}'.repeat(20), width: 640, height: 360 }));
  assert.equal(cut.length, 12 + 61);
  assert.equal(cut[2], 61);
});

test('refuses every truncated server message', () => {
  const { hex } = find('Welcome');
  for (let length = 0; length < hex.length; length += 2) {
    assert.throws(() => decodeServerMessage(bytesOf(hex.slice(0, length))), ProtocolError, `welcome of ${length / 2}`);
  }
  for (const message of ['Waiting', 'Status', 'Refining', 'Times', 'People']) {
    const whole = find(message).hex;
    for (let length = 0; length < whole.length; length += 2) {
      const cut = bytesOf(whole.slice(0, length));
      assert.throws(() => decodeServerMessage(cut), ProtocolError, `${message} of ${length / 2}`);
    }
  }
  for (const [message, header] of [['Frame', 20], ['Picture', 40], ['Captured', 12]]) {
    for (let length = 0; length <= header; length += 1) {
      const cut = bytesOf(find(message).hex.slice(0, 2 * length));
      assert.throws(() => decodeServerMessage(cut), ProtocolError, `${message} of ${length}`);
    }
  }
});

function spoilt(message, spoil, more = '') {
  const buffer = bytesOf(find(message).hex + more);
  spoil(new DataView(buffer));
  return buffer;
}

for (const [what, data] of [
  ['text', 'hello'],
  ['an unknown type', bytesOf('77000000')],
  ["a client's message", bytesOf(find('Ack').hex)],
  ['another version', spoilt('Welcome', (view) => view.setUint8(1, 2))],
  ['a longer welcome', bytesOf(find('Welcome').hex + '00')],
  ['a direction that is not a number', spoilt('Welcome', (view) => view.setFloat32(12, NaN, true))],
  ['an infinite direction', spoilt('Welcome', (view) => view.setFloat32(16, Infinity, true))],
  ['a name that is not UTF-8', spoilt('Welcome', (view) => view.setUint8(20, 0xff))],
  ['a longer waiting', bytesOf(find('Waiting').hex + '00')],
  ['more than 100 percent', spoilt('Waiting', (view) => view.setUint8(1, 101))],
  ['a place before the first', spoilt('Waiting', (view) => view.setUint16(2, 0, true))],
  ['a step that is not UTF-8', spoilt('Waiting', (view) => view.setUint8(8, 0xff))],
  ['an unknown codec', spoilt('Frame', (view) => view.setUint8(1, 9))],
  ['a codec of Picture in a Frame', spoilt('Frame', (view) => view.setUint8(1, 2))],
  ['a picture of an unknown codec', spoilt('Picture', (view) => view.setUint8(1, 9))],
  ['a picture without width', spoilt('Picture', (view) => view.setUint16(4, 0, true))],
  ['a picture whose camera looks nowhere', spoilt('Picture', (view) => view.setFloat32(24, NaN, true))],
  ['a picture without an angle', spoilt('Picture', (view) => view.setFloat32(36, 0, true))],
  ['a picture with more labels than it may have', spoilt('Picture', (view) => view.setUint8(10, 25), '00'.repeat(300))],
  ['a picture that its labels leave no bytes', spoilt('Picture', (view) => view.setUint8(10, 1))],
  ['a longer list of people', bytesOf(find('People').hex + '00')],
  ['a list of more people than it has', spoilt('People', (view) => view.setUint16(2, 4, true))],
  ['a list of people with flags that nobody knows', spoilt('People', (view) => view.setUint8(1, 2))],
  ["a visitor's name that is not UTF-8", spoilt('People', (view) => view.setUint8(12, 0xff))],
  ['a longer status', bytesOf(find('Status').hex + '00')],
  ['a status limited by nothing known', spoilt('Status', (view) => view.setUint8(1, 5))],
  ['a quality of more than 100 percent', spoilt('Status', (view) => view.setUint8(3, 101))],
  ['longer times', bytesOf(find('Times').hex + '00')],
  ['a captured picture of an unknown codec', spoilt('Captured', (view) => view.setUint8(1, 2))],
  ['a captured picture without height', spoilt('Captured', (view) => view.setUint16(4, 0, true))],
  ['a longer refining', bytesOf(find('Refining').hex + '00')],
  ['a frame without width', spoilt('Frame', (view) => view.setUint16(2, 0, true))],
  ['a frame without height', spoilt('Frame', (view) => view.setUint16(4, 0, true))],
]) {
  test(`refuses ${what}`, () => assert.throws(() => decodeServerMessage(data), ProtocolError));
}

const kPart = { rect: [8, 16, 24, 300], depths: [150, 250], velocity: [1.5, -0.5] };

function hexOfPart({ rect, depths, velocity }) {
  const view = new DataView(new ArrayBuffer(20));
  [...rect, ...depths].forEach((value, i) => view.setUint16(2 * i, value, true));
  velocity.forEach((value, i) => view.setFloat32(12 + 4 * i, value, true));
  return hexOf(view.buffer);
}

/** The golden picture with labels, with a space of these fields. */
function spatialPicture({ numbers = [1, 1.75, -2, 1.5, 1.75, -2.5, 0.5, -0.25], since = 12_500, bytes = 3, parts = [], count = parts.length, rest = 0, nearness = '0a0b0c', flags = 3 } = {}) {
  const { hex } = golden.find((entry) => entry.name === 'picture with labels');
  const space = new DataView(new ArrayBuffer(40));
  numbers.forEach((value, i) => space.setFloat32(4 * i, value, true));
  space.setUint32(32, since, true);
  space.setUint16(36, bytes, true);
  space.setUint8(38, count);
  space.setUint8(39, rest);
  const headerDigits = 2 * (40 + 2 * 10);
  const buffer = bytesOf(hex.slice(0, headerDigits) + hexOf(space.buffer) + parts.map(hexOfPart).join('') + nearness + hex.slice(headerDigits));
  new DataView(buffer).setUint8(2, flags);
  return buffer;
}

// Fault: depths are read as part of the picture's bytes, or its bytes as depths.
test('reads the space of a picture', () => {
  const { space, picture, labels, independent } = decodeServerMessage(spatialPicture());
  assert.deepEqual({ ...space, nearness: hexOf(space.nearness) }, {
    eye: [1, 1.75, -2],
    visitor: [1.5, 1.75, -2.5],
    velocity: [0.5, -0.25],
    sinceInput: 12.5,
    moving: [],
    nearness: '0a0b0c',
  });
  assert.equal(hexOf(picture), 'ffd8ffd9');
  assert.equal(labels.length, 2);
  assert.equal(independent, true);
  const dependent = decodeServerMessage(spatialPicture({ flags: 2, bytes: 0, nearness: '' }));
  assert.deepEqual([dependent.independent, dependent.space.nearness.length], [false, 0]);
  assert.equal(decodeServerMessage(bytesOf(find('Picture').hex)).space, null);
});

// Faults: a page that reads beyond a message, or walks to a place that is not a number.
test('refuses a space that is cut short or not of numbers', () => {
  const whole = hexOf(spatialPicture());
  for (let length = 0; length <= 40 + 20 + 40 + 3; length += 1) {
    assert.throws(() => decodeServerMessage(bytesOf(whole.slice(0, 2 * length))), ProtocolError, `${length} bytes`);
  }
  for (let i = 0; i < 8; i += 1) {
    for (const value of [NaN, Infinity]) {
      const numbers = Array(8).fill(0).with(i, value);
      assert.throws(() => decodeServerMessage(spatialPicture({ numbers })), ProtocolError);
    }
  }
  assert.throws(() => decodeServerMessage(spatialPicture({ bytes: 7 })), ProtocolError, 'no byte is left for the picture');
  assert.throws(() => decodeServerMessage(spatialPicture({ bytes: 65535 })), ProtocolError);
  assert.throws(() => decodeServerMessage(spatialPicture({ rest: 1 })), ProtocolError);
});

test('reads the moving parts of a picture', () => {
  const { space, picture } = decodeServerMessage(spatialPicture({ parts: [kPart, { ...kPart, rect: [0, 0, 1, 1] }] }));
  const part = { left: 8, top: 16, right: 24, bottom: 300, nearest: 1.5, farthest: 2.5, velocity: [1.5, 0, -0.5] };
  assert.deepEqual(space.moving, [part, { ...part, left: 0, top: 0, right: 1, bottom: 1 }]);
  assert.deepEqual([hexOf(space.nearness), hexOf(picture)], ['0a0b0c', 'ffd8ffd9']);
});

// Faults: a part without pixels, or nowhere; a division by zero; a page that reads beyond a message.
test('refuses impossible moving parts', () => {
  for (const change of [
    { rect: [8, 16, 8, 300] }, { rect: [8, 16, 24, 16] }, { depths: [0, 250] }, { depths: [251, 250] }, { velocity: [NaN, 0] },
    { velocity: [0, Infinity] },
  ]) {
    assert.throws(() => decodeServerMessage(spatialPicture({ parts: [{ ...kPart, ...change }] })), ProtocolError, JSON.stringify(change));
  }
  assert.equal(decodeServerMessage(spatialPicture({ parts: Array(16).fill(kPart) })).space.moving.length, 16);
  assert.throws(() => decodeServerMessage(spatialPicture({ parts: Array(17).fill(kPart) })), ProtocolError);
  assert.throws(() => decodeServerMessage(spatialPicture({ parts: [kPart], count: 2 })), ProtocolError);
});

/** A message Ground of these numbers. */
function groundOf({ hills = [[1, -2, 4, 1.5]], obstacles = [[3, 4, 0.5], [-5, 6, 1]], radius = 30, cut = 0, more = '' } = {}) {
  const numbers = [radius, ...hills.flat(), ...obstacles.flat()];
  const view = new DataView(new ArrayBuffer(4 + 4 * numbers.length));
  view.setUint8(0, 0x8a);
  view.setUint8(1, hills.length);
  view.setUint16(2, obstacles.length, true);
  numbers.forEach((value, i) => view.setFloat32(4 + 4 * i, value, true));
  return bytesOf(hexOf(view.buffer.slice(0, view.byteLength - cut)) + more);
}

// Faults: hills taken for obstacles, and the reverse; a page that walks by a ground of nothing.
test('reads the ground, and refuses a malformed one', () => {
  assert.deepEqual(decodeServerMessage(groundOf()), {
    message: 'Ground',
    radius: 30,
    hills: [{ x: 1, z: -2, radius: 4, height: 1.5 }],
    obstacles: [{ x: 3, z: 4, radius: 0.5 }, { x: -5, z: 6, radius: 1 }],
  });
  const empty = decodeServerMessage(groundOf({ hills: [], obstacles: [] }));
  assert.deepEqual([empty.hills, empty.obstacles], [[], []]);
  const many = (count, part) => Array.from({ length: count }, () => part);
  decodeServerMessage(groundOf({ hills: many(64, [0, 0, 1, 1]), obstacles: many(4096, [0, 0, 1]) }));
  for (let cut = 1; cut <= 47; cut += 1) assert.throws(() => decodeServerMessage(groundOf({ cut })), ProtocolError, `${cut}`);
  for (const bad of [
    { more: '00' },
    { hills: many(65, [0, 0, 1, 1]) },
    { obstacles: many(4097, [0, 0, 1]) },
    { radius: 0 },
    { radius: NaN },
    { radius: Infinity },
    { hills: [[0, 0, -1, 1]] },
    { hills: [[0, 0, 1, NaN]] },
    { obstacles: [[0, 0, 0]] },
    { obstacles: [[Infinity, 0, 1]] },
  ]) {
    assert.throws(() => decodeServerMessage(groundOf(bad)), ProtocolError, JSON.stringify(bad));
  }
});

// Fault: servers that know 1.5 get 1.4, or a flag that 1.4 does not know.
test('requests 1.5 first, and limits carry its flag only when it is set', () => {
  assert.equal(kSubProtocols[0], 'grove.v1.5');
  const limits = find('Limits').fields;
  assert.equal(new Uint8Array(encodeLimits({ ...limits, nearness: true }))[1], new Uint8Array(encodeLimits(limits))[1] | 4);
});

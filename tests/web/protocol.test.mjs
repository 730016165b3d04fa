import assert from 'node:assert/strict';
import { readFileSync } from 'node:fs';
import { test } from 'node:test';

import {
  ProtocolError,
  decodeServerMessage,
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
} from '../../web/stream/protocol.js';

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
    'Ack', 'Broken', 'Capture', 'Captured', 'Frame', 'Hello', 'Input', 'Limits', 'Offer', 'Painted', 'People', 'Picture', 'Presented',
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
      assert.deepEqual(message, fields);
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

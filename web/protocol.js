/**
 * The messages of server/stream/PROTOCOL.md, version 1: what the page writes and what it reads. Little-endian
 * throughout. Reading never trusts the bytes: whatever breaks the protocol throws ProtocolError.
 */

/** What to ask for, the newest first: the second lacks Waiting. */
export const kSubProtocols = Object.freeze(['grove.v1.1', 'grove.v1']);
const kVersion = 1;

/** Bits of an input's `keys`. */
export const Key = Object.freeze({ forward: 1, back: 2, left: 4, right: 8, run: 16, blow: 32 });

/** Why the server closed a connection, as far as the page acts on it. */
export const CloseCode = Object.freeze({ protocolError: 4000, wrongVersion: 4001, full: 4002, flood: 4004 });

/** Names of the picture codecs by their number. */
export const kCodecNames = Object.freeze({ 1: 'JPEG' });

const Type = Object.freeze({
  hello: 0x01,
  input: 0x02,
  ack: 0x03,
  resize: 0x04,
  welcome: 0x81,
  frame: 0x82,
  waiting: 0x83,
});
const kMostNameBytes = 64;
const kWelcomeBytes = 20;
const kFrameHeaderBytes = 20;
const kWaitingBytes = 8;

export class ProtocolError extends Error {
  name = 'ProtocolError';
}

function message(type, bytes) {
  const view = new DataView(new ArrayBuffer(bytes));
  view.setUint8(0, type);
  return view;
}

/** `width` and `height` are the wanted frame in pixels; a name longer than 64 bytes is cut between characters. */
export function encodeHello({ name, width, height }) {
  const nameRoom = new Uint8Array(kMostNameBytes);
  const { written } = new TextEncoder().encodeInto(name, nameRoom);
  const view = message(Type.hello, 12 + written);
  view.setUint8(1, kVersion);
  view.setUint16(2, written, true);
  view.setUint32(4, width, true);
  view.setUint32(8, height, true);
  new Uint8Array(view.buffer).set(nameRoom.subarray(0, written), 12);
  return view.buffer;
}

/** The whole state of the controls; yaw and pitch in radians. */
export function encodeInput({ number, keys, yaw, pitch }) {
  const view = message(Type.input, 16);
  view.setUint8(1, keys);
  view.setUint32(4, number, true);
  view.setFloat32(8, yaw, true);
  view.setFloat32(12, pitch, true);
  return view.buffer;
}

export function encodeAck({ frame }) {
  const view = message(Type.ack, 8);
  view.setUint32(4, frame, true);
  return view.buffer;
}

export function encodeResize({ width, height }) {
  const view = message(Type.resize, 12);
  view.setUint32(4, width, true);
  view.setUint32(8, height, true);
  return view.buffer;
}

function decodeText(bytes, what) {
  try {
    return new TextDecoder('utf-8', { fatal: true, ignoreBOM: true }).decode(bytes);
  } catch {
    throw new ProtocolError(`${what} is not UTF-8`);
  }
}

function decodeWelcome(view) {
  if (view.byteLength < kWelcomeBytes) throw new ProtocolError('the welcome is cut short');
  if (view.getUint8(1) !== kVersion) throw new ProtocolError(`the server speaks version ${view.getUint8(1)}`);
  if (view.byteLength !== kWelcomeBytes + view.getUint8(11)) throw new ProtocolError('the welcome has a wrong length');
  const [yaw, pitch] = [view.getFloat32(12, true), view.getFloat32(16, true)];
  if (!Number.isFinite(yaw) || !Number.isFinite(pitch)) throw new ProtocolError('the first direction is not a number');
  return {
    message: 'Welcome',
    framesPerSecond: view.getUint16(2, true),
    visitor: view.getUint32(4, true),
    red: view.getUint8(8),
    green: view.getUint8(9),
    blue: view.getUint8(10),
    yaw,
    pitch,
    world: decodeText(new Uint8Array(view.buffer, kWelcomeBytes), "the world's name"),
  };
}

function decodeWaiting(view) {
  if (view.byteLength < kWaitingBytes) throw new ProtocolError('the waiting is cut short');
  if (view.byteLength !== kWaitingBytes + view.getUint32(4, true)) {
    throw new ProtocolError('the waiting has a wrong length');
  }
  const waiting = {
    message: 'Waiting',
    percent: view.getUint8(1),
    place: view.getUint16(2, true),
    step: decodeText(new Uint8Array(view.buffer, kWaitingBytes), 'what is waited for'),
  };
  if (waiting.percent > 100) throw new ProtocolError('the waiting has more than 100 percent');
  if (waiting.place === 0) throw new ProtocolError('the waiting has no place');
  return waiting;
}

function decodeFrame(view) {
  if (view.byteLength <= kFrameHeaderBytes) throw new ProtocolError('the frame has no picture');
  const frame = {
    message: 'Frame',
    codec: view.getUint8(1),
    width: view.getUint16(2, true),
    height: view.getUint16(4, true),
    visitors: view.getUint16(6, true),
    frame: view.getUint32(8, true),
    lastInput: view.getUint32(12, true),
    serverMicroseconds: view.getUint32(16, true),
    picture: new Uint8Array(view.buffer, kFrameHeaderBytes),
  };
  if (!(frame.codec in kCodecNames)) throw new ProtocolError(`the picture's codec ${frame.codec} is unknown`);
  if (frame.width === 0 || frame.height === 0) throw new ProtocolError('the frame has no size');
  return frame;
}

/** Reads one message of the server from an ArrayBuffer; a frame's `picture` is a view into it, not a copy. */
export function decodeServerMessage(data) {
  if (!(data instanceof ArrayBuffer)) throw new ProtocolError('the message is text');
  if (data.byteLength === 0) throw new ProtocolError('the message is empty');
  const view = new DataView(data);
  switch (view.getUint8(0)) {
    case Type.welcome:
      return decodeWelcome(view);
    case Type.frame:
      return decodeFrame(view);
    case Type.waiting:
      return decodeWaiting(view);
    default:
      throw new ProtocolError(`the message type ${view.getUint8(0)} is unknown`);
  }
}

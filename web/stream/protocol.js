/**
 * The page's messages of server/stream/protocol/PROTOCOL.md, version 1, all little-endian. Decoding trusts no bytes: a
 * violation of the protocol throws ProtocolError.
 */

/**
 * The versions to request, newest first. 1.1 adds Waiting; 1.2 the choice of codec; 1.3 Painted, Capture and Times; 1.4
 * labels and People.
 */
export const kMeasuringProtocols = Object.freeze(['grove.v1.4', 'grove.v1.3']);
export const kAdaptiveProtocols = Object.freeze([...kMeasuringProtocols, 'grove.v1.2']);
export const kSubProtocols = Object.freeze([...kAdaptiveProtocols, 'grove.v1.1', 'grove.v1']);
const kVersion = 1;

/** Bits of an input's `keys`. */
export const Key = Object.freeze({ forward: 1, back: 2, left: 4, right: 8, run: 16, blow: 32 });

/** The server's reasons to close a connection, as far as the page acts on them. */
export const CloseCode = Object.freeze({ protocolError: 4000, wrongVersion: 4001, full: 4002, flood: 4004, hidden: 4006 });

export const Codec = Object.freeze({ jpeg: 1, h264: 2 });
export const kCodecNames = Object.freeze({ [Codec.jpeg]: 'JPEG', [Codec.h264]: 'H.264' });

/** The stream's bottleneck. */
export const LimitedBy = Object.freeze({ nothing: 0, line: 1, machine: 2, visitor: 3, browser: 4 });

const Type = Object.freeze({
  hello: 0x01,
  input: 0x02,
  ack: 0x03,
  resize: 0x04,
  offer: 0x05,
  limits: 0x06,
  broken: 0x07,
  presented: 0x08,
  painted: 0x09,
  capture: 0x0a,
  welcome: 0x81,
  frame: 0x82,
  waiting: 0x83,
  picture: 0x84,
  status: 0x85,
  refining: 0x86,
  captured: 0x87,
  times: 0x88,
  people: 0x89,
});
const kMaxNameBytes = 64;
const kWelcomeBytes = 20;
const kFrameHeaderBytes = 20;
const kPictureHeaderBytes = 40;
const kLabelBytes = 10;
const kMaxLabels = 24;
const kWaitingBytes = 8;
const kStatusBytes = 20;
const kRefiningBytes = 8;
const kUnknownSeconds = 0xffff;
const kCapturedHeaderBytes = 12;
const kTimesBytes = 12;
const kPeopleBytes = 4;
const kPersonBytes = 8;
/** The longest duration in 16 bits, in tenths of milliseconds. */
const kLongestDuration = 0xffff;

export class ProtocolError extends Error {
  name = 'ProtocolError';
}

function message(type, bytes) {
  const view = new DataView(new ArrayBuffer(bytes));
  view.setUint8(0, type);
  return view;
}

/** `width` and `height`: the wanted frame in pixels. A name of more than 64 bytes is cut between characters. */
export function encodeHello({ name, width, height }) {
  const nameRoom = new Uint8Array(kMaxNameBytes);
  const { written } = new TextEncoder().encodeInto(name, nameRoom);
  const view = message(Type.hello, 12 + written);
  view.setUint8(1, kVersion);
  view.setUint16(2, written, true);
  view.setUint32(4, width, true);
  view.setUint32(8, height, true);
  new Uint8Array(view.buffer).set(nameRoom.subarray(0, written), 12);
  return view.buffer;
}

/** The state of all controls; yaw and pitch in radians. */
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

/** Codecs that this page can decode, best first. */
export function encodeOffer({ codecs }) {
  return Uint8Array.of(Type.offer, codecs.length, ...codecs).buffer;
}

/** The visitor's limits; 0 is no limit. `hidden`: of the page; `border`: send more than the window shows. */
export function encodeLimits({ hidden, border, framesPerSecond, kilobitsPerSecond, lines }) {
  const view = message(Type.limits, 12);
  view.setUint8(1, (hidden ? 1 : 0) | (border ? 2 : 0));
  view.setUint8(2, framesPerSecond);
  view.setUint32(4, kilobitsPerSecond, true);
  view.setUint16(8, lines, true);
  return view.buffer;
}

/** The page can decode neither this frame nor those that depend on it. */
export function encodeBroken({ frame }) {
  const view = message(Type.broken, 8);
  view.setUint32(4, frame, true);
  return view.buffer;
}

function tenths(milliseconds) {
  return Math.min(kLongestDuration, Math.max(0, Math.round(milliseconds * 10)));
}

/** `held`: milliseconds from arrival until now; `arrived`: microseconds by the page's clock, sent modulo 2^32. */
export function encodePresented({ frame, held, arrived }) {
  const view = message(Type.presented, 12);
  view.setUint16(2, tenths(held), true);
  view.setUint32(4, frame, true);
  view.setUint32(8, Math.floor(arrived) % 2 ** 32, true);
  return view.buffer;
}

/** Presented of 1.3: `decode` and `paint` are milliseconds, too; `paint` is 0 without painting. */
export function encodePainted({ frame, held, arrived, decode, paint }) {
  const view = message(Type.painted, 16);
  view.setUint16(2, tenths(held), true);
  view.setUint32(4, frame, true);
  view.setUint32(8, Math.floor(arrived) % 2 ** 32, true);
  view.setUint16(12, tenths(decode), true);
  view.setUint16(14, tenths(paint), true);
  return view.buffer;
}

/** Requests one picture of the full wanted size at the finest quality. */
export function encodeCapture({ number }) {
  const view = message(Type.capture, 8);
  view.setUint32(4, number, true);
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
  if (view.byteLength < kWaitingBytes) throw new ProtocolError('the message Waiting is cut short');
  if (view.byteLength !== kWaitingBytes + view.getUint32(4, true)) {
    throw new ProtocolError('the message Waiting has a wrong length');
  }
  const waiting = {
    message: 'Waiting',
    percent: view.getUint8(1),
    place: view.getUint16(2, true),
    step: decodeText(new Uint8Array(view.buffer, kWaitingBytes), 'the step of the message Waiting'),
  };
  if (waiting.percent > 100) throw new ProtocolError('the message Waiting has more than 100 percent');
  if (waiting.place === 0) throw new ProtocolError('the message Waiting has no place');
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
  if (frame.codec !== Codec.jpeg) throw new ProtocolError(`the frame's codec ${frame.codec} is unknown`);
  if (frame.width === 0 || frame.height === 0) throw new ProtocolError('the frame has no size');
  return frame;
}

/** Places of names, as shares of the picture's width and height, nearest first. */
function decodeLabels(view, count) {
  return Array.from({ length: count }, (_, index) => {
    const at = kPictureHeaderBytes + index * kLabelBytes;
    return {
      visitor: view.getUint32(at, true),
      x: view.getUint16(at + 4, true) / 0xffff,
      y: view.getUint16(at + 6, true) / 0xffff,
      opacity: view.getUint8(at + 8) / 0xff,
    };
  });
}

function decodePicture(view) {
  if (view.byteLength <= kPictureHeaderBytes) throw new ProtocolError('the picture has no bytes');
  const labels = view.getUint8(10);
  const headerBytes = kPictureHeaderBytes + labels * kLabelBytes;
  if (labels > kMaxLabels) throw new ProtocolError('the picture has too many labels');
  if (view.byteLength <= headerBytes) throw new ProtocolError('the picture has no bytes');
  const picture = {
    message: 'Picture',
    codec: view.getUint8(1),
    independent: (view.getUint8(2) & 1) !== 0,
    border: view.getUint8(3),
    width: view.getUint16(4, true),
    height: view.getUint16(6, true),
    visitors: view.getUint16(8, true),
    frame: view.getUint32(12, true),
    lastInput: view.getUint32(16, true),
    serverMicroseconds: view.getUint32(20, true),
    yaw: view.getFloat32(24, true),
    pitch: view.getFloat32(28, true),
    tanHalfX: view.getFloat32(32, true),
    tanHalfY: view.getFloat32(36, true),
    fire: view.getUint8(11) / 0xff,
    labels: decodeLabels(view, labels),
    picture: new Uint8Array(view.buffer, headerBytes),
  };
  if (!(picture.codec in kCodecNames)) throw new ProtocolError(`the picture's codec ${picture.codec} is unknown`);
  if (picture.width === 0 || picture.height === 0) throw new ProtocolError('the picture has no size');
  const { yaw, pitch, tanHalfX, tanHalfY } = picture;
  if (![yaw, pitch, tanHalfX, tanHalfY].every(Number.isFinite) || tanHalfX <= 0 || tanHalfY <= 0) {
    throw new ProtocolError("the picture's camera is invalid");
  }
  return picture;
}

function decodeStatus(view) {
  if (view.byteLength !== kStatusBytes) throw new ProtocolError('the status has a wrong length');
  const status = {
    message: 'Status',
    limitedBy: view.getUint8(1),
    framesPerSecond: view.getUint8(2),
    quality: view.getUint8(3),
    width: view.getUint16(4, true),
    height: view.getUint16(6, true),
    roundTripMilliseconds: view.getUint16(8, true),
    visitors: view.getUint16(10, true),
    kilobitsPerSecond: view.getUint32(12, true),
    lastInput: view.getUint32(16, true),
  };
  if (status.limitedBy > LimitedBy.browser) throw new ProtocolError('the status has an unknown limit');
  if (status.quality > 100) throw new ProtocolError('the status has more than 100 percent');
  return status;
}

function decodeRefining(view) {
  if (view.byteLength < kRefiningBytes) throw new ProtocolError('the message Refining is cut short');
  if (view.byteLength !== kRefiningBytes + view.getUint32(4, true)) {
    throw new ProtocolError('the message Refining has a wrong length');
  }
  const seconds = view.getUint16(2, true);
  const refining = {
    message: 'Refining',
    percent: view.getUint8(1),
    secondsLeft: seconds === kUnknownSeconds ? null : seconds,
    step: decodeText(new Uint8Array(view.buffer, kRefiningBytes), 'the step of the message Refining'),
  };
  if (refining.percent > 100) throw new ProtocolError('the message Refining has more than 100 percent');
  return refining;
}

function decodeCaptured(view) {
  if (view.byteLength <= kCapturedHeaderBytes) throw new ProtocolError('the captured picture has no bytes');
  const captured = {
    message: 'Captured',
    codec: view.getUint8(1),
    width: view.getUint16(2, true),
    height: view.getUint16(4, true),
    number: view.getUint32(8, true),
    picture: new Uint8Array(view.buffer, kCapturedHeaderBytes),
  };
  if (captured.codec !== Codec.jpeg) throw new ProtocolError(`the captured picture's codec ${captured.codec} is unknown`);
  if (captured.width === 0 || captured.height === 0) throw new ProtocolError('the captured picture has no size');
  return captured;
}

function decodeTimes(view) {
  if (view.byteLength !== kTimesBytes) throw new ProtocolError('the times have a wrong length');
  const at = (offset) => view.getUint16(offset, true) / 10;
  return { message: 'Times', queued: at(2), drawn: at(4), encoded: at(6), socket: at(8), line: at(10) };
}

function decodePeople(view) {
  if (view.byteLength < kPeopleBytes) throw new ProtocolError('the list of people is cut short');
  const flags = view.getUint8(1);
  if (flags > 1) throw new ProtocolError('the list of people has unknown flags');
  const people = [];
  let at = kPeopleBytes;
  for (let count = view.getUint16(2, true); count > 0; count -= 1) {
    const nameAt = at + kPersonBytes;
    if (view.byteLength < nameAt || view.byteLength < nameAt + view.getUint8(at + 7)) {
      throw new ProtocolError('the list of people is cut short');
    }
    const name = new Uint8Array(view.buffer, nameAt, view.getUint8(at + 7));
    people.push({
      visitor: view.getUint32(at, true),
      red: view.getUint8(at + 4),
      green: view.getUint8(at + 5),
      blue: view.getUint8(at + 6),
      name: decodeText(name, 'a name'),
    });
    at = nameAt + name.length;
  }
  if (at !== view.byteLength) throw new ProtocolError('the list of people has a wrong length');
  return { message: 'People', othersAreLost: flags === 1, people };
}

const kDecoders = Object.freeze({
  [Type.welcome]: decodeWelcome,
  [Type.frame]: decodeFrame,
  [Type.waiting]: decodeWaiting,
  [Type.picture]: decodePicture,
  [Type.status]: decodeStatus,
  [Type.refining]: decodeRefining,
  [Type.captured]: decodeCaptured,
  [Type.times]: decodeTimes,
  [Type.people]: decodePeople,
});

/** Decodes one message from an ArrayBuffer; a frame's `picture` is a view into it, not a copy. */
export function decodeServerMessage(data) {
  if (!(data instanceof ArrayBuffer)) throw new ProtocolError('the message is text');
  if (data.byteLength === 0) throw new ProtocolError('the message is empty');
  const view = new DataView(data);
  const decode = kDecoders[view.getUint8(0)];
  if (!decode) throw new ProtocolError(`the message type ${view.getUint8(0)} is unknown`);
  return decode(view);
}

/** Decodes the server's messages. Trusts no bytes: a violation of the protocol throws ProtocolError. */
import { decodePicture } from './picture_message.js';
import { Codec, kVersion, LimitedBy, Type } from './protocol.js';
import { ProtocolError } from './protocol_error.js';

const kWelcomeBytes = 20;
const kFrameHeaderBytes = 20;
const kWaitingBytes = 8;
const kStatusBytes = 20;
const kRefiningBytes = 8;
const kUnknownSeconds = 0xffff;
const kCapturedHeaderBytes = 12;
const kTimesBytes = 12;
const kPeopleBytes = 4;
const kPersonBytes = 8;
const kGroundBytes = 8;
const kHillBytes = 16;
const kObstacleBytes = 12;
const kMaxHills = 64;
const kMaxObstacles = 4096;

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

/** What visitors walk on and around, for the rules of walking: metres, x and z of centres. */
function decodeGround(view) {
  if (view.byteLength < kGroundBytes) throw new ProtocolError('the ground is cut short');
  const [hills, obstacles] = [view.getUint8(1), view.getUint16(2, true)];
  if (hills > kMaxHills || obstacles > kMaxObstacles) throw new ProtocolError('the ground has too much on it');
  const obstaclesAt = kGroundBytes + hills * kHillBytes;
  if (view.byteLength !== obstaclesAt + obstacles * kObstacleBytes) {
    throw new ProtocolError('the ground has a wrong length');
  }
  const number = (at) => view.getFloat32(at, true);
  const circle = (at) => ({ x: number(at), z: number(at + 4), radius: number(at + 8) });
  const ground = {
    message: 'Ground',
    radius: number(4),
    hills: Array.from({ length: hills }, (_, i) => {
      const at = kGroundBytes + i * kHillBytes;
      return { ...circle(at), height: number(at + 12) };
    }),
    obstacles: Array.from({ length: obstacles }, (_, i) => circle(obstaclesAt + i * kObstacleBytes)),
  };
  const parts = [...ground.hills, ...ground.obstacles];
  if (![ground, ...parts].every(({ radius }) => radius > 0)) throw new ProtocolError('the ground has an empty circle');
  const numbers = [ground.radius, ...parts.flatMap((part) => Object.values(part))];
  if (!numbers.every(Number.isFinite)) throw new ProtocolError('the ground is not of numbers');
  return ground;
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
  [Type.ground]: decodeGround,
});

/** Decodes one message from an ArrayBuffer; a frame's `picture` and `nearness` are views into it, not copies. */
export function decodeServerMessage(data) {
  if (!(data instanceof ArrayBuffer)) throw new ProtocolError('the message is text');
  if (data.byteLength === 0) throw new ProtocolError('the message is empty');
  const view = new DataView(data);
  const decode = kDecoders[view.getUint8(0)];
  if (!decode) throw new ProtocolError(`the message type ${view.getUint8(0)} is unknown`);
  return decode(view);
}

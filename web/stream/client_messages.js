/** Encodes the page's messages, all little-endian. */
import { kVersion, Type } from './protocol.js';

const kMaxNameBytes = 64;
/** The longest duration in 16 bits, in tenths of milliseconds. */
const kLongestDuration = 0xffff;

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

/**
 * The visitor's limits; 0 is no limit. `hidden`: of the page; `border`: send more than the window shows; `nearness`,
 * only to servers of 1.5: send pictures with their spaces.
 */
export function encodeLimits({ hidden, border, nearness = false, framesPerSecond, kilobitsPerSecond, lines }) {
  const view = message(Type.limits, 12);
  view.setUint8(1, (hidden ? 1 : 0) | (border ? 2 : 0) | (nearness ? 4 : 0));
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

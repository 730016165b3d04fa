import { kCodecNames } from './protocol.js';
import { ProtocolError } from './protocol_error.js';

const kPictureHeaderBytes = 40;
const kLabelBytes = 10;
const kMaxLabels = 24;
const kSpaceBytes = 40;
const kMovingPartBytes = 20;
const kMaxMovingParts = 16;

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

/** Where an object moves by itself: rectangle in pixels, view depths in metres, velocity in metres per second. */
function decodeMovingPart(view, at) {
  const numbers = Array.from({ length: 6 }, (_, i) => view.getUint16(at + 2 * i, true));
  const [left, top, right, bottom, nearest, farthest] = numbers;
  const velocity = [view.getFloat32(at + 12, true), 0, view.getFloat32(at + 16, true)];
  if (left >= right || top >= bottom || nearest === 0 || nearest > farthest || !velocity.every(Number.isFinite)) {
    throw new ProtocolError('a moving part of the picture is invalid');
  }
  return { left, top, right, bottom, nearest: nearest / 100, farthest: farthest / 100, velocity };
}

/**
 * Where the picture was made: its eye (x, y, z in metres), which is ahead of a visitor who walks; the visitor's eye and
 * velocity along x and z (m/s) at `sinceInput` milliseconds after `lastInput`; the parts that move, nearest first; and
 * the coded depths, for nearness_grid.js.
 */
function decodeSpace(view, at) {
  if (view.byteLength < at + kSpaceBytes) throw new ProtocolError("the picture's space is cut short");
  const numbers = Array.from({ length: 8 }, (_, i) => view.getFloat32(at + 4 * i, true));
  if (!numbers.every(Number.isFinite)) throw new ProtocolError("the picture's space is not of numbers");
  const nearnessBytes = view.getUint16(at + 36, true);
  const moving = view.getUint8(at + 38);
  if (moving > kMaxMovingParts) throw new ProtocolError('the picture has too many moving parts');
  if (view.getUint8(at + 39) !== 0) throw new ProtocolError("the picture's space has unknown fields");
  const partsAt = at + kSpaceBytes;
  const gridAt = partsAt + moving * kMovingPartBytes;
  if (view.byteLength < gridAt + nearnessBytes) throw new ProtocolError("the picture's space is cut short");
  return {
    eye: numbers.slice(0, 3),
    visitor: numbers.slice(3, 6),
    velocity: numbers.slice(6),
    sinceInput: view.getUint32(at + 32, true) / 1000,
    moving: Array.from({ length: moving }, (_, i) => decodeMovingPart(view, partsAt + i * kMovingPartBytes)),
    nearness: new Uint8Array(view.buffer, gridAt, nearnessBytes),
  };
}

/** Decodes the message Picture. Throws ProtocolError. */
export function decodePicture(view) {
  if (view.byteLength <= kPictureHeaderBytes) throw new ProtocolError('the picture has no bytes');
  const labels = view.getUint8(10);
  if (labels > kMaxLabels) throw new ProtocolError('the picture has too many labels');
  const labelsEnd = kPictureHeaderBytes + labels * kLabelBytes;
  const space = (view.getUint8(2) & 2) === 0 ? null : decodeSpace(view, labelsEnd);
  const headerBytes = space ? space.nearness.byteOffset + space.nearness.length : labelsEnd;
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
    space,
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

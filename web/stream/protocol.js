/**
 * What both sides of server/stream/protocol/PROTOCOL.md, version 1, share. client_messages.js encodes the page's
 * messages, server_messages.js decodes the server's.
 */

/**
 * The versions to request, newest first. 1.1 adds Waiting; 1.2 the choice of codec; 1.3 Painted, Capture and Times; 1.4
 * labels and People; 1.5 Ground and the spaces of pictures.
 */
export const kSpatialProtocols = Object.freeze(['grove.v1.5']);
export const kMeasuringProtocols = Object.freeze([...kSpatialProtocols, 'grove.v1.4', 'grove.v1.3']);
export const kAdaptiveProtocols = Object.freeze([...kMeasuringProtocols, 'grove.v1.2']);
export const kSubProtocols = Object.freeze([...kAdaptiveProtocols, 'grove.v1.1', 'grove.v1']);
export const kVersion = 1;

/** Bits of an input's `keys`. */
export const Key = Object.freeze({ forward: 1, back: 2, left: 4, right: 8, run: 16, blow: 32 });

/** The server's reasons to close a connection, as far as the page acts on them. */
export const CloseCode = Object.freeze({ protocolError: 4000, wrongVersion: 4001, full: 4002, flood: 4004, hidden: 4006 });

export const Codec = Object.freeze({ jpeg: 1, h264: 2, jpegPatches: 3 });
export const kCodecNames = Object.freeze({ [Codec.jpeg]: 'JPEG', [Codec.h264]: 'H.264', [Codec.jpegPatches]: 'JPEG' });

/** The stream's bottleneck. */
export const LimitedBy = Object.freeze({ nothing: 0, line: 1, machine: 2, visitor: 3, browser: 4 });

export const Type = Object.freeze({
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
  ground: 0x8a,
});

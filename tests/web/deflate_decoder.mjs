import { IndependentDecoder } from '../../web/picture/independent_decoder.js';

/** BT.601 full range, as raster/yuv_image.h has it. */
const kColours = { primaries: 'smpte170m', transfer: 'smpte170m', matrix: 'smpte170m', fullRange: true };

/** The planes Y, U and V of a picture of DeflateEncoder. Rejects if it is damaged. */
export async function planesOf(bytes) {
  const inflated = new Blob([bytes]).stream().pipeThrough(new DecompressionStream('deflate'));
  const planes = new Uint8Array(await new Response(inflated).arrayBuffer());
  for (let i = 1; i < planes.length; i += 1) planes[i] += planes[i - 1];
  return planes;
}

function toVideoFrame(planes, { width, height }) {
  return new VideoFrame(planes, {
    format: 'I420',
    codedWidth: width,
    codedHeight: height,
    timestamp: 0,
    colorSpace: kColours,
  });
}

/** Makes a decoder as web/picture/decoders.js describes it. */
export function deflateDecoder({ makeImage = toVideoFrame, ...parts }) {
  const decode = async (picture) => makeImage(await planesOf(picture.picture), picture);
  return new IndependentDecoder({ ...parts, decode });
}

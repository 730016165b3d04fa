import { H264Decoder } from './h264_decoder.js';
import { JpegDecoder, decodeJpegToFrame } from './jpeg_decoder.js';
import { Codec } from '../stream/protocol.js';

/**
 * How to make a decoder for each codec. Every decoder has `push(picture)` and `close()`, after which it tells nothing
 * more, and is made with what it calls:
 *
 * - `onImage(image, picture)` hands over an ImageBitmap or a VideoFrame, to be closed by who takes it.
 * - `onFailure(error, picture)`: the picture, or the newest that was inside, cannot be decoded; make another decoder.
 *   `picture` is `null` if there was none.
 * - `onHeld(picture)`: all up to this one are inside for long; the server must not wait for their being shown.
 *
 * `software` asks for a decoder that does not use the graphics card. To add a codec, add it here, to protocol.js and to
 * codecs.js. `paintsInSoftware`: so does the browser's canvas.
 */
export function decoders(window, clock, paintsInSoftware = false) {
  const decode = paintsInSoftware && window.ImageDecoder ? decodeJpegToFrame : undefined;
  return {
    [Codec.jpeg]: (parts) => new JpegDecoder({ decode, ...parts }),
    [Codec.h264]: (parts) => new H264Decoder({ window, clock, ...parts }),
  };
}

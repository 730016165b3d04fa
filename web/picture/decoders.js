import { H264Decoder } from './h264_decoder.js';
import { IndependentDecoder, decodeJpeg, decodeJpegToFrame } from './independent_decoder.js';
import { patchDecoder } from './patch_decoder.js';
import { Codec } from '../stream/protocol.js';

/**
 * Makers of the decoders, by codec. A decoder has `push(picture)` and `close()`, after which it calls nothing. Its
 * maker takes:
 *
 * - `onImage(image, picture)`: passes on an ImageBitmap or a VideoFrame, which the callee closes.
 * - `onFailure(error, picture)`: the picture, or the newest inside, cannot be decoded; make another decoder. `picture`
 *   is `null` if there was none.
 * - `onHeld(picture)`: all pictures up to this one are inside for long; the server must not wait until they are shown.
 * - `software`: use no graphics card.
 *
 * `makeCanvas()` makes a hidden canvas. `paintsInSoftware`: the browser paints canvases without a graphics card. To add a
 * codec, add it here, to protocol.js and to codecs.js.
 */
export function decoders({ window, clock, makeCanvas, paintsInSoftware }) {
  const decode = paintsInSoftware && window.ImageDecoder ? decodeJpegToFrame : decodeJpeg;
  return {
    [Codec.jpeg]: (parts) => new IndependentDecoder({ decode, ...parts }),
    [Codec.jpegPatches]: (parts) => patchDecoder({ decode, makeCanvas, ...parts }),
    [Codec.h264]: (parts) => new H264Decoder({ window, clock, ...parts }),
  };
}

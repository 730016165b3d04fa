import { kSettings } from '../texts.js';

/** The profile of the server's encoder, Constrained Baseline, at level 4: 1080 lines at 30 frames/s. */
const kH264 = 'avc1.42E028';

/** The reason why this browser cannot show H.264 here, or ''. */
export async function h264Hindrance({ isSecureContext, VideoDecoder }) {
  if (!isSecureContext) return kSettings.insecure;
  if (!VideoDecoder) return kSettings.noWebCodecs;
  try {
    const { supported } = await VideoDecoder.isConfigSupported({ codec: kH264 });
    return supported ? '' : kSettings.notDecoded;
  } catch {
    return kSettings.notDecoded;
  }
}

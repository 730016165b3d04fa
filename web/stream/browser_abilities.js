import { kSettings } from '../texts.js';

/** Constrained Baseline, as the server's encoder writes it, level 4: 1080 lines at 30 frames a second. */
const kH264 = 'avc1.42E028';

/** Why this browser cannot show H.264 here, or ''. */
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

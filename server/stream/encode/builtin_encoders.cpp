#include "base/version.h"
#include "stream/encode/encoder_registry.h"
#include "stream/encode/h264/scene_encoder.h"
#include "stream/encode/h264_encoder.h"
#include "stream/encode/jpeg/jpeg_encoder.h"
#include "stream/encode/jpeg/jpeg_patch_encoder.h"
#include "stream/protocol/protocol.h"

namespace grove::stream {

EncoderRegistry builtinEncoders(int jpegQuality) {
  EncoderRegistry registry;
  registry.add({kCodecJpeg, false, "libjpeg-turbo", "libjpeg-turbo " GROVE_TURBOJPEG_VERSION,
                [jpegQuality] { return std::make_unique<JpegEncoder>(jpegQuality); }});
  registry.add({kCodecJpegPatches, false, "libjpeg-turbo patches", "libjpeg-turbo " GROVE_TURBOJPEG_VERSION,
                [jpegQuality] { return std::make_unique<JpegPatchEncoder>(jpegQuality); }});
  registry.add(
      {kCodecH264, true, "openh264", "OpenH264 " + openH264Version(), [] { return std::make_unique<H264Encoder>(); }});
#if GROVE_SCENE_ENCODER
  registry.add({kCodecH264, true, "grove", "Grove " + std::string(version()),
                [] { return std::make_unique<h264::SceneEncoder>(); }});
#endif
  return registry;
}

}  // namespace grove::stream

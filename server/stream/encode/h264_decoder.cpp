#include "stream/encode/h264_decoder.h"

#include <libyuv/convert_argb.h>
#include <wels/codec_api.h>

#include <array>

#include "base/error.h"

namespace grove::stream {

H264Decoder::H264Decoder() {
  ISVCDecoder* decoder = nullptr;
  const long failed = WelsCreateDecoder(&decoder);
  decoder_.reset(decoder);
  SDecodingParam parameters{};
  parameters.sVideoProperty.size = sizeof parameters.sVideoProperty;
  parameters.sVideoProperty.eVideoBsType = VIDEO_BITSTREAM_AVC;
  parameters.eEcActiveIdc = ERROR_CON_DISABLE;  // reports damage instead of concealing it
  int level = WELS_LOG_QUIET;
  if (failed != 0 || decoder == nullptr || decoder->SetOption(DECODER_OPTION_TRACE_LEVEL, &level) != cmResultSuccess ||
      decoder->Initialize(&parameters) != cmResultSuccess) {
    throw EnvironmentError("cannot be started", "H.264 decoder", "");
  }
}

void H264Decoder::Deleter::operator()(ISVCDecoder* decoder) const noexcept {
  decoder->Uninitialize();
  WelsDestroyDecoder(decoder);
}

const DecodedPicture* H264Decoder::decode(std::span<const std::uint8_t> accessUnit) {
  std::array<unsigned char*, 3> planes{};
  SBufferInfo info{};
  const DECODING_STATE state =
      decoder_->DecodeFrameNoDelay(accessUnit.data(), static_cast<int>(accessUnit.size()), planes.data(), &info);
  if (state != dsErrorFree || info.iBufferStatus != 1) return nullptr;
  const SSysMEMBuffer& buffer = info.UsrData.sSystemBuffer;
  picture_.width = buffer.iWidth;
  picture_.height = buffer.iHeight;
  picture_.colour.resize(static_cast<std::size_t>(picture_.width) * static_cast<std::size_t>(picture_.height));
  // The library names byte orders as little-endian numbers, so ABGR is R, G, B, A in memory.
  const int failed = libyuv::J420ToABGR(planes[0], buffer.iStride[0], planes[1], buffer.iStride[1], planes[2],
                                        buffer.iStride[1], reinterpret_cast<std::uint8_t*>(picture_.colour.data()),
                                        4 * picture_.width, picture_.width, picture_.height);
  return failed == 0 ? &picture_ : nullptr;
}

}  // namespace grove::stream

#include "stream/encode/h264_stream.h"

#include <gtest/gtest.h>
#include <wels/codec_api.h>

#include <algorithm>

namespace grove::stream {

H264Stream::H264Stream(int width, int height) : width_(width), height_(height) {
  ISVCEncoder* encoder = nullptr;
  EXPECT_EQ(WelsCreateSVCEncoder(&encoder), 0);
  encoder_.reset(encoder);
  int level = WELS_LOG_QUIET;
  encoder->SetOption(ENCODER_OPTION_TRACE_LEVEL, &level);
  SEncParamBase parameters{};
  parameters.iUsageType = CAMERA_VIDEO_REAL_TIME;
  parameters.fMaxFrameRate = 30.0F;
  parameters.iPicWidth = width;
  parameters.iPicHeight = height;
  parameters.iTargetBitrate = 2'000'000;
  parameters.iRCMode = RC_OFF_MODE;
  EXPECT_EQ(encoder->Initialize(&parameters), cmResultSuccess);
}

void H264Stream::Deleter::operator()(ISVCEncoder* encoder) const noexcept {
  encoder->Uninitialize();
  WelsDestroySVCEncoder(encoder);
}

std::vector<std::uint8_t> H264Stream::next(std::uint8_t y, std::uint8_t u, std::uint8_t v, int bar, bool independent) {
  const auto pixels = static_cast<std::size_t>(width_) * static_cast<std::size_t>(height_);
  std::vector<std::uint8_t> planes(pixels * 3 / 2, y);
  const int row = bar * kBarRows % (height_ - kBarRows);
  std::fill_n(planes.begin() + row * width_, kBarRows * width_, static_cast<std::uint8_t>(y + 20));
  std::fill_n(planes.begin() + static_cast<std::ptrdiff_t>(pixels), pixels / 4, u);
  std::fill_n(planes.begin() + static_cast<std::ptrdiff_t>(pixels * 5 / 4), pixels / 4, v);
  SSourcePicture picture{};
  picture.iColorFormat = videoFormatI420;
  picture.iPicWidth = width_;
  picture.iPicHeight = height_;
  picture.iStride[0] = width_;
  picture.iStride[1] = picture.iStride[2] = width_ / 2;
  picture.pData[0] = planes.data();
  picture.pData[1] = planes.data() + pixels;
  picture.pData[2] = planes.data() + pixels * 5 / 4;
  if (independent) encoder_->ForceIntraFrame(true);
  SFrameBSInfo info{};
  EXPECT_EQ(encoder_->EncodeFrame(&picture, &info), cmResultSuccess);
  std::vector<std::uint8_t> bytes;
  for (int layer = 0; layer < info.iLayerNum; ++layer) {
    const SLayerBSInfo& units = info.sLayerInfo[layer];
    int length = 0;
    for (int i = 0; i < units.iNalCount; ++i) length += units.pNalLengthInByte[i];
    bytes.insert(bytes.end(), units.pBsBuf, units.pBsBuf + length);
  }
  return bytes;
}

}  // namespace grove::stream

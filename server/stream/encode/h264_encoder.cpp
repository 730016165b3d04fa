#include "stream/encode/h264_encoder.h"

#include <wels/codec_api.h>

#include <algorithm>
#include <cassert>
#include <cmath>
#include <cstring>

#include "base/error.h"
#include "stream/protocol/protocol.h"

namespace grove::stream {
namespace {

/// With a finest quantiser of 20, figures that pass before a still sky leave pixels that are wrong by up to 22 of 255.
constexpr QuantiserRange kRange{.finest = 12.0, .usual = 25.0, .coarsest = 40.0};
/// The library's memory per pixel: the previous picture and its scratch buffers.
constexpr std::size_t kBytesPerPixel = 8;

[[noreturn]] void fail(const char* what, int code) {
  throw EnvironmentError(std::string(what) + " (" + std::to_string(code) + ")", "OpenH264", "offer JPEG only");
}

void describe(SEncParamExt& parameters, int width, int height, int quantiser) {
  parameters.iUsageType = CAMERA_VIDEO_REAL_TIME;
  parameters.iPicWidth = width;
  parameters.iPicHeight = height;
  parameters.iRCMode = RC_OFF_MODE;
  parameters.fMaxFrameRate = 30.0F;
  parameters.iComplexityMode = LOW_COMPLEXITY;
  parameters.uiIntraPeriod = 0;
  parameters.iNumRefFrame = 1;
  parameters.eSpsPpsIdStrategy = CONSTANT_ID;
  parameters.bEnableFrameSkip = false;
  parameters.iMultipleThreadIdc = 1;
  parameters.bEnableDenoise = false;
  parameters.bEnableSceneChangeDetect = false;
  parameters.bEnableBackgroundDetection = false;
  parameters.bEnableAdaptiveQuant = false;
  parameters.iEntropyCodingModeFlag = 0;
  SSpatialLayerConfig& layer = parameters.sSpatialLayers[0];
  layer.iVideoWidth = width;
  layer.iVideoHeight = height;
  layer.fFrameRate = parameters.fMaxFrameRate;
  layer.uiProfileIdc = PRO_BASELINE;
  layer.uiLevelIdc = LEVEL_UNKNOWN;
  layer.iDLayerQp = quantiser;
  layer.sSliceArgument.uiSliceMode = SM_SINGLE_SLICE;
  layer.bVideoSignalTypePresent = true;
  layer.uiVideoFormat = VF_UNDEF;
  layer.bFullRange = true;
  layer.bColorDescriptionPresent = true;
  layer.uiColorPrimaries = CP_SMPTE170M;
  layer.uiTransferCharacteristics = TRC_SMPTE170M;
  layer.uiColorMatrix = CM_SMPTE170M;
}

}  // namespace

void H264Encoder::Deleter::operator()(ISVCEncoder* encoder) const noexcept {
  encoder->Uninitialize();
  WelsDestroySVCEncoder(encoder);
}

H264Encoder::H264Encoder() {
  ISVCEncoder* encoder = nullptr;
  if (const int failed = WelsCreateSVCEncoder(&encoder); failed != 0) fail("cannot make an encoder", failed);
  encoder_.reset(encoder);
  int quiet = WELS_LOG_QUIET;
  encoder_->SetOption(ENCODER_OPTION_TRACE_LEVEL, &quiet);
}

H264Encoder::~H264Encoder() = default;

std::uint8_t H264Encoder::codec() const noexcept { return kCodecH264; }

QuantiserRange H264Encoder::range() const noexcept { return kRange; }

std::size_t H264Encoder::bytes() const noexcept {
  return static_cast<std::size_t>(width_) * static_cast<std::size_t>(height_) * kBytesPerPixel;
}

void H264Encoder::start(int width, int height, int quantiser) {
  if (started_) encoder_->Uninitialize();
  SEncParamExt parameters;
  encoder_->GetDefaultParams(&parameters);
  describe(parameters, width, height, quantiser);
  if (const int failed = encoder_->InitializeExt(&parameters); failed != 0) {
    started_ = false;
    fail("refuses the size of a picture", failed);
  }
  started_ = true;
  width_ = width;
  height_ = height;
  quantiser_ = quantiser;
}

void H264Encoder::setQuantiser(int quantiser) {
  if (quantiser == quantiser_) return;
  SEncParamExt parameters;
  std::memset(&parameters, 0, sizeof parameters);
  encoder_->GetOption(ENCODER_OPTION_SVC_ENCODE_PARAM_EXT, &parameters);
  parameters.sSpatialLayers[0].iDLayerQp = quantiser;
  if (const int failed = encoder_->SetOption(ENCODER_OPTION_SVC_ENCODE_PARAM_EXT, &parameters); failed != 0) {
    fail("refuses a quantiser", failed);
  }
  quantiser_ = quantiser;
}

bool H264Encoder::encode(const raster::YuvImage& picture, const EncodeOrder& order, std::vector<std::uint8_t>& out) {
  const int quantiser = static_cast<int>(std::lround(std::clamp(order.quantiser, kRange.finest, kRange.coarsest)));
  const bool resized = !started_ || width_ != picture.width() || height_ != picture.height();
  if (resized) {
    start(picture.width(), picture.height(), quantiser);
  } else {
    setQuantiser(quantiser);
  }
  if (order.independent && !resized) encoder_->ForceIntraFrame(true);
  SSourcePicture source;
  std::memset(&source, 0, sizeof source);
  source.iColorFormat = videoFormatI420;
  source.iPicWidth = width_;
  source.iPicHeight = height_;
  source.iStride[0] = width_;
  source.iStride[1] = source.iStride[2] = width_ / 2;
  // The library only reads these, but its interface lacks const.
  source.pData[0] = const_cast<unsigned char*>(picture.y());
  source.pData[1] = const_cast<unsigned char*>(picture.u());
  source.pData[2] = const_cast<unsigned char*>(picture.v());
  SFrameBSInfo info;
  std::memset(&info, 0, sizeof info);
  if (const int failed = encoder_->EncodeFrame(&source, &info); failed != cmResultSuccess) {
    fail("cannot encode a picture", failed);
  }
  for (int i = 0; i < info.iLayerNum; ++i) {
    const SLayerBSInfo& layer = info.sLayerInfo[i];
    int bytes = 0;
    for (int nal = 0; nal < layer.iNalCount; ++nal) bytes += layer.pNalLengthInByte[nal];
    out.insert(out.end(), layer.pBsBuf, layer.pBsBuf + bytes);
  }
  return info.eFrameType == videoFrameTypeIDR;
}

std::string openH264Version() {
  const OpenH264Version version = WelsGetCodecVersion();
  return std::to_string(version.uMajor) + "." + std::to_string(version.uMinor) + "." +
         std::to_string(version.uRevision);
}

}  // namespace grove::stream

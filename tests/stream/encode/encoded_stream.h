#pragma once

#include <algorithm>
#include <memory>
#include <utility>
#include <vector>

#include "pipeline/clocks.h"
#include "pipeline/worker_pool.h"
#include "stream/encode/encode_stage.h"
#include "yuv_pictures.h"

namespace grove::stream {

/// A stage, a stream's control and what comes out of it, of one visitor whose page takes H.264.
class Stream {
 public:
  explicit Stream(EncoderRegistry encoders = builtinEncoders(80), PageLevel page = PageLevel::kTimed)
      : encoders_(std::move(encoders)),
        control_(std::make_shared<StreamControl>(encoders_, std::make_shared<Governor>([] { return 0.0; }), page, 30.0,
                                                 320, 180)),
        stage_(std::make_shared<EncodeStage>(
            control_, page, std::vector<world::Vec3>{{0, 1.7F, 3}, {0, 1.7F, -30}},
            EncodeStage::Outputs{
                .frame =
                    [this](const std::shared_ptr<const EncodedFrame>& frame) {
                      control_->sent(frame->header.frame, frame->header.lastInput, frame->message().size(),
                                     frame->allowedBytes, pipeline::wallSeconds());
                      sent_.push_back(frame);
                    },
                .captured = [this](std::vector<std::uint8_t> message) { captured_ = std::move(message); }},
            memory_, workers_, timeline_)) {
    control_->offer({kCodecH264, kCodecJpeg});
  }

  /// Sends a frame through; returns the Picture, or null if none was sent.
  std::shared_ptr<const EncodedFrame> push(const std::vector<std::uint32_t>& pixels, float yaw = 0.0F) {
    const std::size_t before = sent_.size();
    stage_->push(frame(pixels, yaw));
    workers_.drain();
    return sent_.size() > before ? sent_.back() : nullptr;
  }
  /// Pushes without waiting for what comes of it.
  void rush(const std::vector<std::uint32_t>& pixels) { stage_->push(frame(pixels, 0.0F)); }
  /// Waits until all that was rushed is dealt with, up to kMaxRushed frames.
  void drain() {
    // A run posts the one after it, which WorkerPool::drain() does not wait for.
    for (int run = 0; run <= kMaxRushed; ++run) workers_.drain();
  }
  static constexpr int kMaxRushed = 4;

  std::vector<node::Label> labels;  ///< of the frames to come
  std::vector<node::Mover> movers;

  StreamControl& control() { return *control_; }
  [[nodiscard]] const std::vector<std::shared_ptr<const EncodedFrame>>& sent() const { return sent_; }
  [[nodiscard]] std::uint32_t pushed() const { return number_; }

  static constexpr std::size_t kPixels = std::size_t{320} * 180;

 private:
  node::FinishedFrame frame(const std::vector<std::uint32_t>& pixels, float yaw) {
    std::vector<std::uint32_t> own = pixels;
    raster::Image image;
    image.rect = {0, 0, 320, 180};
    image.colour = own;
    node::View view;
    view.frame = ++number_;
    view.lastInput = 10 * number_;
    view.camera.width = 320;
    view.camera.height = 180;
    view.camera.pose.yaw = yaw;
    view.inputAge = 0.25;
    view.viewerEye = {1.0F, 2.0F, 3.0F};
    view.viewerVelocity = {4.0F, 0.0F, 5.0F};
    view.time = pipeline::wallSeconds();
    const auto nearness = std::make_shared<node::CellNearness>(320, 180, images_);
    std::ranges::fill(nearness->cells(), 0.0F);
    return {std::make_shared<const node::View>(view), tests::yuvOf(image), labels, nearness, movers};
  }

  raster::ImagePool images_;
  const EncoderRegistry encoders_;
  pipeline::Timeline timeline_;
  pipeline::MemoryLedger memory_;
  std::vector<std::shared_ptr<const EncodedFrame>> sent_;
  std::vector<std::uint8_t> captured_;
  std::shared_ptr<StreamControl> control_;
  pipeline::WorkerPool workers_{1};
  std::shared_ptr<EncodeStage> stage_;
  std::uint32_t number_ = 0;
};

/// A picture for Stream, the same for the same seed.
inline std::vector<std::uint32_t> grain(std::uint32_t seed) {
  std::vector<std::uint32_t> pixels(Stream::kPixels);
  for (std::size_t i = 0; i < pixels.size(); ++i) {
    const auto at = static_cast<std::uint32_t>(i);
    pixels[i] = 0xFF000000U | ((((at / 7U) * 2654435761U + seed * 40503U) >> 26U) * 0x010101U);
  }
  return pixels;
}

}  // namespace grove::stream

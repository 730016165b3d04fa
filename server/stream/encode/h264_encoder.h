#pragma once

#include <memory>
#include <string>

#include "stream/encode/encoder.h"

class ISVCEncoder;

namespace grove::stream {

/// H.264, Constrained Baseline, by OpenH264: each picture depends on the previous one, none is delayed or reordered,
/// and independent ones are made on request only. 6 to 9 ms of CPU for 1280 x 720 pixels of a walk, on the calling
/// thread.
class H264Encoder final : public Encoder {
 public:
  /// Throws EnvironmentError if the library cannot start.
  H264Encoder();
  ~H264Encoder() override;

  [[nodiscard]] std::uint8_t codec() const noexcept override;
  [[nodiscard]] QuantiserRange range() const noexcept override;
  bool encode(const raster::YuvImage& picture, const EncodeOrder& order, std::vector<std::uint8_t>& out) override;
  [[nodiscard]] std::size_t bytes() const noexcept override;

 private:
  struct Deleter {
    void operator()(ISVCEncoder* encoder) const noexcept;
  };
  /// Prepares for pictures of this size; the first one is independent.
  void start(int width, int height, int quantiser);
  void setQuantiser(int quantiser);

  std::unique_ptr<ISVCEncoder, Deleter> encoder_;
  int width_ = 0;
  int height_ = 0;
  int quantiser_ = 0;
  bool started_ = false;
};

/// Version of the linked library, for example "2.3.1".
[[nodiscard]] std::string openH264Version();

}  // namespace grove::stream

#pragma once

#include <cstdint>
#include <memory>
#include <span>
#include <vector>

class ISVCEncoder;

namespace grove::stream {

/// Makes H.264 as PROTOCOL.md says it is, of pictures of one colour.
class H264Stream {
 public:
  static constexpr int kBarRows = 8;
  H264Stream(int width, int height);

  /// The next access unit: of limited-range BT.601, with a brighter bar, kBarRows high, the `bar`-th from the top (and
  /// so on from the top again), so that pictures differ.
  [[nodiscard]] std::vector<std::uint8_t> next(std::uint8_t y, std::uint8_t u, std::uint8_t v, int bar,
                                               bool independent = false);

 private:
  struct Deleter {
    void operator()(ISVCEncoder* encoder) const noexcept;
  };
  const int width_;
  const int height_;
  std::unique_ptr<ISVCEncoder, Deleter> encoder_;
};

}  // namespace grove::stream

#pragma once

#include <chrono>
#include <cstdint>
#include <vector>

#include "stream/session/headless_session.h"

namespace grove::integration {

/// How long a loaded machine under a sanitizer may take for a frame.
inline constexpr std::chrono::seconds kPatience{60};

/// A decoded frame.
struct Picture {
  int width = 0;
  int height = 0;
  std::vector<std::uint32_t> colour;

  [[nodiscard]] double light(int x, int y) const;
  [[nodiscard]] double mean() const;
  /// Middle of the light in columns [from, to), as a share of the width.
  [[nodiscard]] double middle(double from, double to) const;
};

[[nodiscard]] Picture decode(const std::shared_ptr<const stream::EncodedFrame>& frame);

/// Mean over the pixels of the difference of their light.
[[nodiscard]] double difference(const Picture& a, const Picture& b);

/// Sets the controls and returns a frame that shows them.
[[nodiscard]] Picture pictureAfter(stream::HeadlessSession& visitor, std::uint8_t keys, float yaw, float pitch = 0.0F);

/// A picture that shows an input, once three in a row are equal; the last of `looks`, a tenth of a second apart, if
/// none are.
[[nodiscard]] Picture settledPicture(stream::HeadlessSession& visitor, std::uint32_t input, int looks = 12);

}  // namespace grove::integration

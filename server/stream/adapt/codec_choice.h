#pragma once

#include <cstdint>

namespace grove::stream {

/// Chooses between a codec that saves bits (H.264) and one that saves server time (JPEG). Chooses JPEG while the server
/// is too slow, the view moves, and line and browser can carry it. A still view costs almost nothing in H.264, and
/// browsers without a GPU take longer for a JPEG. Not thread-safe; times are monotonic seconds.
class CodecChoice {
 public:
  struct Means {
    bool isWorkScarce = false;            ///< the server delays frames
    bool isBrowserShort = false;          ///< the browser delays frames
    bool isStill = false;                 ///< the camera has not moved for a while
    bool isLineScarce = false;            ///< the line makes pictures smaller or fewer
    double lineBitsPerSecond = 0.0;       ///< available to the stream
    double provenBitsPerSecond = 0.0;     ///< the line has carried these lately
    double workSaverBitsPerSecond = 0.0;  ///< the codec that saves time would need these
  };

  /// Whether a codec, a number of PROTOCOL.md, saves time instead of bits.
  [[nodiscard]] static bool isWorkSaver(std::uint8_t codec) noexcept;

  /// Returns whether to use the codec that saves time. Call at least a few times a second.
  bool update(double now, const Means& means);
  [[nodiscard]] bool savesWork() const noexcept { return savesWork_; }

 private:
  void change(bool savesWork, double now);

  bool savesWork_ = false;
  bool failed_ = false;  ///< the line or the browser could not carry it
  double changed_ = 0.0;
  double reasonSince_ = -1.0;  ///< there has been a reason to change; negative: none
  double failureRest_ = 30.0;  ///< seconds until the next try
  double workRest_ = 60.0;     ///< seconds with a fast enough server until bits are saved again
};

}  // namespace grove::stream

#pragma once

namespace grove::stream {

/// Decides between a codec that saves bits (H.264) and one that saves the server work (JPEG): the second while the
/// server is short of time, the view moves, and line and browser carry it. A view that stands still is almost free in
/// H.264, and browsers without a graphics card take longer for a JPEG. One thread at a time; times are seconds that do
/// not go back.
class CodecChoice {
 public:
  struct Means {
    bool isWorkScarce = false;            ///< frames wait for the server
    bool isBrowserShort = false;          ///< frames wait for the browser
    bool isStill = false;                 ///< the camera has been standing for a while
    bool isLineScarce = false;            ///< pictures are smaller or fewer because of the line
    double lineBitsPerSecond = 0.0;       ///< that the stream may take
    double provenBitsPerSecond = 0.0;     ///< that the line is known to have carried of late
    double workSaverBitsPerSecond = 0.0;  ///< that the codec that saves work would take
  };

  /// Whether the codec that saves work is the better one. To be asked a few times a second at least.
  bool update(double now, const Means& means);
  [[nodiscard]] bool savesWork() const noexcept { return savesWork_; }

 private:
  void change(bool savesWork, double now);

  bool savesWork_ = false;
  bool failed_ = false;  ///< the line or the browser did not carry it
  double changed_ = 0.0;
  double reasonSince_ = -1.0;  ///< to change; negative: there is none
  double failureRest_ = 30.0;  ///< until it is tried again
  double workRest_ = 60.0;     ///< without scarcity until bits are saved again
};

}  // namespace grove::stream

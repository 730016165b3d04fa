#pragma once

#include <array>
#include <cstdint>
#include <functional>
#include <map>
#include <mutex>
#include <optional>
#include <utility>

#include "node/limits.h"
#include "node/messages/view.h"

namespace grove::objects::lightfield {

/// Limits the rate of new pictures to the machine's speed. Pictures age with the distance that a visitor walks: a slow
/// machine shows the visitor farther on in every frame, would need more new pictures per frame, and would fall behind
/// further. So all visitors together get a number of texels per second of the world clock, and keep their old pictures
/// when those are spent.
///
/// Each visitor has a token bucket; all fill at the same rate and overflow into a shared bucket. A new visitor's bucket
/// is empty if others are present, so that the first frame does not delay theirs. A picture is made if the visitor's
/// bucket has enough tokens or the shared one does; its cost may leave the visitor's bucket in debt. So in t seconds
/// all visitors together take at most t + 2 kBurst seconds' worth, plus one picture each, plus what they borrow,
/// independent of the times of their views. Any thread.
class PictureBudget {
 public:
  static constexpr double kBurst = 0.25;     ///< capacity of a bucket in seconds' worth: one frame of a slow machine
  static constexpr int kMaxNewPictures = 2;  ///< per frame; pictures with an error above kUrgentError are exempt
  static constexpr float kUrgentError = 3.0F;

  /// Factor by which the rate is reduced at present, see node::errorFactor(). Any thread.
  using ErrorFactor = std::function<float()>;

  /// Returns this process's estimate of the world clock; the time of a view comes from another process. Any thread.
  using Clock = std::function<std::optional<double>()>;

  PictureBudget(double texelsPerSecond, ErrorFactor errorFactor, Clock clock)
      : texelsPerSecond_(texelsPerSecond), errorFactor_(std::move(errorFactor)), clock_(std::move(clock)) {}

  /// Whether to make a picture of this many texels in this frame; takes the tokens if so. `error` is the error of the
  /// present picture relative to the permitted error, or infinite without a picture. The larger it is, the emptier the
  /// bucket may be.
  [[nodiscard]] bool take(const node::View& view, std::int64_t texels, float error);

  /// Takes tokens for a picture that must be made, even if none are left.
  void borrow(const node::View& view, std::int64_t texels);

 private:
  struct Made {
    node::FrameNumber frame = 0;
    int pictures = 0;
  };
  struct Bucket {
    double tokens = 0.0;
    double time = 0.0;  ///< of the world clock, up to which it was filled
    std::array<Made, node::kMaxFramesInFlight> made{};
  };
  [[nodiscard]] double share(const node::View& view) const;
  [[nodiscard]] Bucket& filled(const node::View& view);
  /// Requests of different frames in flight may alternate.
  [[nodiscard]] static int& madeIn(Bucket& bucket, node::FrameNumber frame);
  void spend(Bucket& bucket, std::int64_t texels);

  const double texelsPerSecond_;
  const ErrorFactor errorFactor_;
  const Clock clock_;
  std::mutex mutex_;
  std::map<node::SessionId, Bucket> buckets_;
  double sharedTokens_ = 0.0;
};

}  // namespace grove::objects::lightfield

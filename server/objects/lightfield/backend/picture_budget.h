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

/// Keeps visitors from asking for more new pictures than the machine has time for. Pictures age with the metres that a
/// visitor walks, so a machine that is late, and shows him farther on in every frame, would have more of them to make
/// for each, and be later still. So all visitors together have so many texels a second of the world's clock, and make
/// do with the pictures they have when those are spent.
///
/// A bucket of tokens for each visitor, which all fill alike, and a shared one for what overflows them. The bucket of
/// one who comes while others are here is empty, so that his first frame does not hold up theirs. A picture is made if
/// the visitor's bucket has any tokens or the shared one has enough; what it takes may leave his bucket in debt. So in
/// t seconds all take at most t + 2 kBurst seconds' worth, a picture each, and what they must borrow, whatever the
/// times of their views. Any thread.
class PictureBudget {
 public:
  static constexpr double kBurst = 0.25;     ///< seconds' worth that fit in a bucket: a frame of a late machine
  static constexpr int kMaxNewPictures = 2;  ///< in one frame, but for those whose error exceeds kUrgentError
  static constexpr float kUrgentError = 3.0F;

  /// By how much fewer the texels are at present, see node::errorFactor(). Any thread.
  using ErrorFactor = std::function<float()>;

  /// What the world's clock shows at present, as far as is known here: a view's time is what somebody else says. Any
  /// thread.
  using Clock = std::function<std::optional<double>()>;

  PictureBudget(double texelsPerSecond, ErrorFactor errorFactor, Clock clock)
      : texelsPerSecond_(texelsPerSecond), errorFactor_(std::move(errorFactor)), clock_(std::move(clock)) {}

  /// Whether to make a picture of so many texels in this frame; takes them. `error` is that of what is there instead,
  /// in times of what is permitted; infinite if there is nothing. The larger it is, the emptier the bucket may be.
  [[nodiscard]] bool take(const node::View& view, std::int64_t texels, float error);

  /// Takes them though there may be none left: of a picture that must be made.
  void borrow(const node::View& view, std::int64_t texels);

 private:
  struct Made {
    node::FrameNumber frame = 0;
    int pictures = 0;
  };
  struct Bucket {
    double tokens = 0.0;
    double time = 0.0;  ///< of the world's clock, up to which it was filled
    std::array<Made, node::kMaxFramesInFlight> made{};
  };
  [[nodiscard]] double share(const node::View& view) const;
  [[nodiscard]] Bucket& filled(const node::View& view);
  /// Of frames in flight the requests come in turns.
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

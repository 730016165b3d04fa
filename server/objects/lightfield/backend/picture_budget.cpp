#include "objects/lightfield/backend/picture_budget.h"

#include <algorithm>

namespace grove::objects::lightfield {
namespace {

/// Share of a full bucket that is reserved for pictures whose error is far too large.
constexpr double kReserve = 0.5;

/// Seconds after which a bucket counts as unused.
constexpr double kForgotten = 60.0;

}  // namespace

double PictureBudget::share(const node::View& view) const {
  return texelsPerSecond_ / static_cast<double>(std::max<std::size_t>(view.visitors, 1));
}

PictureBudget::Bucket& PictureBudget::filled(const node::View& view) {
  const double max = kBurst * share(view);
  const double now = clock_().value_or(view.time);
  const auto found = buckets_.find(view.session);
  if (found == buckets_.end()) {
    std::erase_if(buckets_, [&](const auto& bucket) { return bucket.second.time + kForgotten < now; });
    const double tokens = buckets_.empty() ? max : 0.0;
    return buckets_.emplace(view.session, Bucket{tokens, now}).first->second;
  }
  Bucket& bucket = found->second;
  // Frames may overtake each other.
  const double passed = std::max(std::min(view.time, now) - bucket.time, 0.0);
  bucket.time += passed;
  const double tokens = bucket.tokens + passed * share(view) / static_cast<double>(errorFactor_());
  bucket.tokens = std::min(max, tokens);
  sharedTokens_ = std::min(kBurst * texelsPerSecond_, sharedTokens_ + tokens - bucket.tokens);
  return bucket;
}

int& PictureBudget::madeIn(Bucket& bucket, node::FrameNumber frame) {
  Made& made = bucket.made[frame % bucket.made.size()];
  if (made.frame != frame) made = {frame, 0};
  return made.pictures;
}

void PictureBudget::spend(Bucket& bucket, std::int64_t texels) {
  const auto all = static_cast<double>(texels);
  const double own = std::clamp(bucket.tokens, 0.0, all);
  const double common = std::min(sharedTokens_, all - own);
  sharedTokens_ -= common;
  bucket.tokens -= all - common;
}

bool PictureBudget::take(const node::View& view, std::int64_t texels, float error) {
  const std::lock_guard lock(mutex_);
  Bucket& bucket = filled(view);
  int& made = madeIn(bucket, view.frame);
  if (error <= kUrgentError && made >= kMaxNewPictures) return false;
  const double left = kReserve * kBurst / std::max(error, 1.0F);
  const bool sharedTokensPay = sharedTokens_ > left * texelsPerSecond_ + static_cast<double>(texels);
  if (bucket.tokens <= left * share(view) && !sharedTokensPay) return false;
  spend(bucket, texels);
  ++made;
  return true;
}

void PictureBudget::borrow(const node::View& view, std::int64_t texels) {
  const std::lock_guard lock(mutex_);
  spend(filled(view), texels);
}

}  // namespace grove::objects::lightfield

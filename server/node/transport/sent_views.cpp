#include "node/transport/sent_views.h"

#include <utility>

namespace grove::node {
namespace {

/// Seconds that requests may be on their way, or wait for their frame's turn.
constexpr double kInFlight = 1.0;

/// Includes the session's entry.
constexpr std::size_t kOverhead = 256;

std::size_t bytesOf(const View& view) {
  return sizeof(View) + kOverhead + view.lights.capacity() * sizeof(world::PointLight);
}

/// Returns the same view, counted in `sum` until its last holder releases it.
std::shared_ptr<const View> counted(std::shared_ptr<const View> view, std::size_t bytes,
                                    std::shared_ptr<std::atomic<std::size_t>> sum) {
  const View* const seen = view.get();
  *sum += bytes;
  return {seen, [held = std::move(view), sum = std::move(sum), bytes](const View*) { *sum -= bytes; }};
}

}  // namespace

void SentViews::add(std::shared_ptr<const View> view) {
  const std::size_t bytes = bytesOf(*view);
  const SessionId session = view->session;
  if (sessions_.use(session) == nullptr) sessions_.put(session, {});
  while (*bytes_ + bytes > kMaxBytes && !sessions_.empty()) forgetOldest();
  if (*bytes_ + bytes > kMaxBytes) return;
  if (sessions_.find(session) == nullptr) sessions_.put(session, {});
  auto& views = *sessions_.find(session);
  const auto isOld = [&](const std::shared_ptr<const View>& each) {
    return each->time < view->time - kMaxBackdropAge - kInFlight;
  };
  while (!views.empty() && (views.size() == kMostKept || isOld(views.front()))) views.erase(views.begin());
  views.push_back(counted(std::move(view), bytes, bytes_));
}

void SentViews::forgetOldest() {
  auto& views = *sessions_.find(sessions_.entries().back().key);
  if (!views.empty()) views.erase(views.begin());
  if (views.empty()) sessions_.takeOldest();
}

std::shared_ptr<const View> SentViews::find(SessionId session, FrameNumber frame) {
  const auto* const views = sessions_.find(session);
  if (views == nullptr) return nullptr;
  for (const auto& view : *views) {
    if (view->frame == frame) return view;
  }
  return nullptr;
}

}  // namespace grove::node

#include "node/transport/sent_views.h"

#include <utility>

namespace grove::node {

void SentViews::add(std::shared_ptr<const View> view) {
  std::vector<std::shared_ptr<const View>>* views = sessions_.use(view->session);
  if (views == nullptr) {
    if (sessions_.size() == kMaxSessions) sessions_.takeOldest();
    const SessionId session = view->session;
    sessions_.put(session, {});
    views = sessions_.use(session);
  }
  if (views->size() == kKept) views->erase(views->begin());
  views->push_back(std::move(view));
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

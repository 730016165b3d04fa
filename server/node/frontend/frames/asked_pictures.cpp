#include "node/frontend/frames/asked_pictures.h"

namespace grove::node {

void AskedPictures::begin(SessionId session) {
  const std::lock_guard lock(mutex_);
  sessions_[session].clear();
}

void AskedPictures::end(SessionId session) {
  const std::lock_guard lock(mutex_);
  sessions_.erase(session);
}

void AskedPictures::add(const Request& request) {
  const std::lock_guard lock(mutex_);
  const auto session = sessions_.find(request.view->session);
  if (session == sessions_.end()) return;
  std::map<FrameNumber, Slots>& frames = session->second;
  frames[request.view->frame].insert_or_assign(request.slot, request.rect);
  if (frames.size() > kFrames) frames.erase(frames.begin());
}

std::optional<world::Rect> AskedPictures::take(const Result& answer) {
  const std::lock_guard lock(mutex_);
  const auto session = sessions_.find(answer.session);
  if (session == sessions_.end()) return std::nullopt;
  const auto frame = session->second.find(answer.frame);
  if (frame == session->second.end()) return std::nullopt;
  const auto slot = frame->second.extract(answer.slot);
  if (frame->second.empty()) session->second.erase(frame);
  return slot.empty() ? std::nullopt : std::optional(slot.mapped());
}

}  // namespace grove::node

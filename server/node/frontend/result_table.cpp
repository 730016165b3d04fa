#include "node/frontend/result_table.h"

#include <utility>

namespace grove::node {

bool ResultTable::open(std::shared_ptr<const FrameList> list) {
  const FrameNumber number = list->view->frame;
  if (rows_.size() >= maxFrames_ || rows_.contains(number)) return false;
  const std::size_t requests = list->objects.size();
  CompleteFrame frame{std::move(list), std::vector<Payload>(requests), std::vector<bool>(requests)};
  rows_.emplace(number, Row{std::move(frame), requests});
  return true;
}

bool ResultTable::put(FrameNumber frame, std::uint32_t slot, Payload& payload) {
  const auto it = rows_.find(frame);
  if (it == rows_.end()) return false;
  Row& row = it->second;
  if (slot >= row.frame.fulfilled.size() || row.frame.fulfilled[slot]) return false;
  row.frame.fulfilled[slot] = true;
  row.frame.payloads[slot] = std::move(payload);
  --row.missing;
  return true;
}

std::optional<CompleteFrame> ResultTable::take(FrameNumber frame) {
  const auto it = rows_.find(frame);
  if (it == rows_.end() || it->second.missing > 0) return std::nullopt;
  CompleteFrame complete = std::move(it->second.frame);
  rows_.erase(it);
  return complete;
}

std::optional<CompleteFrame> ResultTable::takeOverdue(double now) {
  const auto oldest = rows_.begin();
  if (oldest == rows_.end() || now < oldest->second.frame.list->view->deadline) return std::nullopt;
  CompleteFrame frame = std::move(oldest->second.frame);
  rows_.erase(oldest);
  return frame;
}

}  // namespace grove::node

#include "node/frontend/result_table.h"

#include <utility>

namespace grove::node {

bool ResultTable::open(std::shared_ptr<const FrameList> list) {
  const FrameNumber number = list->view->frame;
  if (rows_.size() >= mostFrames_ || rows_.contains(number)) return false;
  const std::size_t requests = list->objects.size();
  rows_.emplace(number, Row{{std::move(list), std::vector<Payload>(requests)}, std::vector<bool>(requests), requests});
  return true;
}

bool ResultTable::put(Result result) {
  const auto it = rows_.find(result.frame);
  if (it == rows_.end()) return false;
  Row& row = it->second;
  if (result.slot >= row.fulfilled.size() || row.fulfilled[result.slot]) return false;
  row.fulfilled[result.slot] = true;
  row.frame.payloads[result.slot] = std::move(result.payload);
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

}  // namespace grove::node

#pragma once

#include <memory>

#include "node/messages/node_report.h"
#include "node/messages/wire/decode_parts.h"

/// A node's reports as parts of messages, see wire.h.
namespace grove::node {

namespace v1 {
class NodeReport;
class NodeTrace;
class ToFrontend;
}  // namespace v1

void put(const NodeReport& from, v1::ToFrontend& envelope);
void put(const std::shared_ptr<const NodeTrace>& from, v1::ToFrontend& envelope);

[[nodiscard]] NodeReport decode(const v1::NodeReport& from, Checks& checks);
[[nodiscard]] std::shared_ptr<const NodeTrace> decode(const v1::NodeTrace& from, Checks& checks);

}  // namespace grove::node

#pragma once

#include <memory>
#include <variant>

#include "node/messages/hello.h"
#include "node/messages/node_report.h"
#include "node/messages/request.h"
#include "node/messages/result.h"
#include "node/messages/world_update.h"

namespace grove::node {

/// Messages of a frontend process. Its hello goes first, and a view before the requests that name it.
using ToBackend = std::variant<NodeHello, std::shared_ptr<const WorldUpdate>, std::shared_ptr<const View>, Request,
                               Cancel, Quality, Forget, Acknowledgement, Unsubscribe, TraceRequest>;

/// Messages of a backend node, or of a world's owner, which welcomes or refuses and then sends updates only.
using ToFrontend = std::variant<NodeWelcome, NodeRefusal, Result, Announcement, std::shared_ptr<const WorldUpdate>,
                                NodeReport, std::shared_ptr<const NodeTrace>>;

}  // namespace grove::node

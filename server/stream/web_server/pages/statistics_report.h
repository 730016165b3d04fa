#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <vector>

#include "measure/amortization_meter.h"
#include "node/transport/node_router.h"
#include "node/world/joined_world.h"
#include "pipeline/memory_ledger.h"
#include "pipeline/timeline.h"

namespace grove::stream {

/// What `/statistics.json` and `/sharing.json` report.
struct StatisticsSources {
  const pipeline::Timeline& timeline;
  const pipeline::MemoryLedger& memory;
  const measure::AmortizationMeter& meter;
  std::size_t visitors = 0;         ///< of this server
  std::size_t visitorsOfWorld = 0;  ///< of all servers that show its world
  /// How it stands with the world's owner; nothing if it is the owner.
  std::optional<node::JoinedWorld::Status> joined = {};
  std::vector<node::NodeRouter::NodeLink> nodes = {};  ///< empty if this process serves all objects
  int quality = 0;                                     ///< see Host::quality()
  bool raisesQuality = false;
  double pictureScale = 1.0;  ///< see Governor::scale()
};

/// What `/statistics.json` answers. The server's version. The world: `state` ("own", or how the server stands with its
/// owner: "connecting", "joined", "refused", "lost"), visitors of all servers that show it, and the pace of the link to
/// the owner. The nodes that serve its objects, if there are several: state of the link ("here", "connecting",
/// "welcomed", "refused", "untrusted", "silent", "lost"), objects, epoch (null before a welcome), MB that have come,
/// the pace of the link, and the node's own stages and memory, as of this process below, at most a second old (null of
/// a node within this process, or one that is away). A pace is of the last five seconds, null without a link to another
/// process: bytes a second each way, and the shortest round trip. Since the start: for each stage its work
/// (across-user, per-user-backend or per-user-frontend), runs, failures and milliseconds of CPU and wall time, and the
/// named counters. Of now: `picture_scale`, the share of the wanted width and height that a busy machine gives each
/// visitor; the bytes that are held and by what. Of the last seconds: `amortization`, what sharing saves (null if
/// nobody was served).
[[nodiscard]] std::string statisticsJson(const StatisticsSources& sources);

/// What `/sharing.json` answers: of that only what sharing saves, for the overlay of every visitor.
[[nodiscard]] std::string sharingJson(const StatisticsSources& sources);

}  // namespace grove::stream

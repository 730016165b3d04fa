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
#include "stream/adapt/governor.h"

namespace grove::stream {

/// What `/statistics.json` and `/sharing.json` report.
struct StatisticsSources {
  const pipeline::Timeline& timeline;
  const pipeline::MemoryLedger& memory;
  const measure::AmortizationMeter& meter;
  std::size_t visitors = 0;         ///< in this server
  std::size_t visitorsOfWorld = 0;  ///< in all servers that show its world
  /// Link to the world's owner; nothing if this server is the owner.
  std::optional<node::JoinedWorld::Status> joined = {};
  std::vector<node::NodeRouter::NodeLink> nodes = {};  ///< empty if this process serves all objects
  int quality = 0;                                     ///< see Host::quality()
  bool raisesQuality = false;
  Governor::Share governed = {};  ///< what the busy machine gives
};

/// Contents of `/statistics.json`. Current: the server's `version`; the `world`: `state` ("own", or of the link to its
/// owner: "connecting", "joined", "refused", "lost"), visitors of all servers that show it, and the pace of the link to
/// the owner; the `nodes` that serve its objects, if there are several: state of the link ("here", "connecting",
/// "welcomed", "refused", "untrusted", "silent", "lost"), objects, epoch (null before a welcome), MB received, the pace
/// of the link, and the node's own stages and memory, at most a second old (null for a node within this process or with
/// a lost link). A pace covers the last five seconds and is null without a link to another process: bytes per second
/// each way, and the minimum round trip. `picture_scale`: the share of the wanted width and height that a busy machine
/// gives each visitor; `moved_pictures_per_second`: the most that it gives pages with late walk (null: no limit);
/// `memory`: the bytes held, by holder. Since the start: each stage's work (across-user,
/// on-demand, per-user-backend or per-user-frontend), runs, failures and milliseconds of CPU and wall time, and the
/// named counters. Over the last seconds: `amortization`, what sharing saves (null without visitors).
[[nodiscard]] std::string statisticsJson(const StatisticsSources& sources);

/// Contents of `/sharing.json`: only what sharing saves, for every visitor's overlay.
[[nodiscard]] std::string sharingJson(const StatisticsSources& sources);

}  // namespace grove::stream

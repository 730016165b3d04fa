#pragma once

#include <cstdint>
#include <map>
#include <string>
#include <vector>

#include "cli/bench/amortize/course.h"
#include "measure/amortization.h"
#include "measure/memory_use.h"
#include "node/transport/transport.h"
#include "stream/protocol/protocol.h"

namespace grove::cli {

/// Frames a second that each visitor is meant to get, and what counts as getting them.
inline constexpr double kNominalFps = 30.0;
inline constexpr double kServedFps = 0.95 * kNominalFps;

/// One measurement of `grove bench amortize`: some visitors walk about in one scene.
struct AmortizeRow {
  int users = 0;
  bool privateWorlds = false;  ///< the control: a process for each visitor
  Course course = Course::kTogether;
  std::uint8_t codec = stream::kCodecJpeg;             ///< of the frames that the visitors received
  double seconds = 0.0;                                ///< that were measured
  double frames = 0.0;                                 ///< of all visitors together
  double fpsMin = 0.0;                                 ///< of the visitor who got the fewest
  std::vector<float> latencies;                        ///< ms, from sending an input to the first frame that shows it
  std::map<std::string, measure::FrameCost> costs;     ///< by type of object
  std::map<std::string, measure::MemoryShare> memory;  ///< by type of object
  pipeline::Reuse reuse;                               ///< of shared data that views caused
  double tick = 0.0;                                   ///< ms of CPU of a fluid's step, mean
  double reportedBytes = 0.0;                          ///< all that the ledger knows
  measure::MemoryUse process;
  node::LinkTraffic traffic;
  double cpuCores = 0.0;     ///< of the whole process, or of all processes
  double stageCores = 0.0;   ///< of that, what stages account for
  double driverCores = 0.0;  ///< of the rest, what the GL driver's own threads have used

  [[nodiscard]] double fps() const { return frames / seconds / users; }
  [[nodiscard]] double latency(double share) const;
  /// Whether the machine is too slow. The period may cut off one frame of each visitor.
  [[nodiscard]] bool saturated() const { return (frames + users) / seconds / users < kServedFps; }
  [[nodiscard]] int copies() const { return privateWorlds ? users : 1; }
  /// What neither stages nor the driver's threads account for: clocks, queues, sockets, the bench itself.
  [[nodiscard]] double otherCores() const { return cpuCores - stageCores - driverCores; }
  [[nodiscard]] measure::FrameCost cost() const { return measure::sum(costs); }
  /// Cores that give every visitor the nominal frame rate: those that were used, or where the machine was too slow, an
  /// estimate, by which all but the work that depends on no view grows with the frames.
  [[nodiscard]] double coresNeeded() const;
};

/// Returns the row of private mode, from one row for each visitor's process, at least one. Costs are means over all
/// frames.
[[nodiscard]] AmortizeRow together(const std::vector<AmortizeRow>& visitors);

/// A row as text, to pass it from one process to another of the same program.
[[nodiscard]] std::string pack(const AmortizeRow& row);
[[nodiscard]] AmortizeRow unpackRow(const std::string& text);

}  // namespace grove::cli

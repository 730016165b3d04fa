#pragma once

#include <map>
#include <optional>
#include <stop_token>
#include <string>

#include "cli/bench/picture_size.h"
#include "gl/shader_library.h"
#include "measure/amortization.h"
#include "measure/memory_use.h"
#include "node/transport/transport_kind.h"
#include "world/scenes/scene_file.h"

namespace grove::cli {

/// One measurement of `grove bench amortize`: some visitors walk about in one scene.
struct AmortizeRun {
  int users = 1;
  bool privateWorlds = false;  ///< the control: a world for each
  double seconds = 5.0;        ///< measured, after a warm-up
  int frames = 0;              ///< instead of seconds, unless 0: until every visitor has this number
  PictureSize size{1280, 720};
  node::TransportKind transport = node::TransportKind::kReference;
};

/// Frames a second that each visitor is meant to get, and what counts as getting them.
inline constexpr double kNominalFps = 30.0;
inline constexpr double kServedFps = 0.95 * kNominalFps;

/// What a run has measured.
struct AmortizeRow {
  int users = 0;
  bool privateWorlds = false;
  double seconds = 0.0;     ///< that were measured
  double frames = 0.0;      ///< of all visitors together
  double fpsMin = 0.0;      ///< of the visitor who got the fewest
  double latencyP50 = 0.0;  ///< ms, from sending an input to the first frame that shows it
  double latencyP99 = 0.0;
  std::map<std::string, measure::FrameCost> costs;     ///< by type of object
  std::map<std::string, measure::MemoryShare> memory;  ///< by type of object
  double reportedBytes = 0.0;                          ///< all that the ledger knows
  measure::MemoryUse process;
  node::LinkTraffic traffic;  ///< in shared mode
  double cpuCores = 0.0;      ///< of the whole process
  double stageCores = 0.0;    ///< of that, what stages account for
  double driverCores = 0.0;   ///< of the rest, what the GL driver's own threads have used

  [[nodiscard]] double fps() const { return frames / seconds / users; }
  /// Whether the machine is too slow. The period may cut off one frame of each visitor.
  [[nodiscard]] bool saturated() const { return (frames + users) / seconds / users < kServedFps; }
  [[nodiscard]] int copies() const { return privateWorlds ? users : 1; }
  /// What neither stages nor the driver's threads account for: clocks, queues, sockets, the bench itself.
  [[nodiscard]] double otherCores() const { return cpuCores - stageCores - driverCores; }
  [[nodiscard]] measure::FrameCost cost() const { return measure::sum(costs); }
  /// Cores that are needed to give every visitor the nominal frame rate. `cpuCores` cannot show it where there are
  /// fewer.
  [[nodiscard]] double coresNeeded() const;
};

/// Serves the scene to visitors within the process and measures; reports on stderr how far it is. Nothing if it was
/// stopped before the end. Throws EnvironmentError.
[[nodiscard]] std::optional<AmortizeRow> runAmortize(const world::Scene& scene, const gl::ShaderLibrary& shaders,
                                                     const AmortizeRun& run, const std::stop_token& stop);

}  // namespace grove::cli

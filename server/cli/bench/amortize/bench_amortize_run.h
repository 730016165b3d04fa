#pragma once

#include <cstdint>
#include <functional>
#include <optional>
#include <stop_token>

#include "cli/bench/amortize/amortize_row.h"
#include "cli/bench/picture_size.h"
#include "node/transport/transport_kind.h"
#include "world/scenes/scene_file.h"

namespace grove::cli {

/// How to measure a row of `grove bench amortize`.
struct AmortizeRun {
  int users = 1;
  int firstVisitor = 0;        ///< number of the first of them, who chooses the way to walk
  bool privateWorlds = false;  ///< the control: a process for each
  Course course = Course::kTogether;
  std::uint8_t codec = stream::kCodecJpeg;
  double seconds = 5.0;  ///< measured, after a warm-up
  int frames = 0;        ///< instead of seconds, unless 0: until every visitor has this number
  PictureSize size{1280, 720};
  node::TransportKind transport = node::TransportKind::kReference;
};

/// Serves the scene to all visitors of the run in this process, and measures. Calls `arrive` when everybody has seen a
/// frame; it waits for other processes of the row, and returns false to end the run. Returns nothing if it has ended
/// early. Throws EnvironmentError or world::SceneError.
[[nodiscard]] std::optional<AmortizeRow> runAmortize(const world::Scene& scene, const AmortizeRun& run,
                                                     const std::function<bool()>& arrive, const std::stop_token& stop);

}  // namespace grove::cli

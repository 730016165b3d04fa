#pragma once

#include <cstddef>
#include <cstdint>
#include <memory>
#include <span>
#include <string>

#include "node/messages/obstacle_messages.h"
#include "pipeline/executor.h"
#include "pipeline/stage.h"
#include "pipeline/timeline.h"
#include "world/voxel_obstacles.h"

namespace grove::node {

/// A node that waits for obstacles. Any thread.
class ObstacleAsker {
 public:
  virtual ~ObstacleAsker() = default;
  [[nodiscard]] virtual bool isWaiting() const = 0;
  /// Passes on the encoded cells, or the reason for having none. Called once.
  virtual void answer(const Decoded<std::string>& cells) = 0;
};

/// An encoded ObstacleRequest.
struct ObstacleQuestion {
  std::string request;
  std::shared_ptr<ObstacleAsker> asker;
};

/// Computes obstacles for other nodes: up to tenths of a second of a worker per request. One request at a time, so that
/// they occupy at most one core. Refuses requests beyond kMaxWaiting.
class ObstacleAnswers final : public pipeline::Stage<ObstacleQuestion> {
 public:
  static constexpr std::size_t kMaxWaiting = 16;

  /// The obstacles of the scene with this hash. They, workers and timeline outlive it.
  ObstacleAnswers(const world::VoxelObstacles& obstacles, std::uint64_t sceneHash, pipeline::Executor& executor,
                  pipeline::Timeline& timeline);

 protected:
  void process(std::span<ObstacleQuestion> questions, pipeline::Run& run) override;
  void recover(ObstacleQuestion& question, const std::string& reason, pipeline::Run& run) override;

 private:
  [[nodiscard]] Decoded<std::string> answerTo(const std::string& bytes) const;

  const world::VoxelObstacles& obstacles_;
  const std::uint64_t sceneHash_;
};

}  // namespace grove::node

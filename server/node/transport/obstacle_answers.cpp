#include "node/transport/obstacle_answers.h"

#include <variant>

namespace grove::node {

ObstacleAnswers::ObstacleAnswers(const world::VoxelObstacles& obstacles, std::uint64_t sceneHash,
                                 pipeline::Executor& executor, pipeline::Timeline& timeline)
    : Stage({.name = "Obstacle Answers", .work = pipeline::Work::kAcrossUser, .capacity = kMaxWaiting}, executor,
            timeline),
      obstacles_(obstacles),
      sceneHash_(sceneHash) {}

void ObstacleAnswers::process(std::span<ObstacleQuestion> questions, pipeline::Run& /*run*/) {
  for (const ObstacleQuestion& question : questions) {
    if (question.asker->isWaiting()) question.asker->answer(answerTo(question.request));
  }
}

void ObstacleAnswers::recover(ObstacleQuestion& question, const std::string& reason, pipeline::Run& /*run*/) {
  question.asker->answer(WireError{reason});
}

Decoded<std::string> ObstacleAnswers::answerTo(const std::string& bytes) const {
  const Decoded<ObstacleRequest> decoded = decodeObstacleRequest(bytes);
  if (const auto* error = std::get_if<WireError>(&decoded)) return *error;
  const auto& request = std::get<ObstacleRequest>(decoded);
  if (request.protocol != kProtocol) {
    return WireError{"the protocols differ: the request has " + std::to_string(request.protocol) + ", the node " +
                     std::to_string(kProtocol)};
  }
  if (request.sceneHash != sceneHash_) return WireError{"the scenes differ"};
  return encodeCells(request.towardsSun ? obstacles_.sunlitCells(request.cube, *request.towardsSun)
                                        : obstacles_.solidCells(request.cube));
}

}  // namespace grove::node

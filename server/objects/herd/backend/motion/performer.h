#pragma once

#include <array>
#include <functional>
#include <optional>

#include "objects/herd/backend/motion/motion_graph.h"
#include "objects/herd/common/animal_pose.h"

namespace grove::objects::herd {

/// Height of the ground at a place (x and z), metres.
using Ground = std::function<float(world::Vec2)>;

/// Plays a way through a motion graph on uneven ground, one frame per tick: blends clips, and keeps feet where they
/// have come down, which blended clips do not (Kovar, Schreiner and Gleicher, "Footskate Cleanup for Motion Capture
/// Editing", 2002).
class Performer {
 public:
  /// Begins at a frame of the graph that leads on. `graph` outlives the performer; `size` scales all distances.
  Performer(const MotionGraph& graph, MotionDatabase::Frame frame, const RootMove& root, float size,
            const Ground& ground);

  /// Whether the next transition may be chosen, or chosen anew: no blend is under way.
  [[nodiscard]] bool isFree() const noexcept { return blend_ == 0; }
  /// Whether it has to be chosen.
  [[nodiscard]] bool needsNext() const noexcept { return !next_; }
  /// `next` begins in the clip under way, at its current frame or later.
  void choose(const Transition& next);

  /// Advances by one frame, and moves by `push` metres of the world besides.
  void step(const Ground& ground, world::Vec2 push = world::Vec2(0.0F));

  [[nodiscard]] MotionDatabase::Frame frame() const noexcept { return frame_; }
  /// In the world; lengths divided by the animal's size, as the graph measures them.
  [[nodiscard]] const RootMove& root() const noexcept { return root_; }
  [[nodiscard]] Activity activity() const { return graph_->database()[frame_].activity; }
  [[nodiscard]] const AnimalPose& pose() const noexcept { return pose_; }
  /// Bit i: foot i stands.
  [[nodiscard]] std::uint8_t contacts() const noexcept { return contacts_; }

 private:
  struct Foot {
    bool stands = false;
    world::Vec2 place{0.0F};   ///< while it stands
    world::Vec2 offset{0.0F};  ///< from where the clip has it; fades while it swings
    float lift = 0.0F;         ///< of a step that corrects its place
  };
  [[nodiscard]] MotionFrame current() const;
  void pose(const MotionFrame& frame, const Ground& ground);
  /// Lowers the trunk until the standing feet are in reach; it rises again slowly.
  void lowerTrunk();
  [[nodiscard]] world::Vec3 placeFoot(std::size_t leg, const MotionFrame& frame, const Ground& ground);

  const MotionGraph* graph_;
  float size_;
  MotionDatabase::Frame frame_;
  std::optional<Transition> next_;
  MotionDatabase::Frame blend_ = 0;  ///< frames of the transition that are done; 0: it has not begun
  RootMove root_;
  std::array<Foot, kLegs> feet_;
  float drop_ = 0.0F;  ///< of the trunk, metres of an animal of size 1
  AnimalPose pose_;
  std::uint8_t contacts_ = 0;
};

}  // namespace grove::objects::herd

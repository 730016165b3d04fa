#include "objects/herd/backend/mind/herd_simulation.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>

#include "objects/herd/common/deer_skeleton.h"
#include "pipeline/vector_bytes.h"

namespace grove::objects::herd {
namespace {

using world::Player;
using world::Vec2;

constexpr float kTick = 1.0F / static_cast<float>(kTicksPerSecond);
constexpr float kContagion = 8.0F;  ///< metres within which an animal flees with another
constexpr int kReplan = 12;         ///< ticks after which a way is planned anew
constexpr float kSight = 13.0F;     ///< metres within which obstacles matter to a way
constexpr float kBody = 0.55F;      ///< metres from an obstacle's edge that an animal of size 1 needs
constexpr float kApart = 2.0F;      ///< metres between animals
constexpr float kVisitorApart = 3.5F;
constexpr float kPassing = 0.4F;  ///< metres more by which an animal goes past an obstacle
constexpr int kFirstPlaces = 12;  ///< that are compared
constexpr float kElbowRoom = 0.9F;
/// Metres per tick by which an animal is pushed out of an obstacle or another animal.
constexpr float kPush = 0.02F;

Vec2 placeOf(const Player& visitor) { return {visitor.pose.position.x, visitor.pose.position.z}; }

std::pair<Kind, float> looksOf(std::size_t animal, Dice& dice) {
  if (animal % 6 == 0) return {Kind::kBuck, dice.between(1.06F, kLargest)};
  if (animal % 6 == 4) return {Kind::kFawn, dice.between(0.6F, 0.7F)};
  return {Kind::kDoe, dice.between(0.93F, 1.0F)};
}

/// Where to go first if an obstacle is in the way to a place: past its nearer side.
Vec2 wayAround(Vec2 from, Vec2 to, std::span<const world::Obstacle> obstacles, float body) {
  const float distance = glm::distance(from, to);
  if (distance < 0.1F) return to;
  const Vec2 ahead = (to - from) / distance;
  const Vec2 left(ahead.y, -ahead.x);
  float nearest = distance;
  Vec2 way = to;
  for (const world::Obstacle& one : obstacles) {
    const float along = glm::dot(one.centre - from, ahead);
    const float aside = glm::dot(one.centre - from, left);
    const float clear = one.radius + body;
    if (along <= 0.0F || along >= nearest || std::abs(aside) >= clear) continue;
    nearest = along;
    way = one.centre - (aside > 0.0F ? clear + kPassing : -clear - kPassing) * left;
  }
  return way;
}

/// Cost of being within a circle, and of being close to it.
float costOf(Vec2 place, Vec2 centre, float radius, float margin) {
  const float depth = radius + margin - glm::distance(place, centre);
  return depth <= 0.0F ? 0.0F : 0.4F + 2.5F * depth;
}

}  // namespace

struct HerdSimulation::Actor {
  AnimalMind mind;
  Performer performer;
  float size = 1.0F;
  MotionGoal goal;
  int planned = 0;  ///< ticks since its way was planned
};

HerdSimulation::HerdSimulation(const MotionGraph& graph, Terrain terrain, std::size_t animals, std::uint32_t seed)
    : terrain_(std::move(terrain)), search_(graph), dice_(seed), meadow_(terrain_.home()) {
  findMeadow();
  const Ground ground = [this](Vec2 place) { return terrain_.height(place); };
  for (std::size_t i = 0; i < animals; ++i) {
    const auto [kind, size] = looksOf(i, dice_);
    const RootMove root{firstPlace(), dice_.between(-3.1F, 3.1F)};
    const MotionDatabase::Frame frame =
        graph.someFrame(i % 3 == 1 ? Activity::kStand : Activity::kGraze, dice_.index(64));
    actors_.push_back({AnimalMind(terrain_, world::hash(seed) + static_cast<std::uint32_t>(i)),
                       Performer(graph, frame, root, size, ground),
                       size,
                       {},
                       kReplan});
    const AnimalPose pose = actors_.back().performer.pose();
    animals_.push_back({kind, size, 1.0F, pose, pose});
  }
}

HerdSimulation::~HerdSimulation() = default;

Vec2 HerdSimulation::firstPlace() {
  Vec2 place = meadow_;
  float most = -1.0F;
  for (int i = 0; i < kFirstPlaces; ++i) {
    const Vec2 one = terrain_.freePlace(meadow_, 5.0F, 0.9F, dice_).value_or(meadow_);
    float nearest = kApart;
    for (const Animal& other : animals_) {
      nearest = std::min(nearest, glm::distance(one, {other.now.place.x, other.now.place.z}));
    }
    if (nearest <= most) continue;
    most = nearest;
    place = one;
  }
  return place;
}

const AnimalMind& HerdSimulation::mind(std::size_t animal) const { return actors_[animal].mind; }

const Performer& HerdSimulation::performer(std::size_t animal) const { return actors_[animal].performer; }

std::size_t HerdSimulation::bytes() const noexcept {
  return search_.bytes() + pipeline::vectorBytes(actors_, animals_);
}

void HerdSimulation::findMeadow() {
  meadow_ = terrain_.freePlace(terrain_.home(), 0.8F * terrain_.range(), 2.0F, dice_).value_or(terrain_.home());
  meadowTicks_ = static_cast<int>(dice_.between(50.0F, 110.0F) * static_cast<float>(kTicksPerSecond));
}

Surroundings HerdSimulation::around(const Actor& actor, std::span<const Player> visitors) const {
  Surroundings around;
  around.place = actor.size * actor.performer.root().place;
  around.meadow = meadow_;
  for (const Player& visitor : visitors) {
    const Vec2 place = placeOf(visitor);
    const float distance = glm::distance(place, around.place);
    if (around.threat && around.threat->distance <= distance) continue;
    around.threat = Threat{place, distance, std::hypot(visitor.velocity.x, visitor.velocity.z)};
  }
  around.neighbourFlees = std::ranges::any_of(actors_, [&](const Actor& other) {
    return &other != &actor && other.mind.mood() == AnimalMind::Mood::kFleeing &&
           glm::distance(other.size * other.performer.root().place, around.place) < kContagion;
  });
  return around;
}

void HerdSimulation::plan(Actor& actor, const MotionGoal& goal, std::span<const Player> visitors) {
  const Vec2 here = actor.size * actor.performer.root().place;
  const std::vector<world::Obstacle> obstacles = terrain_.near(here, kSight);
  std::vector<Vec2> others;
  for (const Actor& other : actors_) {
    const Vec2 place = other.size * other.performer.root().place;
    if (&other != &actor && glm::distance(place, here) < 0.5F * kSight) others.push_back(place);
  }
  const Hindrance hindrance = [&](Vec2 scaled) {
    const Vec2 place = actor.size * scaled;
    float cost = std::max(0.0F, glm::distance(place, terrain_.home()) - terrain_.range());
    for (const auto& one : obstacles) cost += 4.0F * costOf(place, one.centre, one.radius, kBody * actor.size);
    for (const Vec2& other : others) cost += 5.0F * costOf(place, other, kApart, 0.0F);
    for (const Player& visitor : visitors) cost += 2.0F * costOf(place, placeOf(visitor), kVisitorApart, 0.0F);
    return cost;
  };
  MotionGoal scaled = goal;
  if (scaled.place) scaled.place = wayAround(here, *scaled.place, obstacles, kBody * actor.size) / actor.size;
  actor.performer.choose(search_.next(actor.performer.frame(), actor.performer.root(), scaled, hindrance));
  actor.planned = 0;
  actor.goal = goal;
}

Vec2 HerdSimulation::pushFrom(const Actor& actor) const {
  const Vec2 here = actor.size * actor.performer.root().place;
  const float body = 0.6F * kBody * actor.size;
  Vec2 push(0.0F);
  for (const world::Obstacle& one : terrain_.near(here, body)) {
    push += (here - one.centre) / std::max(glm::distance(here, one.centre), 0.1F) * kPush;
  }
  for (const Actor& other : actors_) {
    const Vec2 away = here - other.size * other.performer.root().place;
    const float distance = glm::length(away);
    if (&other == &actor || distance >= kElbowRoom) continue;
    push += away / std::max(distance, 0.1F) * kPush * (2.0F - distance / kElbowRoom);
  }
  return push;
}

void HerdSimulation::step(std::span<const Player> visitors) {
  ++ticks_;
  if (--meadowTicks_ <= 0) findMeadow();
  const Ground ground = [this](Vec2 place) { return terrain_.height(place); };
  for (std::size_t i = 0; i < actors_.size(); ++i) {
    Actor& actor = actors_[i];
    const MotionGoal& goal = actor.mind.decide(around(actor, visitors), kTick);
    ++actor.planned;
    const bool isNew = goal.activity != actor.goal.activity || goal.place != actor.goal.place;
    const bool isDue = actor.planned >= kReplan || isNew;
    if (actor.performer.needsNext() || (actor.performer.isFree() && isDue)) plan(actor, goal, visitors);
    actor.performer.step(ground, pushFrom(actor));
    animals_[i].before = animals_[i].now;
    animals_[i].now = actor.performer.pose();
  }
}

}  // namespace grove::objects::herd

#include "world/players.h"

#include <algorithm>
#include <cmath>
#include <set>

namespace grove::world {
namespace {

constexpr float kPlayerRadius = 0.35F;
constexpr float kStepSeconds = 1.0F / 60.0F;
constexpr double kMaxSecondsAtOnce = 1.0;

/// Metres before the world's end within which visitors are turned along it.
constexpr float kSoftEnd = 4.0F;
constexpr float kTurnedShare = 0.6F;  // of the speed that would lead out

// Warm and cold lantern colours that contrast with each other and with the grass; 0x00BBGGRR.
constexpr std::array<std::uint32_t, 8> kColours = {0x4FB4FF, 0xFFC46A, 0x7CE38B, 0xC98BFF,
                                                   0x6D6BFF, 0xF2F06B, 0xB0FFE2, 0xE8A0F5};

}  // namespace

Players::Players(Vec3 spawn, float spawnYaw, float radius, std::vector<Obstacle> obstacles, std::vector<Hill> hills,
                 PlayerId base)
    : spawn_(spawn),
      spawnYaw_(spawnYaw),
      radius_(radius),
      obstacles_(std::move(obstacles)),
      hills_(std::move(hills)),
      nextId_(base + 1) {}

PlayerId Players::join(const std::string& name, double now) {
  const std::lock_guard lock(mutex_);
  const PlayerId id = nextId_++;
  Entry entry;
  entry.time = now;
  Player& player = entry.player;
  player.id = id;
  player.name = name;
  player.colour = kColours[(id - 1) % kColours.size()];
  player.pose.yaw = spawnYaw_;
  player.pose.position = placeOfArrival(id, spawn_, spawnYaw_);
  standOnGround(player.pose.position);
  entries_.emplace(id, entry);
  ++changes_;
  return id;
}

void Players::leave(PlayerId id) {
  const std::lock_guard lock(mutex_);
  changes_ += entries_.erase(id);
}

bool Players::apply(PlayerId id, const Input& input, double now) {
  if (!std::isfinite(input.yaw) || !std::isfinite(input.pitch)) return false;
  const std::lock_guard lock(mutex_);
  const auto it = entries_.find(id);
  if (it == entries_.end()) return false;
  Player& player = it->second.player;
  if (input.number <= player.lastInput) return true;
  advance(it->second, now);
  player.lastInput = input.number;
  player.inputTime = now;
  player.keys = input.keys;
  player.pose.yaw = std::remainder(input.yaw, 6.2831853F);
  player.pose.pitch = std::clamp(input.pitch, -kMaxPitch, kMaxPitch);
  return true;
}

void Players::mirror(std::span<const Player> reported, const std::function<bool(PlayerId)>& isReported, double now) {
  std::set<PlayerId> here;
  for (const Player& player : reported) here.insert(player.id);
  const std::lock_guard lock(mutex_);
  changes_ += std::erase_if(entries_,
                            [&](const auto& entry) { return isReported(entry.first) && !here.contains(entry.first); });
  for (const Player& player : reported) {
    if (entries_.insert_or_assign(player.id, Entry{player, now}).second) ++changes_;
  }
}

std::optional<Player> Players::find(PlayerId id, double now) {
  const std::lock_guard lock(mutex_);
  const auto it = entries_.find(id);
  if (it == entries_.end()) return std::nullopt;
  advance(it->second, now);
  return it->second.player;
}

Vec3 Players::eyeAhead(Player player, double seconds) const {
  Entry entry{std::move(player), 0.0};
  advance(entry, seconds);
  return entry.player.pose.position;
}

std::vector<Player> Players::all(double now) {
  const std::lock_guard lock(mutex_);
  std::vector<Player> result;
  result.reserve(entries_.size());
  for (auto& [id, entry] : entries_) {
    advance(entry, now);
    result.push_back(entry.player);
  }
  return result;
}

std::size_t Players::count() const {
  const std::lock_guard lock(mutex_);
  return entries_.size();
}

void Players::advance(Entry& entry, double now) const {
  entry.time = std::max(entry.time, now - kMaxSecondsAtOnce);
  while (entry.time < now) {
    const float seconds = std::min(kStepSeconds, static_cast<float>(now - entry.time));
    step(entry.player, seconds);
    entry.time = now - entry.time <= kStepSeconds ? now : entry.time + seconds;
  }
}

Vec3 Players::turnedAlongTheEnd(Vec3 position, Vec3 velocity) const {
  const Vec2 place(position.x, position.z);
  const float distance = glm::length(place);
  const float soft = std::min(kSoftEnd, 0.5F * radius_);
  const float share = std::clamp((distance - radius_) / soft + 1.0F, 0.0F, 1.0F);
  if (share == 0.0F) return velocity;
  const Vec2 out = place / distance;
  const Vec2 along(-out.y, out.x);
  const Vec2 wanted(velocity.x, velocity.z);
  const float removed = share * std::max(0.0F, glm::dot(wanted, out));
  const float side = glm::dot(wanted, along) < 0.0F ? -1.0F : 1.0F;
  const Vec2 turned = wanted - out * removed + along * (side * kTurnedShare * removed);
  return {turned.x, velocity.y, turned.y};
}

void Players::step(Player& player, float seconds) const {
  const Vec3 wanted = turnedAlongTheEnd(player.pose.position, wantedVelocity(player.keys, player.pose.yaw));
  player.velocity += (wanted - player.velocity) * (1.0F - std::exp(-kAcceleration * seconds));
  if (glm::dot(player.velocity, player.velocity) < 1e-5F) player.velocity = Vec3(0.0F);

  const Vec3 before = player.pose.position;
  Vec2 place(before.x + player.velocity.x * seconds, before.z + player.velocity.z * seconds);
  for (const Obstacle& obstacle : obstacles_) {
    const Vec2 away = place - obstacle.centre;
    const float distance = glm::length(away);
    const float min = obstacle.radius + kPlayerRadius;
    if (distance < min) place = obstacle.centre + (distance > 1e-4F ? away / distance : Vec2(1, 0)) * min;
  }
  if (glm::length(place) > radius_) place = glm::normalize(place) * radius_;
  player.pose.position.x = place.x;
  player.pose.position.z = place.y;
  player.stride += glm::length(player.pose.position - before);
  standOnGround(player.pose.position);
}

void Players::standOnGround(Vec3& eye) const { eye.y = kEyeHeight + groundHeight(hills_, {eye.x, eye.z}); }

// Arriving visitors do not overlap.
Vec3 placeOfArrival(PlayerId id, Vec3 spawn, float spawnYaw) {
  const auto place = static_cast<float>((id - 1) % 8);
  const float side = (std::fmod(place, 2.0F) == 0.0F ? 1.0F : -1.0F) * std::ceil(place / 2.0F) * 1.1F;
  Pose pose;
  pose.yaw = spawnYaw;
  return spawn + Vec3(0, kEyeHeight, 0) + pose.right() * side;
}

Vec3 wantedVelocity(std::uint8_t keys, float yaw) {
  const auto held = [&](Key key) { return (keys & key) != 0 ? 1.0F : 0.0F; };
  Pose pose;
  pose.yaw = yaw;
  const Vec3 ahead(-std::sin(yaw), 0, -std::cos(yaw));
  const Vec3 wanted = ahead * (held(kForward) - held(kBack)) + pose.right() * (held(kRight) - held(kLeft));
  if (glm::dot(wanted, wanted) == 0.0F) return Vec3(0.0F);
  return glm::normalize(wanted) * (held(kRun) > 0 ? kRunSpeed : kWalkSpeed);
}

}  // namespace grove::world

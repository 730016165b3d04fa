#include <gtest/gtest.h>

#include <cmath>
#include <random>
#include <vector>

#include "node/limits.h"
#include "node/messages/examples.h"
#include "node/messages/wire.h"

namespace grove::node {
namespace {

constexpr int kMutations = 100'000;

bool isFinite(const world::Vec3& v) { return std::isfinite(v.x) && std::isfinite(v.y) && std::isfinite(v.z); }

bool isSound(const NodeHello& hello) { return hello.types.size() <= kMaxTypes; }
bool isSound(const std::shared_ptr<const WorldUpdate>& world) {
  bool sound = world->number > 0 && std::isfinite(world->clock);
  for (const world::Player& player : world->players) {
    sound = sound && isFinite(player.pose.position) && isFinite(player.velocity) && player.name.size() <= kMaxNameBytes;
  }
  for (const world::Gust& gust : world->gusts) sound = sound && std::abs(glm::length(gust.direction) - 1.0F) < 0.01F;
  return sound;
}
bool isSound(const std::shared_ptr<const View>& view) {
  const world::Camera& camera = view->camera;
  return view->session != 0 && view->frame != 0 && camera.width >= 1 && camera.width <= kMaxCameraSize &&
         camera.height >= 1 && camera.height <= kMaxCameraSize && isFinite(camera.pose.position) &&
         camera.nearDepth > 0.0F && camera.nearDepth < camera.farDepth && !std::isnan(view->deadline);
}
bool isSound(const Request& request) {
  return (request.view || request.shared) && request.key.size() <= kMaxKeyBytes &&
         request.rect.left <= request.rect.right && request.rect.top <= request.rect.bottom && request.distance >= 0.0F;
}
bool isSound(const Cancel& cancel) { return cancel.session != 0 && cancel.frame != 0; }
bool isSound(const Quality& quality) { return quality.step >= 0 && quality.step <= kMaxQuality; }
bool isSound(const Forget& forget) { return forget.session != 0; }
bool isSound(const NodeWelcome& welcome) { return welcome.objects.size() <= kMaxServedObjects; }
bool isSound(const NodeRefusal& refusal) { return refusal.reason.size() <= kMaxReasonBytes; }
bool isSound(const Result& result) {
  const bool failed = std::holds_alternative<Failure>(result.payload);
  return result.what.key.size() <= kMaxKeyBytes && !(failed && result.packed) && (result.shared || result.frame != 0);
}
bool isSound(const Announcement& announcement) { return announcement.what.key.size() <= kMaxKeyBytes; }

std::string mutated(std::string bytes, const std::string& other, std::mt19937& random) {
  const int changes = 1 + static_cast<int>(random() % 3);
  for (int i = 0; i < changes; ++i) {
    const std::size_t at = bytes.empty() ? 0 : random() % bytes.size();
    switch (random() % 5) {
      case 0:
        if (!bytes.empty()) bytes[at] = static_cast<char>(random());
        break;
      case 1:
        if (!bytes.empty()) bytes[at] = static_cast<char>(bytes[at] ^ (1 << random() % 8));
        break;
      case 2:
        bytes.resize(at);
        break;
      case 3:
        bytes.insert(at, 1, static_cast<char>(random()));
        break;
      default:
        bytes += other.substr(random() % (other.size() + 1));
    }
  }
  return bytes;
}

TEST(WireMutations, AreRefusedOrSound) {
  std::vector<std::string> headers;
  for (const ToBackend& message : examples::toBackend()) headers.push_back(encode(message).header);
  for (const ToFrontend& message : examples::toFrontend()) headers.push_back(encode(message).header);
  const ViewLookup viewOf = examples::knownView();
  std::mt19937 random(12);
  int accepted = 0;
  for (int i = 0; i < kMutations; ++i) {
    const std::string header = mutated(headers[random() % headers.size()], headers[random() % headers.size()], random);
    const auto toBackend = decodeToBackend(header, viewOf);
    if (const auto* message = std::get_if<ToBackend>(&toBackend)) {
      ++accepted;
      ASSERT_TRUE(std::visit([](const auto& value) { return isSound(value); }, *message)) << i;
    }
    const auto toFrontend = decodeToFrontend({header, random() % 2 == 0 ? examples::bulk() : nullptr});
    if (const auto* message = std::get_if<ToFrontend>(&toFrontend)) {
      ++accepted;
      ASSERT_TRUE(std::visit([](const auto& value) { return isSound(value); }, *message)) << i;
    }
  }
  EXPECT_GT(accepted, kMutations / 100) << "mutations that nothing can read test nothing";
  EXPECT_LT(accepted, kMutations);
}

}  // namespace
}  // namespace grove::node

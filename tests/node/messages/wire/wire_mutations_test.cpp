#include <gtest/gtest.h>

#include <cmath>
#include <memory>
#include <random>
#include <string>
#include <vector>

#include "allocations.h"
#include "mutations.h"
#include "node/limits.h"
#include "node/messages/examples.h"
#include "node/messages/wire/wire.h"

namespace grove::node {
namespace {

bool isFinite(const world::Vec3& v) { return std::isfinite(v.x) && std::isfinite(v.y) && std::isfinite(v.z); }

bool isSound(const NodeHello& hello) { return hello.types.size() <= kMaxTypes; }
bool isSound(const std::shared_ptr<const WorldUpdate>& world) {
  bool sound = world->number > 0 && std::abs(world->clock) <= kMaxSeconds && std::abs(world->sent) <= kMaxSeconds &&
               world->gusts.size() <= kMaxGusts;
  for (const world::Player& player : world->players) {
    sound = sound && isFinite(player.pose.position) && isFinite(player.velocity) && player.name.size() <= kMaxNameBytes;
  }
  for (const world::Gust& gust : world->gusts) {
    sound = sound && std::abs(glm::length(gust.direction) - 1.0F) < 0.01F && gust.reach <= kMaxGustReach;
  }
  return sound;
}
bool isSound(const std::shared_ptr<const View>& view) {
  const world::Camera& camera = view->camera;
  return view->session != 0 && view->frame != 0 && camera.width >= 1 && camera.width <= kMaxCameraSize &&
         camera.height >= 1 && camera.height <= kMaxCameraSize && isFinite(camera.pose.position) &&
         camera.nearDepth > 0.0F && camera.nearDepth < camera.farDepth && std::abs(view->time) <= kMaxSeconds &&
         !std::isnan(view->deadline);
}
bool isSound(const Request& request) {
  return (request.view || request.shared) && request.key.size() <= kMaxKeyBytes &&
         request.rect.left <= request.rect.right && request.rect.top <= request.rect.bottom && request.distance >= 0.0F;
}
bool isSound(const Cancel& cancel) { return cancel.session != 0 && cancel.frame != 0; }
bool isSound(const Quality& quality) { return quality.step >= 0 && quality.step <= kMaxQuality; }
bool isSound(const Forget& forget) { return forget.session != 0; }
bool isSound(const Acknowledgement& received) { return received.what.key.size() <= kMaxKeyBytes; }
bool isSound(const Unsubscribe& ended) { return ended.what.key.size() <= kMaxKeyBytes; }
bool isSound(const NodeWelcome& welcome) { return welcome.objects.size() <= kMaxServedObjects; }
bool isSound(const NodeRefusal& refusal) { return refusal.reason.size() <= kMaxReasonBytes; }
bool isSound(const Result& result) {
  const bool failed = std::holds_alternative<Failure>(result.payload);
  return result.what.key.size() <= kMaxKeyBytes && !(failed && result.packed) && (result.shared || result.frame != 0);
}
bool isSound(const TraceRequest& /*request*/) { return true; }
bool isSound(const NodeReport& report) {
  return std::abs(report.sent) <= kMaxSeconds && report.stages.size() <= kMaxReportedStages &&
         report.memory.size() <= kMaxReportedHolders;
}
bool isSound(const std::shared_ptr<const NodeTrace>& trace) {
  return trace->runs.size() <= kMaxTracedRuns && eventsOf(*trace, 0).size() == trace->runs.size();
}
bool isSound(const Announcement& announcement) { return announcement.what.key.size() <= kMaxKeyBytes; }

/// What a header may take: mostly of parts that say nothing, two bytes of it each.
constexpr std::size_t kPerByte = 256;
constexpr std::size_t kAlways = 4096;

/// Bytes as a message of either direction.
class Decoding {
 public:
  /// What the library reads of the schema by the first message stays.
  Decoding() { (void)decodeToBackend({}, viewOf_), (void)decodeToFrontend({}); }

  /// How many of the two directions understand it, soundly.
  int understood(const std::string& header, bool withBulk) {
    const tests::Allocations allocations;
    const auto toBackend = decodeToBackend(header, viewOf_);
    const auto toFrontend = decodeToFrontend({header, withBulk ? bulk_ : nullptr});
    EXPECT_LE(allocations.bytes(), kAlways + kPerByte * header.size());
    return soundly<ToBackend>(toBackend) + soundly<ToFrontend>(toFrontend);
  }

 private:
  template <class Message>
  static int soundly(const Decoded<Message>& decoded) {
    const auto* const message = std::get_if<Message>(&decoded);
    if (message == nullptr) return 0;
    EXPECT_TRUE(std::visit([](const auto& value) { return isSound(value); }, *message));
    return 1;
  }

  const ViewLookup viewOf_ = examples::knownView();
  const std::shared_ptr<const PackedBytes> bulk_ = examples::bulk();
};

std::vector<std::string> headers() {
  std::vector<std::string> headers;
  for (const ToBackend& message : examples::toBackend()) headers.push_back(encode(message).header);
  for (const ToFrontend& message : examples::toFrontend()) headers.push_back(encode(message).header);
  return headers;
}

TEST(WireMutations, AreRefusedOrValid) {
  const std::vector<std::string> all = headers();
  Decoding decoding;
  std::mt19937 random(12);
  for (const std::string& header : all) {
    int understood = 0;
    for (int i = 0; i < tests::kMutations && !HasFailure(); ++i) {
      const std::string bytes = tests::mutated(header, all[random() % all.size()], random);
      understood += decoding.understood(bytes, random() % 2 == 0);
    }
    EXPECT_GT(understood, tests::kMutations / 100) << "mutations that nothing can read test nothing";
    EXPECT_LT(understood, 2 * tests::kMutations);
  }
}

/// Would catch a header that says so much with nothing in it that it takes gigabytes.
TEST(WireMutations, EmptyPartsTakeLimitedMemory) {
  const std::string update("\x12\xFC\xFF\x3F", 4);   // of the world, with almost a mebibyte of
  const std::string welcome("\x0A\xFC\xFF\x3F", 4);  // and the greeting
  const std::string report("\x32\xFC\xFF\x3F", 4);
  const std::string trace("\x3A\xFC\xFF\x3F", 4);
  for (const std::string& begin : {update, welcome, report, trace}) {
    for (char part = '\x1A'; part <= '\x2A'; part += 8) {
      std::string header = begin;
      while (header.size() + 2 <= kMaxHeaderBytes) header.append({part, '\0'});
      Decoding().understood(header, false);
    }
  }
}

}  // namespace
}  // namespace grove::node

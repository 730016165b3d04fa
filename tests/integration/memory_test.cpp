#include <gtest/gtest.h>

#include <chrono>
#include <cstdio>
#include <cstdlib>
#include <functional>
#include <memory>
#include <set>
#include <string>
#include <thread>
#include <vector>

#include "integration/picture.h"
#include "integration/served_scene.h"
#include "measure/memory_use.h"
#include "objects/lightfield/backend/simd/thicket.h"
#include "objects/lightfield/file/light_field_file.h"
#include "objects/lightfield/file/small_field.h"
#include "sanitized.h"
#include "stream/session/headless_session.h"

namespace grove::integration {
namespace {

using pipeline::Work;
using stream::HeadlessSession;
using Visitors = std::vector<std::unique_ptr<HeadlessSession>>;

// Sanitizers make everything ten times slower, so they get a smaller world.
constexpr int kWidth = kSanitized ? 640 : 1280;
constexpr int kHeight = kSanitized ? 360 : 720;
constexpr int kGrid = kSanitized ? 16 : 64;
constexpr int kViews = kSanitized ? 4 : 8;

/// Caches that visitors fill: pictures of objects, and the shadows of figures in every phase of their walk.
bool isCache(const std::string& holder) { return holder == "buffers" || holder == "shadows"; }

/// What is held for `work`; of shared work no caches.
double reported(const stream::Host& host, Work work) {
  double sum = 0.0;
  for (const auto& [key, total] : host.memory().totals()) {
    if (total.work != work || (work == Work::kAcrossUser && isCache(key.holder))) continue;
    sum += static_cast<double>(total.bytes);
  }
  return sum;
}

double toldInAll(const stream::Host& host) {
  double sum = 0.0;
  for (const auto& [key, total] : host.memory().totals()) sum += static_cast<double>(total.bytes);
  return sum;
}

void waitFor(const std::function<bool()>& condition) {
  const auto end = std::chrono::steady_clock::now() + kPatience;
  while (!condition() && std::chrono::steady_clock::now() < end)
    std::this_thread::sleep_for(std::chrono::milliseconds(20));
}

void enter(ServedScene& served, Visitors& visitors) {
  visitors.push_back(std::make_unique<HeadlessSession>(served.host, "visitor", kWidth, kHeight));
  for (int i = 0; i < 4; ++i) {
    (void)pictureAfter(*visitors.back(), world::kForward, 0.3F * static_cast<float>(i));
  }
}

/// A fire, stones, the ground, the sky, and a light field.
class Memory : public ::testing::Test {
 protected:
  static void SetUpTestSuite() {
    folder_ = new objects::lightfield::TemporaryFolder;
    objects::lightfield::writeLightField(objects::lightfield::Thicket().bake(kViews, 128, 3), *folder_ / "thicket.glf");
  }
  static void TearDownTestSuite() { delete folder_; }

  static std::string scene() {
    const std::string field = "[[object]]\ntype = 'lightfield'\nscale = 5\nfile = '" +
                              (*folder_ / "thicket.glf").string() + "'\nposition = [";
    return "name = 'a grove'\nspawn = [0, 0, 15]\n[visitor]\ntype = 'figure'\n"
           "[[object]]\ntype = 'fluid'\ngrid = " +
           std::to_string(kGrid) +
           "\n"
           "[[object]]\ntype = 'sky'\n"
           "[[object]]\ntype = 'mesh'\nposition = [3, 0, 3]\n"
           "[[object]]\ntype = 'mesh'\nshape = 'rocks'\nposition = [-3, 0, 3]\n" +
           field + "8, 0, -8]\n" + field + "-9, 0, -20]\n";
  }

  static objects::lightfield::TemporaryFolder* folder_;
};

objects::lightfield::TemporaryFolder* Memory::folder_ = nullptr;

bool isHonest(double share) {
  // Sanitizers keep memory of their own, so there the process holds more than is reported.
  return share > (kSanitized ? 0.0 : 0.85) && share < 1.05;
}

/// What is reported over what the process has grown by. In a process that did nothing before: else some of the growth
/// would be into memory that was freed and is still resident. What is reported before it is used, or freed after it was
/// reported, makes single readings differ; so there are some until one is honest.
double toldShare(const std::string& scene) {
  {
    // Libraries and threads take theirs once; as little as can be, for some of it stays resident when it is freed.
    ServedScene served("name = 'nothing'\n");
    HeadlessSession visitor(served.host, "visitor", 160, 90);
    (void)pictureAfter(visitor, world::kForward, 0.0F);
  }
  measure::returnFreedMemory();
  const auto before = static_cast<double>(measure::MemoryUse::read().resident);
  stream::HostOptions options;
  options.timelineEvents = 1024;  // what is kept for events is reported whole, though they come by and by
  ServedScene served(scene, options);
  Visitors visitors;
  for (int i = 0; i < 3; ++i) enter(served, visitors);
  for (const auto& visitor : visitors) (void)pictureAfter(*visitor, 0, 0.9F);
  double share = 0.0;
  for (int reading = 0; reading < 10 && !isHonest(share); ++reading) {
    std::this_thread::sleep_for(std::chrono::milliseconds(100));
    measure::returnFreedMemory();
    const double grown = static_cast<double>(measure::MemoryUse::read().resident) - before;
    share = toldInAll(served.host) / grown;
  }
  return share;
}

TEST_F(Memory, ReportMatchesTheProcess) {
  GTEST_FLAG_SET(death_test_style, "threadsafe");
  const auto check = [] {
    const double share = toldShare(scene());
    std::fprintf(stderr, "reported over grown: %.3f\n", share);
    std::_Exit(isHonest(share) ? 0 : 1);
  };
  EXPECT_EXIT(check(), testing::ExitedWithCode(0), "");
}

TEST_F(Memory, OnlyPerUserMemoryFollowsVisitors) {
  ServedScene served(scene());
  const stream::Host& host = served.host;
  const auto perUser = [&] { return reported(host, Work::kPerUserFrontend) + reported(host, Work::kPerUserBackend); };
  EXPECT_EQ(perUser(), 0.0);
  Visitors visitors;
  enter(served, visitors);
  const double one = perUser();
  const double shared = reported(host, Work::kAcrossUser);
  EXPECT_GT(one, kWidth * kHeight * 8.0) << "a frame at least";
  for (int i = 0; i < 2; ++i) enter(served, visitors);
  EXPECT_GT(perUser(), 1.5 * one);
  EXPECT_NEAR(reported(host, Work::kAcrossUser), shared, 0.02 * shared);
  visitors.clear();
  waitFor([&] { return perUser() == 0.0; });
  EXPECT_EQ(perUser(), 0.0);
  EXPECT_NEAR(reported(host, Work::kAcrossUser), shared, 0.02 * shared);
}

}  // namespace
}  // namespace grove::integration

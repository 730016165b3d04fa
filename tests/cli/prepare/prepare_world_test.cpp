#include "cli/prepare/prepare_world.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cstdlib>
#include <fstream>

#include "base/cache_folder.h"
#include "cli/prepare/temporary_folder.h"
#include "node/boxes.h"

namespace grove::cli {
namespace {

using testing::ElementsAre;
using testing::IsEmpty;

/// A file of the cache folder; its name is its weight.
class Carving final : public node::Preparation {
 public:
  Carving(std::string name, std::vector<std::string>& done) : name_(std::move(name)), done_(done) {}
  [[nodiscard]] std::string_view kind() const override { return "carving"; }
  [[nodiscard]] std::string name() const override { return name_; }
  [[nodiscard]] float cost() const override { return 1.0F; }
  [[nodiscard]] float weight() const override { return std::stof(name_); }
  [[nodiscard]] bool show() override { return std::filesystem::exists(cacheFolder() / name_); }
  [[nodiscard]] bool make(const Progress& progress, const std::stop_token& stop) override {
    if (stop.stop_requested()) return false;
    progress("carving", 0.5F);
    std::ofstream(cacheFolder() / name_) << "fine";
    done_.push_back("made " + name_);
    return true;
  }
  [[nodiscard]] bool showRoughly(const std::optional<std::filesystem::path>& elsewhere, int /*threads*/,
                                 const Progress& /*progress*/, const std::stop_token& stop) override {
    if (stop.stop_requested()) return false;
    std::ofstream(elsewhere.value_or(cacheFolder()) / ("rough " + name_)) << "rough";
    return true;
  }

 private:
  const std::string name_;
  std::vector<std::string>& done_;
};

/// A type of one's own that says what its objects need.
class CarvedType final : public node::BackendType {
 public:
  explicit CarvedType(std::vector<std::string>& done) : done_(done) {}
  [[nodiscard]] std::string_view name() const override { return "carved"; }
  [[nodiscard]] std::shared_ptr<const world::Model> model(const world::Parameters&) const override {
    return std::make_shared<node::testing::BoxModel>(1.0F, 0xFF000000U, 0.0F);
  }
  [[nodiscard]] std::unique_ptr<node::BackendHalf> makeHalf(const node::BackendServices&,
                                                            world::TypeIndex) const override {
    return nullptr;
  }
  [[nodiscard]] std::vector<std::unique_ptr<node::Preparation>> preparations(const world::Scene& scene) const override {
    std::vector<std::unique_ptr<node::Preparation>> carvings;
    for (const world::ObjectDescription& object : scene.objects) {
      if (object.type == name()) carvings.push_back(std::make_unique<Carving>(object.name, done_));
    }
    return carvings;
  }

 private:
  std::vector<std::string>& done_;
};

class PrepareWorld : public testing::Test {
 protected:
  PrepareWorld() {
    setenv("GROVE_CACHE", folder_.path().c_str(), 1);
    types_.add(std::make_unique<CarvedType>(done_));
  }
  void TearDown() override { unsetenv("GROVE_CACHE"); }

  std::optional<Preparations> firstLook(const std::stop_token& stop = {}) {
    return prepareFirstLook(
        scene_, types_, [](std::string_view, float) {}, stop);
  }

  const TemporaryFolder folder_;
  std::vector<std::string> done_;
  node::BackendTypes types_;
  const world::Scene scene_ =
      world::parseScene("[[object]]\ntype = 'carved'\nname = '1'\n[[object]]\ntype = 'carved'\nname = '2'\n", "test");
  Progress progress_;
};

TEST_F(PrepareWorld, PreparesMissingParts) {
  ASSERT_TRUE(prepareWorld(scene_, types_, progress_, {}));
  EXPECT_THAT(done_, ElementsAre("made 1", "made 2"));
  std::filesystem::remove(folder_.path() / "1");
  ASSERT_TRUE(prepareWorld(scene_, types_, progress_, {}));
  EXPECT_THAT(done_, ElementsAre("made 1", "made 2", "made 1"));
}

TEST_F(PrepareWorld, PreparesCoarseFirstAndRefinesByWeight) {
  const auto left = firstLook();
  ASSERT_TRUE(left);
  ASSERT_EQ(left->size(), 2U);
  EXPECT_EQ(left->front()->name(), "2");
  EXPECT_TRUE(std::filesystem::exists(folder_.path() / "rough 1"));
  EXPECT_THAT(done_, IsEmpty());
  ASSERT_TRUE(left->front()->make([](std::string_view, float) {}, {}));
  EXPECT_EQ(firstLook()->size(), 1U);
}

TEST_F(PrepareWorld, SkipsRefinementWithoutCache) {
  std::ofstream(folder_.path() / "file") << "in the way";
  setenv("GROVE_CACHE", (folder_.path() / "file").c_str(), 1);
  const auto left = firstLook();
  ASSERT_TRUE(left);
  EXPECT_THAT(*left, IsEmpty());
}

TEST_F(PrepareWorld, StopsOnRequest) {
  std::stop_source stop;
  stop.request_stop();
  EXPECT_FALSE(firstLook(stop.get_token()));
  EXPECT_FALSE(prepareWorld(scene_, types_, progress_, stop.get_token()));
  EXPECT_THAT(done_, IsEmpty());
}

}  // namespace
}  // namespace grove::cli

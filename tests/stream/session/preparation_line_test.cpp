#include "stream/session/preparation_line.h"

#include <gtest/gtest.h>
#include <sys/resource.h>

#include <atomic>
#include <chrono>
#include <mutex>
#include <optional>
#include <thread>

#include "eventually.h"
#include "gl/shader_library.h"
#include "gl/workers.h"
#include "node/local/local_world.h"
#include "node/object_types.h"
#include "pipeline/clocks.h"
#include "stream/session/host.h"
#include "stream/web_server/connection.h"

namespace grove::stream {
namespace {

using tests::eventually;

/// What the test holds and sees of the preparation of worlds.
struct Preparations {
  std::atomic<bool> held{true};
  std::atomic<bool> fail{false};
  std::atomic<int> begun{0};
  std::atomic<int> abandoned{0};
  std::atomic<int> made{0};
  std::atomic<int> niceness{0};
  std::atomic<pipeline::Executor*> helpers{nullptr};
};

class NoModel final : public world::Model {
 public:
  [[nodiscard]] world::Bounds bounds() const override { return {world::Vec3(-1.0F), world::Vec3(1.0F)}; }
};

/// Shows nothing, and is prepared for as long as the test wants, with progress.
class HeldBackend final : public node::BackendHalf {
 public:
  HeldBackend(const node::BackendServices& services, Preparations& preparations) : services_(services) {
    preparations.niceness = getpriority(PRIO_PROCESS, 0);
    preparations.helpers = services.helpers;
    ++preparations.begun;
    while (preparations.held) {
      try {
        services.progress("holding", 0.4F);
      } catch (...) {
        ++preparations.abandoned;
        throw;
      }
      std::this_thread::yield();
    }
    if (preparations.fail) throw std::runtime_error("the disk is full");
    ++preparations.made;
  }
  [[nodiscard]] node::NodeKind kind() const override { return node::NodeKind::kRendering; }
  [[nodiscard]] pipeline::Executor& executor() override { return services_.workers; }
  void answer(std::span<const node::Request> requests, std::span<node::Payload> payloads) override {
    for (std::size_t i = 0; i < requests.size(); ++i) payloads[i] = std::shared_ptr<const raster::Image>();
  }

 private:
  const node::BackendServices services_;
};

class HeldBackendType final : public node::BackendType {
 public:
  explicit HeldBackendType(Preparations& preparations) : preparations_(preparations) {}
  [[nodiscard]] std::string_view name() const override { return "held"; }
  [[nodiscard]] std::shared_ptr<const world::Model> model(const world::Parameters& parameters) const override {
    parameters.finish();
    return std::make_shared<NoModel>();
  }
  [[nodiscard]] std::unique_ptr<node::BackendHalf> makeHalf(const node::BackendServices& services,
                                                            world::TypeIndex) const override {
    return std::make_unique<HeldBackend>(services, preparations_);
  }

 private:
  Preparations& preparations_;
};

class HeldFrontendType final : public node::FrontendType {
 public:
  [[nodiscard]] std::string_view name() const override { return "held"; }
};

node::ObjectTypes heldTypes(Preparations& preparations) {
  node::ObjectTypes types;
  types.backends.add(std::make_unique<HeldBackendType>(preparations));
  types.frontends.add(std::make_unique<HeldFrontendType>());
  return types;
}

node::LoadedScene heldScene(const node::ObjectTypes& types) {
  return node::loadScene(world::parseScene("[[object]]\ntype = 'held'\n", "test"), types.backends);
}

/// What a visitor is told, until he leaves.
class Visitor {
 public:
  explicit Visitor(Host& host) {
    auto opened = host.open(
        Hello{"", 160, 90}, [seen = seen_](const std::shared_ptr<const EncodedFrame>&) { ++seen->frames; },
        [seen = seen_](const Waiting& waiting) {
          const std::lock_guard lock(seen->mutex);
          seen->last = waiting;
          ++seen->reported;
        });
    session_ = std::get<std::shared_ptr<Session>>(std::move(opened));
  }
  ~Visitor() { session_->close(); }
  Visitor(const Visitor&) = delete;
  Visitor& operator=(const Visitor&) = delete;

  [[nodiscard]] bool isAt(int place) const {
    const std::lock_guard lock(seen_->mutex);
    return seen_->last && seen_->last->place == place;
  }
  [[nodiscard]] Waiting last() const {
    const std::lock_guard lock(seen_->mutex);
    return seen_->last.value_or(Waiting{});
  }
  [[nodiscard]] int reported() const {
    const std::lock_guard lock(seen_->mutex);
    return seen_->reported;
  }
  [[nodiscard]] bool sees() const { return seen_->frames > 0; }

 private:
  struct Seen {
    std::mutex mutex;
    std::optional<Waiting> last;
    int reported = 0;
    std::atomic<int> frames{0};
  };
  const std::shared_ptr<Seen> seen_ = std::make_shared<Seen>();
  std::shared_ptr<Session> session_;
};

class PreparationLineTest : public testing::Test {
 public:
  ~PreparationLineTest() override { preparations_.held = false; }

 protected:
  Preparations preparations_;
  log::Limited visitorLog_;
  const node::ObjectTypes types_ = heldTypes(preparations_);
  gl::ShaderLibrary shaders_;
  gl::Workers gl_{gl::ContextKind::kAuto, shaders_, 1};
  std::optional<Host> host_{std::in_place, node::localWorld(heldScene(types_), types_.backends, gl_), types_.frontends,
                            HostOptions{.privateWorlds = true}, [](std::string_view, float) {}};
};

TEST_F(PreparationLineTest, ReportsEveryPlaceAndHowTheFirstGetsOn) {
  const Visitor first(*host_);
  const Visitor second(*host_);
  const Visitor third(*host_);
  EXPECT_TRUE(eventually([&] { return first.last().step == "holding"; }));
  EXPECT_EQ(first.last().place, 1);
  EXPECT_EQ(first.last().percent, 40);
  EXPECT_TRUE(second.isAt(2));
  EXPECT_TRUE(third.isAt(3));
  EXPECT_EQ(third.last().step, "") << "of another's world";
  preparations_.held = false;
  EXPECT_TRUE(eventually([&] { return first.sees() && second.sees() && third.sees(); }));
  EXPECT_TRUE(third.isAt(1)) << "the line moved up, one by one";
}

TEST_F(PreparationLineTest, MovesUpWhenOneInTheMiddleLeaves) {
  const Visitor first(*host_);
  std::optional<Visitor> second(std::in_place, *host_);
  const Visitor third(*host_);
  ASSERT_TRUE(third.isAt(3));
  second.reset();
  EXPECT_TRUE(third.isAt(2)) << "at once";
  EXPECT_TRUE(first.isAt(1));
  EXPECT_EQ(preparations_.abandoned, 0) << "the first one's world is made on";
  preparations_.held = false;
  EXPECT_TRUE(eventually([&] { return first.sees() && third.sees(); }));
  EXPECT_EQ(preparations_.made, 2) << "none for him who left";
}

TEST_F(PreparationLineTest, WhoLeavesGivesUpTheWorldThatIsBeingMade) {
  std::optional<Visitor> first(std::in_place, *host_);
  const Visitor second(*host_);
  ASSERT_TRUE(eventually([&] { return preparations_.begun == 1; }));
  first.reset();
  EXPECT_TRUE(second.isAt(1)) << "at once";
  EXPECT_TRUE(eventually([&] { return preparations_.abandoned == 1 && preparations_.begun == 2; }))
      << "the next one's is begun, though nothing else ended the first one's";
  EXPECT_EQ(preparations_.made, 0);
  preparations_.held = false;
  EXPECT_TRUE(eventually([&] { return second.sees(); }));
}

TEST_F(PreparationLineTest, ReportsAnewThoughNothingChanges) {
  const Visitor first(*host_);
  const Visitor second(*host_);
  const int before = second.reported();
  EXPECT_TRUE(eventually([&] { return second.reported() >= before + 2; })) << "or its page takes the line for dead";
  EXPECT_TRUE(second.isAt(2));
}

TEST_F(PreparationLineTest, TheHostEndsInTheMidstOfAWorld) {
  const Visitor first(*host_);
  const Visitor second(*host_);
  ASSERT_TRUE(eventually([&] { return preparations_.begun == 1; }));
  // If nothing else ends it.
  std::jthread release([this](const std::stop_token& stopped) {
    static_cast<void>(eventually([&] { return stopped.stop_requested(); }));
    preparations_.held = false;
  });
  host_.reset();
  release.request_stop();
  EXPECT_EQ(preparations_.abandoned, 1);
  EXPECT_EQ(preparations_.made, 0);
  EXPECT_EQ(preparations_.begun, 1) << "none is begun for those behind";
}

TEST_F(PreparationLineTest, LeavesTheMachineToThoseWhoAreInside) {
  preparations_.held = false;
  std::optional<Visitor> first(std::in_place, *host_);
  ASSERT_TRUE(eventually([&] { return first->sees(); }));
  EXPECT_EQ(preparations_.helpers, &host_->workers()) << "nobody is inside yet";
  EXPECT_EQ(preparations_.niceness, getpriority(PRIO_PROCESS, 0));
  const Visitor second(*host_);
  ASSERT_TRUE(eventually([&] { return second.sees(); }));
  EXPECT_EQ(preparations_.helpers, nullptr) << "the workers are the first one's";
  EXPECT_GT(preparations_.niceness, getpriority(PRIO_PROCESS, 0));
}

TEST_F(PreparationLineTest, PagesThatDoNotKnowOfWaitingHearNothingOfIt) {
  const double now = pipeline::wallSeconds();
  const Connection::Door door{[] { return std::make_shared<int>(); }, visitorLog_};
  Connection newer(
      *host_, "newer", now, [] {}, door, kSubProtocolWithWaiting);
  Connection older(
      *host_, "older", now, [] {}, door, kSubProtocol);
  const auto hello = encode(Hello{"", 160, 90});
  for (Connection* connection : {&newer, &older}) {
    ASSERT_FALSE(connection->receive({hello, true, true, true}, now));
    ASSERT_TRUE(connection->hasSomethingToSend());
    EXPECT_TRUE(std::holds_alternative<Welcome>(parseServerMessage(connection->takeMessage()))) << "comes first";
  }
  ASSERT_TRUE(eventually([&] { return newer.hasSomethingToSend(); }));
  const ServerMessage reported = parseServerMessage(newer.takeMessage());
  ASSERT_TRUE(std::holds_alternative<Waiting>(reported));
  EXPECT_EQ(std::get<Waiting>(reported).place, 1);
  ASSERT_TRUE(eventually([&] { return newer.hasSomethingToSend(); })) << "all were told anew";
  EXPECT_FALSE(older.hasSomethingToSend());
}

TEST_F(PreparationLineTest, WhoseWorldCannotBeMadeIsToldSoAndGivesUpHisPlace) {
  const double now = pipeline::wallSeconds();
  auto place = std::make_shared<int>();
  Connection visitor(
      *host_, "visitor", now, [] {}, {[&place] { return place; }, visitorLog_}, kSubProtocol);
  const auto hello = encode(Hello{"", 160, 90});
  ASSERT_FALSE(visitor.receive({hello, true, true, true}, now));
  EXPECT_FALSE(visitor.overdue(now)) << "his world is being made";
  preparations_.fail = true;
  preparations_.held = false;
  ASSERT_TRUE(eventually([&] { return host_->visitors() == 0; }));
  const auto input = encode(world::Input{1, 0, 0.0F, 0.0F});
  EXPECT_FALSE(visitor.receive({input, true, true, true}, now)) << "there is nothing wrong with what he sends";
  const auto why = visitor.overdue(now);
  ASSERT_TRUE(why);
  EXPECT_EQ(why->code, CloseCode::kFull) << "the page tries again later";
  EXPECT_NE(why->reason.find("cannot be made"), std::string::npos);
  EXPECT_EQ(place.use_count(), 1) << "it is his no more";
}

TEST(SharedWorld, IsMadeWithAllWorkers) {
  Preparations preparations;
  preparations.held = false;
  const node::ObjectTypes types = heldTypes(preparations);
  const gl::ShaderLibrary shaders;
  gl::Workers gl(gl::ContextKind::kAuto, shaders, 1);
  Host host(node::localWorld(heldScene(types), types.backends, gl), types.frontends, {},
            [](std::string_view, float) {});
  EXPECT_EQ(preparations.helpers, &host.workers());
  EXPECT_EQ(preparations.niceness, getpriority(PRIO_PROCESS, 0));
}

}  // namespace
}  // namespace grove::stream

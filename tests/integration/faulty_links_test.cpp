#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <chrono>
#include <fstream>
#include <memory>
#include <optional>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

#include "base/error.h"
#include "base/tls/certificates.h"
#include "eventually.h"
#include "integration/fault_proxy.h"
#include "integration/node_program.h"
#include "integration/picture.h"
#include "integration/remote_world.h"
#include "integration/stones.h"
#include "node/transport/grpc/tls/link_tls.h"
#include "objects/builtin_frontends.h"
#include "running_time.h"
#include "sanitized.h"
#include "stream/session/headless_session.h"
#include "stream/session/host.h"

namespace grove::integration {
namespace {

using namespace std::chrono_literals;
using ::testing::HasSubstr;
using tests::eventually;
using tests::RunningTime;
using State = node::LinkState;

constexpr const char* kAll = "sky,ground,mesh,figure";
/// Radians to the side of the stones.
constexpr float kTurn = 0.3F;
/// Longer than a frame waits for its objects, and than a backdrop is shown while something better is under way; and so
/// many frames, for a slow machine.
constexpr auto kUnchanged = 1500ms;
constexpr int kUnchangedFrames = 10;
constexpr auto kMostPatience = kSanitized ? 240s : 60s;

/// A server whose whole world a node owns, with a network of bad repute between them.
class FaultyLinks : public ::testing::Test {
 protected:
  FaultyLinks() {
    writeFile(scene_, kStones);
    startNode();
  }

  void startNode(int port = 0, const std::vector<std::string>& more = {}) {
    node_ = std::make_unique<NodeProgram>(scene_, kAll, port, more);
    ASSERT_NE(node_->port(), 0);
  }
  /// Through the proxy; a visitor sees the world before it fails.
  void serve(const std::string& host = "127.0.0.1", const node::LinkTls& tls = {}) {
    proxy_ = std::make_unique<FaultProxy>(node_->port());
    const std::string address = host + ":" + std::to_string(proxy_->port());
    host_ = std::make_unique<stream::Host>(remoteWorld(kStones, types_, {address}, 1, tls), types_,
                                           stream::HostOptions{}, [](std::string_view, float) {});
    visitor_ = std::make_unique<stream::HeadlessSession>(*host_, "Ada", 320, 180);
    ahead_ = settled(0.0F);
    aside_ = settled(kTurn);
    ASSERT_GT(difference(ahead_, aside_), 1.0) << "of nothing; " << report();
  }
  /// The error of a server that starts behind the proxy; empty if it begins.
  std::string whyNoHostBegins() {
    try {
      const stream::Host host(remoteWorld(kStones, types_, {proxy_->address()}), types_, {},
                              [](std::string_view, float) {});
    } catch (const EnvironmentError& e) {
      return e.what();
    }
    return {};
  }
  void expectTheSame() {
    EXPECT_EQ(difference(ahead_, settled(0.0F)), 0.0) << report();
    EXPECT_EQ(difference(aside_, settled(kTurn)), 0.0) << report();
  }

  [[nodiscard]] node::LinkStatus link() const { return host_->nodeLinks().at(0).status; }
  [[nodiscard]] bool becomes(State state) const {
    return eventually([&] { return link().state == state; });
  }
  /// What is seen there once nothing has changed for a while.
  Picture settled(float yaw) {
    const std::uint32_t input = visitor_->control(0, yaw, 0.0F);
    auto frame = comes([&](auto soon) { return visitor_->frameShowing(input, soon); });
    Picture picture = decode(frame);
    RunningTime time;
    auto since = time.passed();
    int alike = 0;
    while ((time.passed() - since < kUnchanged || alike < kUnchangedFrames) && time.passed() < kMostPatience) {
      frame = comes([&](auto soon) { return visitor_->frameAfter(frame->header.frame, soon); });
      Picture next = decode(frame);
      ++alike;
      if (difference(picture, next) != 0.0) {
        since = time.passed();
        alike = 0;
      }
      picture = std::move(next);
    }
    EXPECT_LT(time.passed(), kMostPatience) << "what is seen changes for ever; " << report();
    return picture;
  }
  /// The frame that `look` finds; throws if there is none for long.
  template <class Look>
  [[nodiscard]] std::shared_ptr<const stream::EncodedFrame> comes(const Look& look) const {
    RunningTime time;
    while (time.passed() < kMostPatience) {
      if (auto frame = look(100ms)) return frame;
    }
    throw std::runtime_error("no frame comes; " + report());
  }
  /// Frames come, and nobody was dropped.
  [[nodiscard]] bool goesOn() const {
    const std::uint64_t received = visitor_->framesReceived();
    return eventually([&] { return visitor_->framesReceived() > received + 10; }) && host_->visitors() == 1;
  }
  /// For whoever has to find out why a test failed.
  [[nodiscard]] std::string report() const {
    std::string report = "link " + std::to_string(static_cast<int>(link().state)) + " " + link().reason + ", " +
                         std::to_string(proxy_->accepted()) + " connections";
    for (const auto& [name, count] : host_->timeline().counters()) report += "; " + name + ": " + std::to_string(count);
    return report;
  }
  /// How many lines of what was logged say so.
  static std::size_t linesWith(const std::string& text, const std::string& log) {
    std::size_t count = 0;
    for (std::size_t at = log.find(text); at != std::string::npos; at = log.find(text, at + 1)) ++count;
    return count;
  }

  TestFolder folder_;
  const std::string scene_ = folder_.file("scene.toml");
  const node::FrontendTypes types_ = objects::builtinFrontends();
  std::unique_ptr<NodeProgram> node_;
  std::unique_ptr<FaultProxy> proxy_;
  std::unique_ptr<stream::Host> host_;
  std::unique_ptr<stream::HeadlessSession> visitor_;
  Picture ahead_;  ///< as it is seen before anything fails
  Picture aside_;  ///< the same
};

TEST_F(FaultyLinks, SlowLinkShowsTheSamePicture) {
  serve();
  EXPECT_TRUE(eventually([&] { return host_->nodeLinks().at(0).pace.received > 0.0; })) << report();
  proxy_->delay(80ms);
  expectTheSame();
  EXPECT_TRUE(eventually([&] { return host_->nodeLinks().at(0).pace.roundTrip >= 0.16; })) << "the way there and back";
  EXPECT_TRUE(goesOn());
  EXPECT_EQ(link().state, State::kWelcomed);
  EXPECT_EQ(proxy_->accepted(), 1);
}

TEST_F(FaultyLinks, CutLinkReconnects) {
  serve();
  ::testing::internal::CaptureStderr();
  proxy_->cut();
  EXPECT_TRUE(eventually([&] { return proxy_->accepted() >= 2; }));
  EXPECT_TRUE(becomes(State::kWelcomed));
  const std::string log = ::testing::internal::GetCapturedStderr();
  EXPECT_EQ(linesWith("is lost", log), 1U) << log;
  EXPECT_EQ(linesWith("is back", log), 1U) << log;
  EXPECT_TRUE(goesOn());
  expectTheSame();
}

/// The worst of them: to a socket it looks like a node that has nothing to say.
TEST_F(FaultyLinks, HalfOpenLinkReconnects) {
  serve();
  proxy_->setHalfOpen(true);
  (void)visitor_->control(0, 0.0F, 0.0F);
  EXPECT_TRUE(goesOn()) << "before anybody has noticed";
  EXPECT_TRUE(becomes(State::kLost)) << "by keep-alive; the sockets alone would wait for a quarter of an hour";
  EXPECT_NE(link().reason, "");
  EXPECT_TRUE(eventually([&] { return proxy_->accepted() >= 2; })) << "it is tried again, and not answered";
  EXPECT_TRUE(goesOn());
  EXPECT_EQ(link().state, State::kLost);
  proxy_->setHalfOpen(false);
  EXPECT_TRUE(becomes(State::kWelcomed));
  expectTheSame();
  EXPECT_EQ(host_->visitors(), 1U);
}

TEST_F(FaultyLinks, SilentNodeIsReported) {
  proxy_ = std::make_unique<FaultProxy>(node_->port());
  proxy_->setHalfOpen(true);
  EXPECT_THAT(whyNoHostBegins(), HasSubstr(proxy_->address() + ": no node answers: "));
}

/// The node takes each connection, and never gets to hear the hello.
TEST_F(FaultyLinks, OneWayLinkReconnects) {
  serve();
  ::testing::internal::CaptureStderr();
  proxy_->setDeaf(true);
  proxy_->cut();
  EXPECT_TRUE(becomes(State::kSilent)) << report();
  EXPECT_THAT(link().reason, HasSubstr("neither welcomes nor refuses"));
  EXPECT_TRUE(goesOn());
  const int calls = proxy_->accepted();
  EXPECT_TRUE(eventually([&] { return proxy_->accepted() > calls; })) << "it is called again";
  proxy_->setDeaf(false);
  EXPECT_TRUE(becomes(State::kWelcomed)) << report();
  const std::string log = ::testing::internal::GetCapturedStderr();
  EXPECT_EQ(linesWith("is silent: ", log), 1U) << log;
  EXPECT_EQ(linesWith("is back", log), 1U) << log;
  expectTheSame();
}

TEST_F(FaultyLinks, MissingWelcomeIsReported) {
  proxy_ = std::make_unique<FaultProxy>(node_->port());
  proxy_->setDeaf(true);
  EXPECT_THAT(whyNoHostBegins(),
              HasSubstr(proxy_->address() + ": the node does not respond: it accepts the connection"));
}

TEST_F(FaultyLinks, CorruptedLinkReconnects) {
  serve();
  ::testing::internal::CaptureStderr();
  // More than a frame of HTTP/2 holds, so the header of one is among them.
  proxy_->corrupt(std::size_t{1} << 20U);
  (void)visitor_->control(0, 0.0F, 0.0F);
  EXPECT_TRUE(eventually([&] { return proxy_->accepted() >= 2; }));
  EXPECT_TRUE(becomes(State::kWelcomed));
  const std::string log = ::testing::internal::GetCapturedStderr();
  EXPECT_EQ(linesWith("is lost: ", log), 1U) << log;
  EXPECT_TRUE(goesOn());
  expectTheSame();
}

TEST_F(FaultyLinks, TlsDetectsASingleWrongByte) {
  const TlsFiles files{folder_.file("cert.pem"), folder_.file("cert.key")};
  writePair(files);
  startNode(0, {"--tls-cert", files.certificate, "--tls-key", files.key});
  serve("localhost", node::readLinkTls({}, files.certificate));
  ::testing::internal::CaptureStderr();
  proxy_->corrupt(1);
  (void)visitor_->control(0, 0.0F, 0.0F);
  EXPECT_TRUE(eventually([&] { return proxy_->accepted() >= 2; }));
  EXPECT_TRUE(becomes(State::kWelcomed));
  const std::string log = ::testing::internal::GetCapturedStderr();
  EXPECT_EQ(linesWith("is lost: ", log), 1U) << log;
  EXPECT_TRUE(goesOn());
  expectTheSame();
}

/// The visitor turns while the node is away, so only the node that has come back can show what he sees then.
TEST_F(FaultyLinks, ObjectsReturnTwoSecondsAfterARestart) {
  serve();
  (void)settled(0.0F);
  const int port = node_->port();
  node_->end(SIGKILL);
  ASSERT_TRUE(becomes(State::kLost));
  const Picture meanwhile = settled(kTurn);
  EXPECT_TRUE(goesOn());
  EXPECT_GT(difference(aside_, meanwhile), 0.0) << "nobody could have drawn it";
  ASSERT_NO_FATAL_FAILURE(startNode(port));
  RunningTime time;
  std::optional<RunningTime::Clock::duration> welcomed;
  std::optional<RunningTime::Clock::duration> back;
  double differs = 0.0;
  node::FrameNumber newest = 0;
  int frames = 0;
  while (!back && time.passed() < kMostPatience) {
    const auto frame = visitor_->frameAfter(newest, 2ms);
    if (!welcomed && link().state == State::kWelcomed) welcomed = time.passed();
    if (frame == nullptr) continue;
    newest = frame->header.frame;
    ++frames;
    differs = difference(aside_, decode(frame));
    if (differs == 0.0) back = time.passed();
  }
  ASSERT_TRUE(back) << "its objects do not come back: " << frames << " frames, the last differs by " << differs
                    << ", from while they were away it differs by " << difference(meanwhile, settled(kTurn))
                    << "; held up for " << time.longestStep().count() << " ms at once; " << report();
  ASSERT_TRUE(welcomed) << report();
  const auto took = std::chrono::duration_cast<std::chrono::milliseconds>(*back - *welcomed);
  RecordProperty("milliseconds", static_cast<int>(took.count()));
  // A sanitizer makes the node's pictures several times as slow, on processors that other tests share.
  if (!kSanitized) {
    EXPECT_LE(took, 2000ms) << frames << " frames, held up for " << time.longestStep().count() << " ms; " << report();
  }
  EXPECT_EQ(host_->visitors(), 1U);
}

}  // namespace
}  // namespace grove::integration

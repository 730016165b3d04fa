#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <functional>
#include <limits>
#include <type_traits>

#include "allocations.h"
#include "node/messages/examples.h"
#include "node/messages/wire/wire.h"

namespace grove::node {
namespace {

using testing::HasSubstr;

constexpr float kInfinity = std::numeric_limits<float>::infinity();
constexpr float kNan = std::numeric_limits<float>::quiet_NaN();

template <class Message>
std::string reasonOf(const Decoded<Message>& decoded) {
  const auto* error = std::get_if<WireError>(&decoded);
  return error == nullptr ? "nothing wrong" : error->reason;
}

std::string refusal(const ToBackend& message) {
  return reasonOf(decodeToBackend(encode(message).header, examples::knownView()));
}
std::string refusal(const ToFrontend& message) { return reasonOf(decodeToFrontend(encode(message))); }

template <class Message>
using Spoil = std::function<void(Message&)>;

/// Why a message is refused once `spoil` has changed it.
template <class Message>
std::string refusalOf(Message message, const std::type_identity_t<Spoil<Message>>& spoil) {
  spoil(message);
  if constexpr (std::is_same_v<Message, View> || std::is_same_v<Message, WorldUpdate>) {
    return refusal(ToBackend(std::shared_ptr<const Message>(std::make_shared<Message>(std::move(message)))));
  } else if constexpr (std::is_constructible_v<ToBackend, Message>) {
    return refusal(ToBackend(std::move(message)));
  } else {
    return refusal(ToFrontend(std::move(message)));
  }
}

std::string viewRefusal(const Spoil<View>& spoil) { return refusalOf(examples::view(), spoil); }
std::string cameraRefusal(const Spoil<world::Camera>& spoil) {
  return viewRefusal([&](View& view) { spoil(view.camera); });
}
std::string requestRefusal(const Spoil<Request>& spoil) { return refusalOf(examples::request(), spoil); }
std::string worldRefusal(const Spoil<WorldUpdate>& spoil) { return refusalOf(examples::world(), spoil); }

TEST(WireRefusals, ExamplesAreValid) {
  for (const ToBackend& message : examples::toBackend()) EXPECT_EQ(refusal(message), "nothing wrong");
  for (const ToFrontend& message : examples::toFrontend()) EXPECT_EQ(refusal(message), "nothing wrong");
}

TEST(WireRefusals, NotAMessage) {
  const auto toBackend = [](std::string_view header) {
    return reasonOf(decodeToBackend(header, examples::knownView()));
  };
  const auto toFrontend = [](std::string header) { return reasonOf(decodeToFrontend({std::move(header), nullptr})); };
  EXPECT_THAT(toBackend(""), HasSubstr("unknown kind"));
  EXPECT_THAT(toFrontend(""), HasSubstr("unknown kind"));
  EXPECT_THAT(toBackend("\xFF\xFF"), HasSubstr("damaged"));
  EXPECT_THAT(toFrontend("\xFF\xFF"), HasSubstr("damaged"));
  EXPECT_THAT(toBackend(std::string(kMaxHeaderBytes + 1, '\0')), HasSubstr("too long"));
  EXPECT_THAT(toFrontend(std::string(kMaxHeaderBytes + 1, '\0')), HasSubstr("too long"));
}

/// Would catch 13 bytes that have memory of 50 MB set aside: a hello, in it a type, in it a name, each far longer than
/// what is there.
TEST(WireRefusals, OversizedParts) {
  const std::string whole("\x0A\x04\x2A\x02\x12\x00", 6);
  EXPECT_EQ(reasonOf(decodeToBackend(whole, examples::knownView())), "nothing wrong");
  for (const char* const header :
       {"\x0A\xC0\x84\x3D\x2A\xA0\x84\x3D\x12\x80\x84\x3D", "\x0A\x04\x2A\x03\x12\x01n", "\x0A\x04\x2A\x02\x12\x01n"}) {
    const tests::Allocations allocations;
    EXPECT_THAT(reasonOf(decodeToBackend(header, examples::knownView())), HasSubstr("damaged"));
    EXPECT_LT(allocations.bytes(), 10'000u);
  }
}

TEST(WireRefusals, EveryTruncation) {
  for (const ToBackend& message : examples::toBackend()) {
    const std::string header = encode(message).header;
    EXPECT_NE(reasonOf(decodeToBackend(header.substr(0, header.size() - 1), examples::knownView())), "nothing wrong");
  }
  for (const ToFrontend& message : examples::toFrontend()) {
    Packet packet = encode(message);
    packet.header.pop_back();
    EXPECT_NE(reasonOf(decodeToFrontend(packet)), "nothing wrong");
  }
}

TEST(WireRefusals, Names) {
  const auto spoilt = [](std::string name) {
    return refusalOf(examples::hello(), [&](NodeHello& hello) { hello.types[0].name = std::move(name); });
  };
  EXPECT_EQ(spoilt(std::string(kMaxNameBytes, 'n')), "nothing wrong");
  EXPECT_EQ(spoilt(std::string(kMaxNameBytes + 1, 'n')), "hello: a name is too long");
  EXPECT_EQ(spoilt("\xFF"), "hello: a name is not UTF-8");
  EXPECT_THAT(worldRefusal([](WorldUpdate& world) { world.players[1].name = "\xC3"; }), HasSubstr("UTF-8"));
  EXPECT_THAT(refusalOf(examples::welcome(), [](NodeWelcome& welcome) { welcome.objects[0].name = "\xC3"; }),
              HasSubstr("UTF-8"));
}

TEST(WireRefusals, Counts) {
  EXPECT_THAT(worldRefusal([](WorldUpdate& world) { world.players.resize(kMaxPlayers + 1); }), HasSubstr("players"));
  EXPECT_THAT(viewRefusal([](View& view) { view.visitors = kMaxPlayers + 1; }), HasSubstr("visitors"));
  EXPECT_THAT(worldRefusal([](WorldUpdate& world) { world.gusts.resize(kMaxGusts + 1); }), HasSubstr("gusts"));
  EXPECT_EQ(worldRefusal([](WorldUpdate& world) { world.gusts.resize(kMaxGusts, examples::gust()); }), "nothing wrong");
  EXPECT_THAT(refusalOf(examples::hello(), [](NodeHello& hello) { hello.types.resize(kMaxTypes + 1); }),
              HasSubstr("types"));
  EXPECT_THAT(
      refusalOf(examples::welcome(), [](NodeWelcome& welcome) { welcome.objects.resize(kMaxServedObjects + 1); }),
      HasSubstr("objects"));
}

TEST(WireRefusals, Players) {
  const auto spoilt = [](const Spoil<world::Player>& spoil) {
    return worldRefusal([&](WorldUpdate& world) { spoil(world.players[1]); });
  };
  EXPECT_THAT(spoilt([](world::Player& player) { player.pose.position.x = kNan; }), HasSubstr("vector"));
  EXPECT_THAT(spoilt([](world::Player& player) { player.velocity.z = kInfinity; }), HasSubstr("vector"));
  EXPECT_THAT(spoilt([](world::Player& player) { player.pose.yaw = kNan; }), HasSubstr("yaw"));
  EXPECT_THAT(spoilt([](world::Player& player) { player.pose.pitch = 1.51F; }), HasSubstr("pitch"));
  EXPECT_THAT(spoilt([](world::Player& player) { player.pose.pitch = kNan; }), HasSubstr("pitch"));
  EXPECT_THAT(spoilt([](world::Player& player) { player.stride = -1.0F; }), HasSubstr("stride"));
}

TEST(WireRefusals, WorldUpdates) {
  const auto gust = [](const Spoil<world::Gust>& spoil) {
    return worldRefusal([&](WorldUpdate& world) { spoil(world.gusts[0]); });
  };
  EXPECT_THAT(gust([](world::Gust& g) { g.direction = {}; }), HasSubstr("direction"));
  EXPECT_THAT(gust([](world::Gust& g) { g.direction *= 1.01F; }), HasSubstr("direction"));
  EXPECT_THAT(gust([](world::Gust& g) { g.direction.y = kNan; }), HasSubstr("vector"));
  EXPECT_THAT(gust([](world::Gust& g) { g.speed = kInfinity; }), HasSubstr("speed"));
  EXPECT_THAT(gust([](world::Gust& g) { g.reach = -1.0F; }), HasSubstr("reach"));
  EXPECT_THAT(gust([](world::Gust& g) { g.reach = kNan; }), HasSubstr("reach"));
  EXPECT_EQ(gust([](world::Gust& g) { g.speed = g.reach = 100.0F; }), "nothing wrong");
  EXPECT_THAT(gust([](world::Gust& g) { g.speed = 101.0F; }), HasSubstr("speed"));
  EXPECT_THAT(gust([](world::Gust& g) { g.reach = 101.0F; }), HasSubstr("reach"));
  EXPECT_THAT(worldRefusal([](WorldUpdate& world) { world.number = 0; }), HasSubstr("number"));
  EXPECT_THAT(worldRefusal([](WorldUpdate& world) { world.clock = kNan; }), HasSubstr("clock"));
  EXPECT_THAT(worldRefusal([](WorldUpdate& world) { world.sent = kNan; }), HasSubstr("clock"));
  EXPECT_THAT(worldRefusal([](WorldUpdate& world) { world.clock = 1.0e300; }), HasSubstr("clock"));
  EXPECT_THAT(worldRefusal([](WorldUpdate& world) { world.clock = -1.0e300; }), HasSubstr("clock"));
}

TEST(WireRefusals, Cameras) {
  EXPECT_THAT(cameraRefusal([](world::Camera& camera) { camera.width = 0; }), HasSubstr("size"));
  EXPECT_THAT(cameraRefusal([](world::Camera& camera) { camera.width = -1; }), HasSubstr("size"));
  EXPECT_THAT(cameraRefusal([](world::Camera& camera) { camera.height = kMaxCameraSize + 1; }), HasSubstr("size"));
  EXPECT_EQ(cameraRefusal([](world::Camera& camera) { camera.height = kMaxCameraSize; }), "nothing wrong");
  EXPECT_THAT(cameraRefusal([](world::Camera& camera) { camera.verticalFov = 0.0F; }), HasSubstr("field of view"));
  EXPECT_THAT(cameraRefusal([](world::Camera& camera) { camera.verticalFov = 3.1416F; }), HasSubstr("field of view"));
  EXPECT_THAT(cameraRefusal([](world::Camera& camera) { camera.verticalFov = kNan; }), HasSubstr("field of view"));
  EXPECT_THAT(cameraRefusal([](world::Camera& camera) { camera.farDepth = camera.nearDepth; }), HasSubstr("depths"));
  EXPECT_THAT(cameraRefusal([](world::Camera& camera) { camera.farDepth = kInfinity; }), HasSubstr("depths"));
  EXPECT_THAT(cameraRefusal([](world::Camera& camera) { camera.nearDepth = 0.0F; }), HasSubstr("depths"));
}

TEST(WireRefusals, Views) {
  EXPECT_THAT(viewRefusal([](View& view) { view.session = 0; }), HasSubstr("session"));
  EXPECT_THAT(viewRefusal([](View& view) { view.frame = 0; }), HasSubstr("frame"));
  EXPECT_THAT(viewRefusal([](View& view) { view.backdropPose->position.x = kNan; }), HasSubstr("vector"));
  EXPECT_THAT(viewRefusal([](View& view) { view.backdropPose->pitch = 2.0F; }), HasSubstr("pitch"));
  EXPECT_THAT(viewRefusal([](View& view) { view.borderPercent = 101; }), HasSubstr("border"));
  EXPECT_THAT(viewRefusal([](View& view) { view.borderPercent = -1; }), HasSubstr("border"));
  EXPECT_THAT(viewRefusal([](View& view) { view.time = std::numeric_limits<double>::infinity(); }), HasSubstr("time"));
  EXPECT_THAT(viewRefusal([](View& view) { view.time = 1.0e300; }), HasSubstr("time"));
  EXPECT_THAT(viewRefusal([](View& view) { view.time = -1.0e300; }), HasSubstr("time"));
  EXPECT_THAT(viewRefusal([](View& view) { view.deadline = -std::numeric_limits<double>::infinity(); }),
              HasSubstr("deadline"));
  EXPECT_THAT(viewRefusal([](View& view) { view.deadline = std::numeric_limits<double>::quiet_NaN(); }),
              HasSubstr("deadline"));
}

TEST(WireRefusals, Requests) {
  EXPECT_EQ(requestRefusal([](Request& request) { request.key.assign(kMaxKeyBytes, 'k'); }), "nothing wrong");
  EXPECT_THAT(requestRefusal([](Request& request) { request.key.assign(kMaxKeyBytes + 1, 'k'); }), HasSubstr("key"));
  EXPECT_EQ(requestRefusal([](Request& request) { request.rect = {-16384, 16128, 16384, 16384}; }), "nothing wrong");
  EXPECT_THAT(requestRefusal([](Request& request) {
                request.rect = {-16384, 16127, 16384, 16384};
              }),
              HasSubstr("too large"));
  EXPECT_THAT(requestRefusal([](Request& request) {
                request.rect = {-16384, -16384, 16384, 16384};
              }),
              HasSubstr("too large"));
  EXPECT_EQ(requestRefusal([](Request& request) { request.rect = {5, 5, 5, 5}; }), "nothing wrong");
  EXPECT_THAT(requestRefusal([](Request& request) { request.rect = {0, 0, 16385, 1}; }), HasSubstr("rectangle"));
  EXPECT_THAT(requestRefusal([](Request& request) { request.rect = {6, 0, 5, 1}; }), HasSubstr("rectangle"));
  EXPECT_THAT(requestRefusal([](Request& request) { request.rect = {0, 2, 5, 1}; }), HasSubstr("rectangle"));
  EXPECT_THAT(requestRefusal([](Request& request) { request.distance = -1.0F; }), HasSubstr("distance"));
  EXPECT_THAT(requestRefusal([](Request& request) { request.distance = kInfinity; }), HasSubstr("distance"));
  EXPECT_THAT(requestRefusal([](Request& request) { request.subscribe = true; }), HasSubstr("subscribes to pictures"));
  EXPECT_THAT(requestRefusal([](Request& request) { request.player->pose.pitch = kNan; }), HasSubstr("pitch"));
  EXPECT_THAT(requestRefusal([](Request& request) { request.urgency = kNan; }), HasSubstr("urgency"));
  EXPECT_THAT(requestRefusal([](Request& request) { request.urgency = -1.0F; }), HasSubstr("urgency"));
}

TEST(WireRefusals, ViewsOfRequests) {
  EXPECT_THAT(requestRefusal([](Request& request) { request.view = nullptr; }), HasSubstr("session"));
  EXPECT_EQ(requestRefusal([](Request& request) {
              View other = examples::view();
              other.frame = 42;
              request.view = std::make_shared<View>(other);
            }),
            "request: the view of session 3/8, frame 42, is unknown");
  EXPECT_EQ(requestRefusal([](Request& request) {
              View other = examples::view();
              other.frame = 43;
              request.eye = std::make_shared<View>(other);
            }),
            "request: the view of session 3/8, frame 43, is unknown");
}

TEST(WireRefusals, CancelQualityForget) {
  EXPECT_THAT(refusal(ToBackend(Cancel{.session = 0, .frame = 1})), HasSubstr("session"));
  EXPECT_THAT(refusal(ToBackend(Cancel{.session = 1, .frame = 0})), HasSubstr("frame"));
  EXPECT_THAT(refusal(ToBackend(Quality{.step = 3})), HasSubstr("step"));
  EXPECT_THAT(refusal(ToBackend(Quality{.step = -1})), HasSubstr("step"));
  EXPECT_THAT(refusal(ToBackend(Forget{.session = 0})), HasSubstr("session"));
}

TEST(WireRefusals, Bounds) {
  const auto spoilt = [](const world::Bounds& bounds) {
    return refusalOf(examples::welcome(), [&](NodeWelcome& welcome) { welcome.objects[0].bounds = bounds; });
  };
  EXPECT_THAT(spoilt({world::Vec3(0.0F), world::Vec3(kInfinity)}), HasSubstr("vector"));
  EXPECT_THAT(spoilt({{0.0F, 1.0F, 0.0F}, {1.0F, 0.0F, 1.0F}}), HasSubstr("bounds"));
  const auto spoiltVisitors = [](const world::Bounds& bounds) {
    return refusalOf(examples::welcome(), [&](NodeWelcome& welcome) { welcome.visitors->bounds = bounds; });
  };
  EXPECT_THAT(spoiltVisitors({world::Vec3(0.0F), world::Vec3(kInfinity)}), HasSubstr("vector"));
  EXPECT_THAT(spoiltVisitors({{0.0F, 1.0F, 0.0F}, {1.0F, 0.0F, 1.0F}}), HasSubstr("bounds"));
}

/// Would catch a node that pushes visitors out of the world.
TEST(WireRefusals, Obstacles) {
  const auto spoilt = [](float radius) {
    return refusalOf(examples::welcome(), [&](NodeWelcome& welcome) { welcome.objects[0].obstacleRadius = radius; });
  };
  EXPECT_EQ(spoilt(kMaxObstacleRadius), "nothing wrong");
  EXPECT_THAT(spoilt(kMaxObstacleRadius * 2.0F), HasSubstr("radius"));
  EXPECT_THAT(spoilt(-0.1F), HasSubstr("radius"));
  EXPECT_THAT(spoilt(kNan), HasSubstr("radius"));
}

TEST(WireRefusals, Results) {
  EXPECT_THAT(refusalOf(examples::picture(), [](Result& result) { result.session = 0; }), HasSubstr("session"));
  EXPECT_THAT(refusalOf(examples::picture(), [](Result& result) { result.frame = 0; }), HasSubstr("frame"));
  EXPECT_THAT(refusalOf(examples::sharedData(),
                        [](Result& result) {
                          result.session = 0;
                          result.frame = 3;
                        }),
              HasSubstr("session"));
  EXPECT_THAT(refusalOf(examples::nothing(), [](Result& result) { result.shared = true; }), HasSubstr("picture"));
  EXPECT_THAT(refusalOf(examples::picture(), [](Result& result) { result.what.key.assign(kMaxKeyBytes + 1, 'k'); }),
              HasSubstr("key"));
}

TEST(WireRefusals, UnexpectedBulk) {
  for (const ToFrontend& message : examples::toFrontend()) {
    Packet packet = encode(message);
    packet.bulk = packet.bulk ? nullptr : examples::bulk();
    EXPECT_THAT(reasonOf(decodeToFrontend(packet)), HasSubstr("bytes"));
  }
}

}  // namespace
}  // namespace grove::node

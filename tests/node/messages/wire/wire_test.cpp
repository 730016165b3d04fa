#include "node/messages/wire/wire.h"

#include <gtest/gtest.h>

#include "node/messages/examples.h"

namespace grove::node {
namespace {

std::string hex(std::string_view bytes) {
  constexpr std::string_view kDigits = "0123456789abcdef";
  std::string text;
  text.reserve(2 * bytes.size());
  for (const char c : bytes) {
    const auto byte = static_cast<unsigned char>(c);
    text.push_back(kDigits[byte >> 4U]);
    text.push_back(kDigits[byte & 15U]);
  }
  return text;
}

template <class Message>
Message afterTravel(const Message& message) {
  auto decoded = [&] {
    if constexpr (std::is_constructible_v<ToBackend, Message>) {
      return decodeToBackend(encode(ToBackend(message)).header, examples::knownView());
    } else {
      return decodeToFrontend(encode(ToFrontend(message)));
    }
  }();
  if (const auto* error = std::get_if<WireError>(&decoded)) {
    ADD_FAILURE() << error->reason;
    return {};
  }
  return std::get<Message>(std::get<0>(decoded));
}

template <class Message>
Message afterTravelByPointer(const Message& message) {
  const auto got = afterTravel(std::shared_ptr<const Message>(std::make_shared<Message>(message)));
  return got ? *got : Message{};
}

void expectSame(const world::Pose& a, const world::Pose& b) {
  EXPECT_EQ(a.position, b.position);
  EXPECT_EQ(a.yaw, b.yaw);
  EXPECT_EQ(a.pitch, b.pitch);
}

void expectSame(const world::Player& a, const world::Player& b) {
  EXPECT_EQ(a.id, b.id);
  EXPECT_EQ(a.name, b.name);
  EXPECT_EQ(a.colour, b.colour);
  expectSame(a.pose, b.pose);
  EXPECT_EQ(a.velocity, b.velocity);
  EXPECT_TRUE(std::signbit(a.velocity.y));
  EXPECT_EQ(a.stride, b.stride);
  EXPECT_EQ(a.lastInput, b.lastInput);
  EXPECT_EQ(a.keys, b.keys);
}

/// Would catch two visitors of one world whom a page takes for one.
TEST(Ids, VisitorsOfOtherProcessesDiffer) {
  EXPECT_EQ(shortIdOf(makeId(7, 3), 7), 3U);
  EXPECT_NE(shortIdOf(makeId(8, 3), 7), 3U);
  EXPECT_NE(shortIdOf(makeId(8, 3), 7), shortIdOf(makeId(8, 4), 7));
  EXPECT_NE(shortIdOf(makeId(8, 3), 7), shortIdOf(makeId(9, 3), 7));
  EXPECT_GE(shortIdOf(makeId(8, 3), 7), 1U << 31U) << "no process has so many";
}

TEST(Wire, CarriesHello) {
  const NodeHello sent = examples::hello();
  const NodeHello got = afterTravel(sent);
  EXPECT_EQ(got.protocol, sent.protocol);
  EXPECT_EQ(got.build, sent.build);
  EXPECT_EQ(got.sceneHash, sent.sceneHash);
  EXPECT_EQ(got.process, sent.process);
  ASSERT_EQ(got.types.size(), 2u);
  EXPECT_EQ(got.types[1].id, 5u);
  EXPECT_EQ(got.types[1].name, "lightfield");
}

TEST(Wire, CarriesHelloOfAnyProtocol) {
  NodeHello sent = examples::hello();
  sent.protocol = 77;
  EXPECT_EQ(afterTravel(sent).protocol, 77u);
}

TEST(Wire, CarriesWelcomeAndRefusal) {
  const NodeWelcome sent = examples::welcome();
  const NodeWelcome got = afterTravel(sent);
  EXPECT_EQ(got.protocol, sent.protocol);
  EXPECT_EQ(got.build, sent.build);
  EXPECT_EQ(got.sceneHash, sent.sceneHash);
  EXPECT_EQ(got.epoch, sent.epoch);
  ASSERT_TRUE(got.visitors);
  EXPECT_EQ(got.visitors->bounds.high, (world::Vec3{0.5F, 2.0F, 0.5F}));
  EXPECT_TRUE(got.visitors->hasOwnBody);
  EXPECT_TRUE(got.visitors->castsShadow);
  EXPECT_EQ(got.objects[0].obstacleRadius, 0.4F);
  ASSERT_EQ(got.objects.size(), 2u);
  EXPECT_EQ(got.objects[0].id, 9u);
  EXPECT_EQ(got.objects[0].type, 5u);
  EXPECT_EQ(got.objects[0].name, "oak");
  EXPECT_EQ(got.objects[0].bounds.low, sent.objects[0].bounds.low);
  EXPECT_EQ(got.objects[0].bounds.high, sent.objects[0].bounds.high);
  EXPECT_TRUE(got.objects[1].bounds.empty());
  EXPECT_EQ(afterTravel(NodeRefusal{"another scene"}).reason, "another scene");
}

void expectSame(const WorldUpdate& got, const WorldUpdate& sent) {
  EXPECT_EQ(got.number, sent.number);
  EXPECT_EQ(got.clock, sent.clock);
  EXPECT_EQ(got.sent, sent.sent);
  ASSERT_EQ(got.players.size(), 2u);
  expectSame(got.players[1], sent.players[1]);
  ASSERT_EQ(got.gusts.size(), 1u);
  EXPECT_EQ(got.gusts[0].origin, sent.gusts[0].origin);
  EXPECT_EQ(got.gusts[0].direction, sent.gusts[0].direction);
  EXPECT_EQ(got.gusts[0].speed, sent.gusts[0].speed);
  EXPECT_EQ(got.gusts[0].reach, sent.gusts[0].reach);
  EXPECT_EQ(got.gusts[0].visitor, sent.gusts[0].visitor);
}

TEST(Wire, CarriesWorldUpdatesBothWays) {
  const WorldUpdate sent = examples::world();
  expectSame(afterTravelByPointer(sent), sent);
  const auto back = decodeToFrontend(encode(ToFrontend(std::make_shared<const WorldUpdate>(sent))));
  expectSame(*std::get<std::shared_ptr<const WorldUpdate>>(std::get<ToFrontend>(back)), sent);
}

TEST(Wire, CarriesView) {
  const View sent = examples::view();
  const View got = afterTravelByPointer(sent);
  EXPECT_EQ(got.session, sent.session);
  EXPECT_EQ(got.frame, sent.frame);
  EXPECT_EQ(got.viewer, sent.viewer);
  EXPECT_EQ(got.lastInput, sent.lastInput);
  expectSame(got.camera.pose, sent.camera.pose);
  EXPECT_EQ(got.camera.width, sent.camera.width);
  EXPECT_EQ(got.camera.height, sent.camera.height);
  EXPECT_EQ(got.camera.verticalFov, sent.camera.verticalFov);
  EXPECT_EQ(got.camera.nearDepth, sent.camera.nearDepth);
  EXPECT_EQ(got.camera.farDepth, sent.camera.farDepth);
  EXPECT_EQ(got.backdropPose, sent.backdropPose);
  EXPECT_EQ(got.borderPercent, sent.borderPercent);
  EXPECT_EQ(got.time, sent.time);
  EXPECT_EQ(got.deadline, sent.deadline);
  EXPECT_EQ(got.visitors, 3u);
  ASSERT_EQ(got.lights.size(), 1u);
  EXPECT_EQ(got.lights[0].position, sent.lights[0].position);
  EXPECT_EQ(got.lights[0].colour, sent.lights[0].colour);
}

/// Would catch players who travel in the views of all visitors, as well as in the updates of the world.
TEST(Wire, ViewSizeDoesNotDependOnVisitors) {
  View view = examples::view();
  const std::size_t alone = encode(ToBackend(std::make_shared<const View>(view))).bytes();
  view.players.assign(100, examples::player());
  EXPECT_EQ(encode(ToBackend(std::make_shared<const View>(view))).bytes(), alone);
}

TEST(Wire, CarriesRequestAndFindsItsView) {
  const Request sent = examples::request();
  const Request got = afterTravel(sent);
  ASSERT_TRUE(got.view);
  EXPECT_EQ(got.view->session, examples::kSession);
  EXPECT_EQ(got.view->frame, examples::kFrame);
  EXPECT_EQ(got.process, sent.process);
  EXPECT_EQ(got.slot, sent.slot);
  EXPECT_EQ(got.object, sent.object);
  ASSERT_TRUE(got.player);
  expectSame(*got.player, *sent.player);
  EXPECT_FALSE(got.shared);
  EXPECT_EQ(got.key, sent.key);
  EXPECT_EQ(got.rect, sent.rect);
  EXPECT_EQ(got.distance, sent.distance);
  EXPECT_EQ(got.urgency, sent.urgency);
  EXPECT_EQ(got.known, sent.known);
}

TEST(Wire, FindsTheViewOfAPicture) {
  Request sent = examples::request();
  EXPECT_FALSE(afterTravel(sent).eye);
  sent.eye = sent.view;
  const Request got = afterTravel(sent);
  ASSERT_TRUE(got.eye);
  EXPECT_EQ(got.eye->frame, examples::kFrame);
  EXPECT_EQ(&got.seenBy(), got.eye.get());
  EXPECT_EQ(got.seenBy().camera.pose, *examples::view().backdropPose) << "who draws a backdrop sees it from there";
  EXPECT_EQ(got.view->camera.pose, examples::view().camera.pose);
}

TEST(Wire, CarriesRequestForSharedDataWithoutView) {
  Request sent = examples::request();
  sent.view = nullptr;
  sent.process = 7;
  sent.shared = true;
  sent.urgency = 0.25F;
  sent.player.reset();
  const Request got = afterTravel(sent);
  EXPECT_FALSE(got.view);
  EXPECT_TRUE(got.shared);
  EXPECT_EQ(got.process, 7u);
  EXPECT_EQ(got.urgency, 0.25F);
  EXPECT_FALSE(got.player);
}

TEST(Wire, SharedDataNeedsNoView) {
  Request sent = examples::request();
  sent.shared = true;
  const auto decoded = decodeToBackend(encode(sent).header, [](SessionId, FrameNumber) { return nullptr; });
  ASSERT_TRUE(std::holds_alternative<ToBackend>(decoded));
  EXPECT_FALSE(std::get<Request>(std::get<ToBackend>(decoded)).view);
}

TEST(Wire, CarriesCancelQualityAndForget) {
  const Cancel cancel = afterTravel(Cancel{.session = examples::kSession, .frame = 7});
  EXPECT_EQ(cancel.session, examples::kSession);
  EXPECT_EQ(cancel.frame, 7u);
  EXPECT_EQ(afterTravel(Quality{.step = 2}).step, 2);
  EXPECT_EQ(afterTravel(Forget{.session = examples::kSession}).session, examples::kSession);
}

TEST(Wire, CarriesResultsBesideTheirBytes) {
  const Result sent = examples::picture();
  const Result picture = afterTravel(sent);
  EXPECT_EQ(picture.session, sent.session);
  EXPECT_EQ(picture.frame, sent.frame);
  EXPECT_EQ(picture.slot, sent.slot);
  EXPECT_EQ(picture.what, sent.what);
  EXPECT_FALSE(picture.shared);
  EXPECT_EQ(picture.packed, sent.packed) << "copied";
  const Result sharedData = examples::sharedData();
  const Result data = afterTravel(sharedData);
  EXPECT_TRUE(data.shared);
  EXPECT_EQ(data.session, makeId(3, 0));
  EXPECT_EQ(data.version, 9u);
  EXPECT_EQ(data.packed, sharedData.packed) << "copied";
}

TEST(Wire, CarriesFailuresAndNothing) {
  const Result failure = afterTravel(examples::failure());
  EXPECT_EQ(std::get<Failure>(failure.payload).reason, "no memory");
  EXPECT_TRUE(std::get<Failure>(failure.payload).notNow);
  const Result nothing = afterTravel(examples::nothing());
  EXPECT_FALSE(nothing.packed);
  EXPECT_FALSE(std::get<std::shared_ptr<const raster::Image>>(nothing.payload));
}

TEST(Wire, ReasonsAreSanitized) {
  Result sent = examples::failure();
  sent.payload = Failure{"bad \xFF" + std::string(2000, 'a'), false};
  const std::string reason = std::get<Failure>(afterTravel(sent).payload).reason;
  EXPECT_EQ(reason.size(), kMaxReasonBytes);
  EXPECT_TRUE(reason.starts_with("bad ?aaa"));
}

TEST(Wire, CarriesAnnouncement) {
  const Announcement got = afterTravel(Announcement{.what = {.object = 4, .key = "map"}, .version = 2});
  EXPECT_EQ(got.what, (SharedKey{4, "map"}));
  EXPECT_EQ(got.version, 2u);
}

TEST(Wire, CarriesSubscriptions) {
  const Request request = afterTravel(examples::subscription());
  EXPECT_TRUE(request.subscribe);
  EXPECT_EQ(request.known, 4u);
  EXPECT_FALSE(afterTravel(examples::request()).subscribe);
  EXPECT_TRUE(afterTravel(examples::pushed()).pushed);
  EXPECT_FALSE(afterTravel(examples::sharedData()).pushed);
  const Acknowledgement acknowledged = afterTravel(Acknowledgement{.what = {.object = 4, .key = "map"}, .version = 7});
  EXPECT_EQ(acknowledged.what, (SharedKey{4, "map"}));
  EXPECT_EQ(acknowledged.version, 7u);
  EXPECT_EQ(afterTravel(Unsubscribe{.what = {.object = 4, .key = "map"}}).what, (SharedKey{4, "map"}));
}

TEST(Wire, HelloIsGolden) {
  EXPECT_EQ(hex(encode(ToBackend(examples::hello())).header),
            "0a2b08011205302e322e3019efcdab896745230120032a051203736b792a0e0805120a6c696768746669656c64");
}

TEST(Wire, RequestIsGolden) {
  Request request = examples::request();
  request.player.reset();
  EXPECT_EQ(hex(encode(ToBackend(request)).header),
            "22360908000000030000001029180621d204000000000000320663656c6c00ff3a0a0809101418d8042090034500008c414d0000e0"
            "3f5804");
}

}  // namespace
}  // namespace grove::node

#pragma once

#include <memory>
#include <string>
#include <vector>

#include "node/messages/wire/wire.h"

/// One of each message, with no field as it is by default.
namespace grove::node::examples {

inline constexpr SessionId kSession = makeId(3, 8);
inline constexpr FrameNumber kFrame = 41;

inline world::Player player() {
  return {.id = makeId(3, 5),
          .name = "Zo\xC3\xAB",
          .colour = 0x00804020U,
          .pose = {.position = {1.5F, 1.7F, -0.1F}, .yaw = 7.25F, .pitch = -0.3F},
          .velocity = {0.1F, -0.0F, 2.2F},
          .stride = 12.3F,
          .lastInput = 99,
          .keys = 255};
}

inline world::Gust gust() {
  return {.origin = {1.0F, 2.0F, 3.0F}, .direction = {0.6F, 0.0F, -0.8F}, .speed = 6.5F, .reach = 9.5F, .visitor = 7};
}

inline NodeHello hello() {
  return {.protocol = 1,
          .build = "0.2.0",
          .sceneHash = 0x0123456789ABCDEFU,
          .process = 3,
          .types = {{.id = 0, .name = "sky"}, {.id = 5, .name = "lightfield"}}};
}

inline WorldUpdate world() {
  return {.number = 17, .clock = 3.3, .sent = 4.4, .players = {player(), player()}, .gusts = {gust()}};
}

inline world::PointLight light() { return {.position = {3.0F, 0.5F, -2.0F}, .colour = {1.5F, 0.75F, 0.25F}}; }

inline View view() {
  View view;
  view.session = kSession;
  view.frame = kFrame;
  view.viewer = makeId(3, 5);
  view.lastInput = 98;
  view.camera = {
      .pose = player().pose, .width = 640, .height = 360, .verticalFov = 1.1F, .nearDepth = 0.2F, .farDepth = 900.0F};
  view.backdropPose = {.position = {1.0F, 2.0F, 3.5F}, .yaw = 0.5F, .pitch = -0.25F};
  view.borderPercent = 12;
  view.time = 4.4;
  view.visitors = 3;
  view.lights = {light()};
  return view;
}

inline Request request() {
  return {.view = std::make_shared<View>(view()),
          .process = 3,
          .slot = 6,
          .object = 1234,
          .shared = false,
          .player = player(),
          .key = std::string("cell\0\xFF", 6),
          .rect = {-5, 10, 300, 200},
          .distance = 17.5F,
          .urgency = 1.75F,
          .known = 4};
}

inline std::shared_ptr<const PackedBytes> bulk() { return std::make_shared<PackedBytes>(100, std::byte{7}); }

inline Result picture() {
  return {.session = kSession,
          .frame = kFrame,
          .slot = 6,
          .what = {.object = 1234, .key = "key"},
          .shared = false,
          .version = 0,
          .payload = std::shared_ptr<const raster::Image>(),
          .packed = bulk()};
}

inline Result sharedData() {
  return {.session = makeId(3, 0),
          .frame = 0,
          .slot = 0,
          .what = {.object = 1234, .key = "key"},
          .shared = true,
          .version = 9,
          .payload = std::shared_ptr<const SharedData>(),
          .packed = bulk()};
}

inline Request subscription() {
  Request request = examples::request();
  request.view = nullptr;
  request.shared = true;
  request.subscribe = true;
  return request;
}

inline Result pushed() {
  Result result = sharedData();
  result.pushed = true;
  return result;
}

inline Result failure() {
  return {.session = kSession,
          .frame = kFrame,
          .slot = 6,
          .what = {.object = 1, .key = {}},
          .shared = false,
          .version = 0,
          .payload = Failure{"no memory", true}};
}

inline Result nothing() {
  return {.session = kSession,
          .frame = kFrame,
          .slot = 6,
          .what = {.object = 1, .key = {}},
          .shared = false,
          .version = 0,
          .payload = {}};
}

inline NodeWelcome welcome() {
  return {.protocol = 1,
          .build = "0.2.0",
          .sceneHash = 5,
          .epoch = 0xFEDCBA9876543210U,
          .objects = {{.id = 9,
                       .type = 5,
                       .name = "oak",
                       .bounds = {{-1.0F, 0.0F, -1.0F}, {1.0F, 8.0F, 1.0F}},
                       .obstacleRadius = 0.4F},
                      {.id = 10, .type = 0, .name = "", .bounds = {}}},
          .visitors = ServedVisitors{
              .bounds = {{-0.5F, 0.0F, -0.5F}, {0.5F, 2.0F, 0.5F}}, .hasOwnBody = true, .castsShadow = true}};
}

inline NodeReport report() {
  return {.sent = 5.5,
          .residentBytes = 129'000'000,
          .stages = {{"Renderer",
                      {.work = pipeline::Work::kPerUserBackend,
                       .runs = 40,
                       .failures = 2,
                       .wallNanoseconds = 7'000'000,
                       .cpuNanoseconds = 6'500'000}},
                     {"Shared View", {.work = pipeline::Work::kOnDemand, .runs = 12}},
                     {"Simulation Tick", {.work = pipeline::Work::kAcrossUser, .runs = 30}}},
          .memory = {{{"view cache", "lightfield"}, {.work = pipeline::Work::kOnDemand, .bytes = 1'000'000}},
                     {{"targets", ""}, {.work = pipeline::Work::kPerUserBackend, .bytes = 5}}}};
}

/// The second run begins before the first, as one that is recorded when it ends.
inline NodeTrace trace() {
  return {.number = 4,
          .names = {"Renderer", "", "fluid", "Simulation Tick"},
          .runs = {{.stage = 0,
                    .subject = 2,
                    .work = pipeline::Work::kPerUserBackend,
                    .tag = {1, kFrame, 3},
                    .thread = 2,
                    .part = true,
                    .beginNanoseconds = 5'000'000'000'000,
                    .wallNanoseconds = 1'500'000,
                    .cpuNanoseconds = 1'400'000},
                   {.stage = 3,
                    .subject = 1,
                    .tag = {},
                    .thread = 4,
                    .beginNanoseconds = 4'999'990'000'000,
                    .wallNanoseconds = 12'000'000,
                    .cpuNanoseconds = 11'000'000}}};
}

inline std::vector<ToBackend> toBackend() {
  return {hello(),
          std::make_shared<const WorldUpdate>(world()),
          std::make_shared<const View>(view()),
          request(),
          Cancel{.session = kSession, .frame = kFrame},
          Quality{.step = 2},
          Forget{.session = kSession},
          subscription(),
          Acknowledgement{.what = {.object = 4, .key = "map"}, .version = 7},
          Unsubscribe{.what = {.object = 4, .key = "map"}},
          TraceRequest{.number = 4}};
}

inline std::vector<ToFrontend> toFrontend() {
  return {welcome(),
          NodeRefusal{"another scene"},
          picture(),
          sharedData(),
          pushed(),
          failure(),
          nothing(),
          Announcement{.what = {.object = 4, .key = "map"}, .version = 2},
          std::make_shared<const WorldUpdate>(world()),
          report(),
          std::make_shared<const NodeTrace>(trace())};
}

/// Knows the view of the examples only.
inline ViewLookup knownView() {
  return [known = std::make_shared<const View>(view())](SessionId session, FrameNumber frame) {
    return session == kSession && frame == kFrame ? known : nullptr;
  };
}

}  // namespace grove::node::examples

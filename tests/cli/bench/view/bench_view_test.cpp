#include "cli/bench/view/bench_view.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <nlohmann/json.hpp>
#include <string>

#include "cli/bench/view/bench_view_report.h"
#include "cli/bench/view/view_layers.h"
#include "cli/program.h"
#include "cli/small_scene.h"

namespace grove::cli {
namespace {

using pipeline::Work;
using testing::HasSubstr;

constexpr measure::Served kOneVisitor{.visitors = 1.0, .frames = 10.0};

pipeline::StageTotal totalOf(Work work, int milliseconds) {
  return {.work = work, .runs = 10, .cpuNanoseconds = std::int64_t{1'000'000} * milliseconds};
}

TEST(BenchView, LayersAddUpToTheFrame) {
  measure::Reading before;
  before.costs[{"Renderer", "mesh"}] = totalOf(Work::kPerUserBackend, 7);
  measure::Reading after;
  after.costs[{"Renderer", "mesh"}] = totalOf(Work::kPerUserBackend, 27);
  after.costs[{"Compressor", "mesh"}] = totalOf(Work::kPerUserBackend, 5);
  after.costs[{"Compositor", "mesh"}] = totalOf(Work::kPerUserFrontend, 15);
  after.costs[{"Compositor", "sky"}] = totalOf(Work::kPerUserFrontend, 3);
  after.costs[{"Compositor", ""}] = totalOf(Work::kPerUserFrontend, 4);
  after.costs[{"Request Receiver", ""}] = totalOf(Work::kPerUserBackend, 1);
  after.costs[{"Encoder", ""}] = totalOf(Work::kPerUserFrontend, 20);
  after.costs[{"Fluid Simulation", "fluid"}] = totalOf(Work::kAcrossUser, 100);
  after.costs[{"Shared View", "sky"}] = totalOf(Work::kOnDemand, 100);

  const auto layers = layersOf(before, after, kOneVisitor);
  EXPECT_EQ(layers.size(), 5u) << "what is shared is in none";
  EXPECT_DOUBLE_EQ(layers.at("mesh"), 4.0);
  EXPECT_DOUBLE_EQ(layers.at("sky"), 0.3);
  EXPECT_DOUBLE_EQ(layers.at("Compositor"), 0.4);
  EXPECT_DOUBLE_EQ(layers.at("Request Receiver"), 0.1);
  EXPECT_DOUBLE_EQ(layers.at("JPEG"), 2.0);
  double all = 0.0;
  for (const auto& [name, milliseconds] : layers) all += milliseconds;
  const measure::FrameCost cost = sum(measure::frameCosts(before, after, kOneVisitor));
  EXPECT_DOUBLE_EQ(all, cost.perUser() - cost.onDemandOwn);
}

TEST(BenchView, UnmeasuredFieldsAreNull) {
  ViewReport report;
  report.walk = "nowhere";
  report.size = {320, 180};
  report.interrupted = true;
  const auto document = nlohmann::json::parse(viewJson(report));
  for (const char* key : {"cpu_ms_per_frame", "cpu_ms_per_frame_in_loop", "cpu_ms_per_frame_whole", "bytes_per_frame",
                          "flicker", "flicker_reference"}) {
    EXPECT_TRUE(document.at(key).is_null()) << key;
  }
  EXPECT_TRUE(document.at("psnr_db").at("mean").is_null());
  EXPECT_TRUE(document.at("psnr_db").at("worst").is_null());
  EXPECT_TRUE(document.at("layers").empty());
  EXPECT_EQ(document.at("interrupted"), true);
}

TEST(BenchView, PrintsItsDocument) {
  const SmallScene scene;
  const Outcome outcome =
      grove("bench view --seconds 1 --size 320x180 --json --walk " GROVE_WALKS "/clearing.walk --scene " + scene.path(),
            false);
  ASSERT_EQ(outcome.exit, 0);
  const auto report = nlohmann::json::parse(outcome.output);
  EXPECT_THAT(report.at("walk").get<std::string>(), HasSubstr("clearing.walk"));
  EXPECT_EQ(report.at("size"), "320x180");
  EXPECT_EQ(report.at("frames"), 30);
  EXPECT_EQ(report.at("interrupted"), false);
  EXPECT_GT(report.at("cpu_ms_per_frame"), 0.0);
  EXPECT_GT(report.at("cpu_ms_per_frame_in_loop"), 0.0);
  EXPECT_GT(report.at("cpu_ms_per_frame_whole"), 0.0);
  EXPECT_GT(report.at("layers_whole").at("mesh"), 2.0 * report.at("layers").at("mesh").get<double>())
      << "meshes came from a backdrop";
  const auto& bytes = report.at("bytes_per_frame");
  if (!bytes.is_null()) {
    EXPECT_GT(bytes, 320 * 180 * 4) << "a frame's own pixels, and more";
  }
  const auto& layers = report.at("layers");
  double all = 0.0;
  for (const auto& [name, milliseconds] : layers.items()) all += milliseconds.get<double>();
  EXPECT_NEAR(all, report.at("cpu_ms_per_frame").get<double>(), 0.005);
  for (const char* layer : {"mesh", "fluid", "JPEG", "Scene Analyzer"}) EXPECT_TRUE(layers.contains(layer)) << layer;
  EXPECT_GE(report.at("psnr_db").at("mean"), report.at("psnr_db").at("worst"));
  EXPECT_GT(report.at("psnr_db").at("worst"), 20.0);
  for (const char* key : {"flicker", "flicker_reference"}) {
    EXPECT_GE(report.at(key), 0.0) << key;
    EXPECT_LE(report.at(key), 1.0) << key;
  }
}

TEST(BenchView, InterruptedRunPrintsWhatItMeasured) {
  const SmallScene scene;
  const Outcome outcome =
      groveStoppedAfter(5.0, "bench view --seconds 60 --size 160x90 --json --scene " + scene.path());
  EXPECT_EQ(outcome.exit, 0);
  const auto report = nlohmann::json::parse(outcome.output);
  EXPECT_EQ(report.at("interrupted"), true);
  EXPECT_TRUE(report.at("bytes_per_frame").is_null());
}

TEST(BenchView, ReportsMarginalCostOfStandingVisitors) {
  const SmallScene scene;
  const Outcome outcome =
      grove("bench view --stand --visitors 3 --seconds 0.5 --size 320x180 --json --scene " + scene.path(), false);
  ASSERT_EQ(outcome.exit, 0);
  const auto report = nlohmann::json::parse(outcome.output);
  EXPECT_EQ(report.at("visitors"), 3);
  EXPECT_EQ(report.at("frames"), 3 * 15);
  EXPECT_EQ(report.at("interrupted"), false);
  double layers = 0.0;
  for (const auto& [name, milliseconds] : report.at("layers").items()) layers += milliseconds.get<double>();
  EXPECT_GT(report.at("layers").at("JPEG"), 0.0);
  EXPECT_GT(report.at("cpu_ms_per_frame"), 0.8 * layers) << "of the whole process, by another clock";
  EXPECT_GT(report.at("bytes_per_visitor"), 320 * 180 * 4) << "a frame's own pixels, and more";
}

// Fault: pictures of a busy server are compared with themselves, or not enlarged.
TEST(BenchView, ComparesWithExactPictures) {
  const SmallScene scene;
  const auto decibels = [&](const std::string& options) {
    const Outcome outcome =
        grove("bench view --exact --seconds 1 --size 320x180 --json --walk " GROVE_WALKS "/clearing.walk --scene " +
                  scene.path() + options,
              false);
    EXPECT_EQ(outcome.exit, 0);
    const auto report = nlohmann::json::parse(outcome.output);
    EXPECT_LE(report.at("psnr_db").at("worst"), report.at("psnr_db").at("mean"));
    return report.at("psnr_db").at("mean").get<double>();
  };
  EXPECT_GT(decibels(" --lines 180"), decibels(" --busy 1 --lines 90") + 1.0);
}

TEST(BenchView, ReportsAMissingWalkFirst) {
  const Outcome outcome = grove("bench view --walk no/such.walk --scene no/such/file.toml");
  EXPECT_EQ(outcome.exit, 1);
  EXPECT_THAT(outcome.output, HasSubstr("no/such.walk"));
}

}  // namespace
}  // namespace grove::cli

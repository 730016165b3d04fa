#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <unistd.h>

#include <filesystem>
#include <fstream>
#include <nlohmann/json.hpp>
#include <string>

#include "cli/program.h"
#include "cli/small_scene.h"
#include "measure/trace_faults.h"
#include "sanitized.h"

namespace grove::cli {
namespace {

using testing::HasSubstr;
using testing::StartsWith;

TEST(BenchCommand, FluidPrintsItsDocument) {
  const Outcome outcome = grove("bench fluid --grid 16 --steps 3 --threads 1 --json", false);
  EXPECT_EQ(outcome.exit, 0);
  EXPECT_THAT(outcome.output, StartsWith("{"));
  for (const char* key : {"\"grid\"", "\"threads\"", "\"steps\"", "\"obstacle_cells\"", "\"cpu_ms_per_step\"",
                          "\"wall_ms_per_step\"", "\"residual\"", "\"max_divergence\"", "\"phases\""}) {
    EXPECT_THAT(outcome.output, HasSubstr(key));
  }
}

TEST(BenchCommand, PipelinePrintsARowPerFramesInFlight) {
  const SmallScene scene;
  const auto traceFile = std::filesystem::temp_directory_path() / ("grove_trace_" + std::to_string(getpid()) + ".json");
  const Outcome outcome = grove("bench pipeline --frames-in-flight 3,1 --users 2 --size 320x180 --seconds " +
                                    std::string(kSanitized ? "3" : "0.5") + " --scene " + scene.path() +
                                    " --json --trace " + traceFile.string(),
                                false);
  ASSERT_EQ(outcome.exit, 0);
  const auto report = nlohmann::json::parse(outcome.output);
  EXPECT_EQ(report.at("scene"), "stones");
  EXPECT_EQ(report.at("users"), 2);
  EXPECT_EQ(report.at("size"), "320x180");
  EXPECT_GE(report.at("cores"), 1);
  EXPECT_GE(report.at("frames_per_second_limit"), 120);
  EXPECT_EQ(report.at("interrupted"), false);
  ASSERT_EQ(report.at("rows").size(), 2u);
  EXPECT_EQ(report.at("rows").at(0).at("frames_in_flight"), 3);
  EXPECT_EQ(report.at("rows").at(1).at("frames_in_flight"), 1);
  for (const auto& row : report.at("rows")) {
    EXPECT_GE(row.at("seconds"), 0.5);
    EXPECT_GT(row.at("frames"), 0);
    EXPECT_GT(row.at("frames_per_second"), 0.0);
    EXPECT_GT(row.at("overlap"), 0.0);
    EXPECT_GT(row.at("latency_ms").at("p50"), 0.0);
    EXPECT_GE(row.at("latency_ms").at("p99"), row.at("latency_ms").at("p50"));
    const auto& stages = row.at("stages");
    EXPECT_TRUE(stages.contains(row.at("bottleneck").get<std::string>()));
    for (const char* stage : {"Scene Analyzer", "Frame Planner", "Request Receiver", "Renderer", "Compressor",
                              "Result Sender", "Result Receiver", "Decompressor", "Compositor", "Encoder"}) {
      ASSERT_TRUE(stages.contains(stage)) << stage;
      for (const char* key : {"runs", "wall_ms_per_run", "cpu_ms_per_run", "utilisation"}) {
        EXPECT_TRUE(stages.at(stage).contains(key)) << stage << " " << key;
      }
      EXPECT_LE(stages.at(stage).at("utilisation"), 1.0);
    }
    EXPECT_TRUE(stages.at("Compositor").at("types").contains("fluid"));
  }
  std::ifstream file(traceFile);
  const auto trace = nlohmann::json::parse(file);
  std::filesystem::remove(traceFile);
  EXPECT_EQ(measure::traceFault(trace), "");
  EXPECT_EQ(trace.at("traceEvents").at(0).at("args").at("name"), "3 frames in flight");
}

TEST(BenchCommand, InterruptedPipelinePrintsFinishedRows) {
  const SmallScene scene;
  const Outcome outcome =
      groveStoppedAfter(5.0, "bench pipeline --seconds 60 --size 160x90 --json --scene " + scene.path());
  EXPECT_EQ(outcome.exit, 0);
  const auto report = nlohmann::json::parse(outcome.output);
  EXPECT_EQ(report.at("interrupted"), true);
  EXPECT_LE(report.at("rows").size(), 1u);
}

}  // namespace
}  // namespace grove::cli

#include "cli/bench_commands.h"

#include <CLI/CLI.hpp>

#include "cli/bench/fluid/bench_fluid_solvers.h"
#include "cli/bench/link_report.h"
#include "cli/bench/picture_size.h"
#include "cli/options/choose.h"
#include "node/limits.h"

namespace grove::cli {
namespace {

void addTransport(CLI::App* bench, node::TransportKind& kind) {
  std::map<std::string, node::TransportKind> kinds;
  for (const node::TransportKind known : kTransports) kinds.emplace(transportName(known), known);
  choose(bench->add_option("--transport", kind, "How messages travel between the nodes (default: reference)"), kinds);
}

void addSize(CLI::App* bench, PictureSize& size) {
  const auto take = [&size](const std::string& text) {
    const auto given = parsePictureSize(text);
    if (!given) throw CLI::ValidationError("--size", "wants even numbers from 160x90 to 1920x1080, not '" + text + "'");
    size = *given;
  };
  bench->add_option_function<std::string>("--size", take, "Pixels of a visitor's picture")
      ->type_name("WxH")
      ->default_str(nameOf(size));
}

void addWalk(CLI::App* bench, std::optional<std::string>& walk, double& seconds) {
  bench->add_option("--walk", walk, "File of the walk (default: around the fire)");
  bench->add_option("--seconds", seconds, "How long the walk is, at 30 frames a second")
      ->check(CLI::Range(0.1, 600.0))
      ->capture_default_str();
}

/// As CLI::Range for numbers that a step divides.
CLI::Validator multipleOf(int step) {
  return {[step](const std::string& text) {
            const int value = std::stoi(text);  // a check before this one says that it is a number
            return value % step == 0 ? std::string() : text + " is no multiple of " + std::to_string(step);
          },
          "MULTIPLE OF " + std::to_string(step), "multiple of " + std::to_string(step)};
}

}  // namespace

void BenchCommands::addTo(CLI::App& app) {
  bench_ = app.add_subcommand("bench", "Measure a part of Grove");
  bench_->require_subcommand(1);
  addAmortize();
  addEncode();
  addFluid();
  addLightfield();
  addPipeline();
  addView();
}

void BenchCommands::addAmortize() {
  BenchAmortizeOptions& options = amortize_;
  CLI::App* amortize = bench_->add_subcommand(
      "amortize", "What visitors save who share a world, against visitors with a world each (alpha, beta, cores)");
  CLI::Option* users = amortize
                           ->add_option("--users", options.users,
                                        "Numbers of visitors, as in 1,2,4,8 (without it: those, and --figure-5.6)")
                           ->delimiter(',')
                           ->check(CLI::Range(1, kMaxAmortizeUsers));
  CLI::Option* seconds = amortize->add_option("--seconds", options.seconds, "How long to measure each, after a warm-up")
                             ->check(CLI::Range(0.1, 3600.0))
                             ->capture_default_str();
  CLI::Option* frames = amortize->add_option("--frames", options.frames, "Frames of each visitor to measure instead")
                            ->check(CLI::Range(1, 1'000'000))
                            ->excludes(seconds);
  CLI::Option* figure =
      amortize->add_flag("--figure-5.6", options.figure, "The paper's Figure 5.6, too: the fluid alone");
  CLI::Option* capacity =
      amortize
          ->add_flag(
              "--capacity", capacity_.isWanted,
              "Find how many visitors this machine serves at 30 frames per second and 100 ms (p99): one server for "
              "all, and one for each")
          ->excludes(users, frames, figure);
  choose(amortize->add_option("--codec", capacity_.codec, "With --capacity: of the streams (default: jpeg)"),
         std::map<std::string, std::uint8_t>{{"h264", stream::kCodecH264}, {"jpeg", stream::kCodecJpeg}})
      ->needs(capacity);
  amortize->add_option("--scene", options.scene, "Scene file (default: the grove, built in)");
  addSize(amortize, options.size);
  addTransport(amortize, options.transport);
  amortize->add_flag("--json", options.json, "One JSON document on stdout");
  amortize->add_option("--plot", options.plot, "SVG file to draw the curves into")->excludes(capacity);
}

void BenchCommands::addEncode() {
  BenchEncodeOptions& options = encode_;
  CLI::App* encode =
      bench_->add_subcommand("encode", "CPU, bits and quality of the codecs on a walk through the grove");
  addWalk(encode, options.walk, options.seconds);
  addSize(encode, options.size);
  encode->add_flag("--json", options.json, "One JSON document on stdout");
}

void BenchCommands::addFluid() {
  BenchFluidOptions& options = fluid_.options;
  CLI::App* fluid = bench_->add_subcommand("fluid", "Time and accuracy of a step of the fluid simulation");
  fluid->add_option("--grid", options.grid, "Cells per edge")
      ->check(CLI::Range(16, 128))
      ->check(multipleOf(8))
      ->capture_default_str();
  fluid->add_option("--steps", options.steps, "Steps to measure")->check(CLI::Range(1, 100'000))->capture_default_str();
  fluid->add_option("--threads", options.threads, "Threads per step")
      ->check(CLI::Range(1, BenchFluidOptions::kMaxThreads))
      ->capture_default_str();
  fluid->add_flag("--json", options.json, "One JSON document on stdout");
  CLI::Option* solvers =
      fluid->add_flag("--solvers", fluid_.solvers, "Compare pressure solvers instead: residual against CPU time");
  fluid->add_option("--plot", fluid_.plot, "With --solvers: SVG file to draw the comparison to")->needs(solvers);
}

void BenchCommands::addLightfield() {
  BenchLightfieldOptions& options = lightfield_;
  CLI::App* field = bench_->add_subcommand("lightfield", "Speed and quality of pictures made of a light field");
  field->add_option("--size", options.size, "Pixels per edge of a picture")
      ->check(CLI::Range(16, 4096))
      ->capture_default_str();
  field->add_option("--requests", options.requests, "Pictures to make in each of three repeats")
      ->check(CLI::Range(1, 100'000))
      ->capture_default_str();
  field->add_option("--file", options.file, "Light field (default: a small oak, baked first)");
  field->add_option("--threads", options.threads, "Threads (default: one per core)")->check(CLI::Range(1, 1024));
  field->add_flag("--json", options.json, "One JSON document on stdout");
}

void BenchCommands::addPipeline() {
  BenchPipelineOptions& options = pipeline_;
  CLI::App* pipeline = bench_->add_subcommand("pipeline", "Frame rate and use of the stages by frames in flight");
  pipeline->add_option("--frames-in-flight", options.framesInFlight, "Numbers to compare, like 1,4")
      ->delimiter(',')
      ->check(CLI::Range(1, node::kMaxFramesInFlight))
      ->capture_default_str();
  pipeline->add_option("--users", options.users, "Visitors")->check(CLI::Range(1, 1024))->capture_default_str();
  pipeline->add_option("--seconds", options.seconds, "How long, for each number of frames in flight")
      ->check(CLI::Range(0.1, 60.0))
      ->capture_default_str();
  pipeline->add_option("--scene", options.scene, "Scene file (default: the grove, built in)");
  addSize(pipeline, options.size);
  addTransport(pipeline, options.transport);
  pipeline->add_flag("--json", options.json, "One JSON document on stdout");
  pipeline->add_option("--trace", options.trace, "File to write for ui.perfetto.dev or chrome://tracing");
}

void BenchCommands::addView() {
  BenchViewOptions& options = view_;
  CLI::App* view = bench_->add_subcommand(
      "view", "What one visitor's frames cost on a walk, and how near they come to drawing everything");
  addWalk(view, options.walk, options.seconds);
  view->add_option("--scene", options.scene, "Scene file (default: the grove, built in)");
  addSize(view, options.size);
  CLI::Option* stand = view->add_flag("--stand", options.stand,
                                      "Measure visitors who stand where the walk begins, in a world that stands still");
  view->add_option("--visitors", options.visitors, "With --stand: how many")
      ->check(CLI::Range(1, kMaxStandingVisitors))
      ->capture_default_str()
      ->needs(stand);
  view->add_flag("--json", options.json, "One JSON document on stdout");
}

int BenchCommands::run() const {
  if (capacity_.isWanted) {
    return runBenchCapacity({amortize_.scene, capacity_.codec, amortize_.size, amortize_.seconds}, amortize_.json);
  }
  if (bench_->got_subcommand("amortize")) return runBenchAmortize(amortize_);
  if (bench_->got_subcommand("encode")) return runBenchEncode(encode_);
  if (bench_->got_subcommand("lightfield")) return runBenchLightfield(lightfield_);
  if (bench_->got_subcommand("pipeline")) return runBenchPipeline(pipeline_);
  if (bench_->got_subcommand("view")) return runBenchView(view_);
  if (!fluid_.solvers) return runBenchFluid(fluid_.options);
  return runBenchFluidSolvers({fluid_.options.grid, fluid_.options.json, fluid_.plot});
}

}  // namespace grove::cli

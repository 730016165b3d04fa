#include "cli/bench_commands.h"

#include <CLI/CLI.hpp>
#include <cstdio>

#include "cli/bench/codec_names.h"
#include "cli/bench/fluid/bench_fluid_solvers.h"
#include "cli/bench/link_report.h"
#include "cli/bench/machine/bench_machine.h"
#include "cli/bench/picture_size.h"
#include "cli/options/choose.h"
#include "cli/prepare/prepare_world.h"
#include "node/limits.h"

namespace grove::cli {
namespace {

void addTransport(CLI::App* bench, node::TransportKind& kind) {
  std::map<std::string, node::TransportKind> kinds;
  for (const node::TransportKind known : kTransports) kinds.emplace(transportName(known), known);
  choose(bench->add_option("--transport", kind, "How messages are sent between the nodes (default: reference)"), kinds);
}

void addSize(CLI::App* bench, PictureSize& size) {
  const auto take = [&size](const std::string& text) {
    const auto given = parsePictureSize(text);
    if (!given)
      throw CLI::ValidationError("--size", "must be even numbers from 160x90 to 1920x1080, not '" + text + "'");
    size = *given;
  };
  bench->add_option_function<std::string>("--size", take, "Size of a visitor's picture in pixels")
      ->type_name("WxH")
      ->default_str(nameOf(size));
}

void addWalk(CLI::App* bench, std::optional<std::string>& walk, double& seconds) {
  bench->add_option("--walk", walk, "File of the walk (default: around the fire)");
  addNumber(*bench, "--seconds", seconds, 0.1, 600.0, "Seconds of the walk");
}

/// Accepts multiples of `step`.
CLI::Validator multipleOf(int step) {
  return {[step](const std::string& text) {
            const int value = std::stoi(text);  // an earlier check ensures that it is a number
            return value % step == 0 ? std::string() : text + " is not a multiple of " + std::to_string(step);
          },
          "MULTIPLE OF " + std::to_string(step), "multiple of " + std::to_string(step)};
}

}  // namespace

void BenchCommands::addTo(CLI::App& app) {
  bench_ = app.add_subcommand("bench", "Measure parts of Grove");
  bench_->require_subcommand(1);
  addAmortize();
  addEncode();
  addFluid();
  addLightfield();
  addMachine();
  addPipeline();
  addView();
  addWarp();
}

void BenchCommands::addAmortize() {
  BenchAmortizeOptions& options = amortize_;
  CLI::App* amortize = bench_->add_subcommand(
      "amortize", "Measure what visitors of one world save against private worlds (alpha, beta, cores)");
  CLI::Option* users =
      amortize
          ->add_option("--users", options.users, "Numbers of visitors to compare (default: 1,2,4,8 and --figure-5.6)")
          ->delimiter(',')
          ->check(CLI::Range(1, kMaxAmortizeUsers));
  CLI::Option* seconds = addNumber(*amortize, "--seconds", options.seconds, 0.1, 3600.0,
                                   "Seconds to measure each number, after a warm-up");
  CLI::Option* frames =
      amortize->add_option("--frames", options.frames, "Measure this many frames of each visitor instead")
          ->check(CLI::Range(1, 1'000'000))
          ->excludes(seconds);
  CLI::Option* figure =
      amortize->add_flag("--figure-5.6", options.figure, "Add the paper's Figure 5.6: the fluid alone");
  CLI::Option* capacity =
      amortize
          ->add_flag(
              "--capacity", findsCapacity_,
              "Find how many visitors this machine serves at 30 frames per second and 100 ms (p99): one server for "
              "all, and one for each")
          ->excludes(users, frames, figure);
  choose(amortize
             ->add_option("--codec", options.codecs,
                          "Codec of the streams, a row for each (default: jpeg); one with --capacity")
             ->delimiter(','),
         kCodecs);
  choose(amortize
             ->add_option("--walk", options.courses,
                          "How visitors walk, a row for each (default: together); lines are fitted over the first")
             ->delimiter(','),
         kCourses)
      ->excludes(capacity);
  amortize->add_option("--scene", options.scene, aboutScene());
  addSize(amortize, options.size);
  addTransport(amortize, options.transport);
  amortize->add_flag("--json", options.json, "Print one JSON document");
  amortize->add_option("--plot", options.plot, "Draw the curves to this SVG file")->excludes(capacity);
}

void BenchCommands::addEncode() {
  BenchEncodeOptions& options = encode_;
  CLI::App* encode =
      bench_->add_subcommand("encode", "Measure CPU, bits and quality of the codecs on a walk through the grove");
  addWalk(encode, options.walk, options.seconds);
  addSize(encode, options.size);
  encode->add_option("--keep", options.keep,
                     "Measure the walk at fixed quantisers only; keep its frames and streams in this folder");
  encode->add_flag("--json", options.json, "Print one JSON document");
}

void BenchCommands::addFluid() {
  BenchFluidOptions& options = fluid_.options;
  CLI::App* fluid = bench_->add_subcommand("fluid", "Measure time and accuracy of a step of the fluid simulation");
  fluid->add_option("--grid", options.grid, "Cells per edge")
      ->check(CLI::Range(16, 128))
      ->check(multipleOf(8))
      ->capture_default_str();
  addNumber(*fluid, "--steps", options.steps, 1, 100'000, "Steps to measure");
  addNumber(*fluid, "--threads", options.threads, 1, BenchFluidOptions::kMaxThreads, "Threads per step");
  fluid->add_flag("--json", options.json, "Print one JSON document");
  CLI::Option* solvers =
      fluid->add_flag("--solvers", fluid_.solvers, "Compare pressure solvers instead: residual against CPU time");
  fluid->add_option("--plot", fluid_.plot, "With --solvers: draw the comparison to this SVG file")->needs(solvers);
}

void BenchCommands::addLightfield() {
  BenchLightfieldOptions& options = lightfield_;
  CLI::App* field =
      bench_->add_subcommand("lightfield", "Measure speed and quality of pictures rendered from a light field");
  addNumber(*field, "--size", options.size, 16, 4096, "Pixels per edge of a picture");
  addNumber(*field, "--requests", options.requests, 1, 100'000, "Pictures to render in each of three repeats");
  field->add_option("--file", options.file, "Light field (default: a small oak, baked first)");
  field->add_option("--threads", options.threads, "Threads (default: one per core)")->check(CLI::Range(1, 1024));
  field->add_flag("--json", options.json, "Print one JSON document");
}

void BenchCommands::addMachine() {
  CLI::App* machine = bench_->add_subcommand(
      "machine",
      "Measure one core with a fixed mix of kernels: a score by which figures of different processors compare");
  machine->add_flag("--json", machineJson_, "Print one JSON document");
}

void BenchCommands::addPipeline() {
  BenchPipelineOptions& options = pipeline_;
  CLI::App* pipeline =
      bench_->add_subcommand("pipeline", "Measure frame rate and utilisation of the stages by frames in flight");
  pipeline->add_option("--frames-in-flight", options.framesInFlight, "Numbers of frames in flight to compare")
      ->delimiter(',')
      ->check(CLI::Range(1, node::kMaxFramesInFlight))
      ->capture_default_str();
  addNumber(*pipeline, "--users", options.users, 1, 1024, "Visitors");
  addNumber(*pipeline, "--seconds", options.seconds, 0.1, 60.0, "Seconds to measure each number of frames in flight");
  pipeline->add_option("--scene", options.scene, aboutScene());
  addSize(pipeline, options.size);
  addTransport(pipeline, options.transport);
  pipeline->add_flag("--json", options.json, "Print one JSON document");
  pipeline->add_option("--trace", options.trace, "Write a trace for ui.perfetto.dev or chrome://tracing to this file");
}

void BenchCommands::addView() {
  BenchViewOptions& options = view_;
  CLI::App* view = bench_->add_subcommand(
      "view", "Measure the cost of one visitor's frames on a walk, and their error against drawing everything");
  addWalk(view, options.walk, options.seconds);
  view->add_option("--scene", options.scene, aboutScene());
  addSize(view, options.size);
  CLI::Option* stand =
      view->add_flag("--stand", options.stand, "Measure standing visitors where the walk begins, in a world at rest");
  addNumber(*view, "--visitors", options.visitors, 1, kMaxStandingVisitors, "With --stand: number of visitors")
      ->needs(stand);
  CLI::Option* exact =
      view->add_flag("--exact", options.exact, "Compare what a busy server shows with exact pictures, without fluids and herds")
          ->excludes(stand);
  addNumber(*view, "--busy", options.shed.busyShare, 0.0, 1.0, "With --exact: share of busy workers")->needs(exact);
  addNumber(*view, "--lines", options.shed.lines, 90, 1080, "With --exact: height of the server's pictures")
      ->check(multipleOf(2))
      ->needs(exact);
  view->add_flag("--json", options.json, "Print one JSON document");
}

void BenchCommands::addWarp() {
  BenchWarpOptions& options = warp_;
  CLI::App* warp = bench_->add_subcommand(
      "warp", "Measure what pages show of a walk over a slow line: moved pictures against those drawn there");
  addWalk(warp, options.walk, options.seconds);
  addSize(warp, options.size);
  addNumber(*warp, "--delay", options.delay, 0.0, 1000.0, "Round trip of the line in milliseconds");
  warp->add_option("--pictures", options.pictures, "Pictures that the server sends a second: 60, 30, 20 or 15")
      ->check(CLI::IsMember({60, 30, 20, 15}))
      ->capture_default_str();
  warp->add_option("--lines", options.lines, "Height of the server's pictures (default: of the page's)")
      ->check(CLI::Range(90, 1080))
      ->check(multipleOf(2));
  warp->add_option("--film", options.film,
                   "Write a film (.y4m) without late walk on the left, and with it on the right");
  warp->add_flag("--json", options.json, "Print one JSON document");
}

int BenchCommands::runCapacity() const {
  const BenchAmortizeOptions& options = amortize_;
  if (options.codecs.size() > 1) {
    std::fputs("bench amortize: --capacity takes one --codec\n", stderr);
    return 2;
  }
  return runBenchCapacity({options.scene, options.codecs.front(), options.size, options.seconds}, options.json);
}

int BenchCommands::run() const {
  if (findsCapacity_) return runCapacity();
  if (bench_->got_subcommand("amortize")) return runBenchAmortize(amortize_);
  if (bench_->got_subcommand("encode")) return runBenchEncode(encode_);
  if (bench_->got_subcommand("lightfield")) return runBenchLightfield(lightfield_);
  if (bench_->got_subcommand("machine")) return runBenchMachine(machineJson_);
  if (bench_->got_subcommand("pipeline")) return runBenchPipeline(pipeline_);
  if (bench_->got_subcommand("view")) return runBenchView(view_);
  if (bench_->got_subcommand("warp")) return runBenchWarp(warp_);
  if (!fluid_.solvers) return runBenchFluid(fluid_.options);
  return runBenchFluidSolvers({fluid_.options.grid, fluid_.options.json, fluid_.plot});
}

}  // namespace grove::cli

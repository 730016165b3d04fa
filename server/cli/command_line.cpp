#include "cli/command_line.h"

#include <CLI/CLI.hpp>
#include <exception>
#include <map>
#include <string>

#include "cli/bench_fluid.h"
#include "cli/load.h"
#include "cli/serve.h"
#include "pipeline/log.h"

namespace grove::cli {
namespace {

void addServe(CLI::App& app, ServeOptions& options) {
  CLI::App* serve = app.add_subcommand("serve", "Serve a world to browsers");
  serve->add_option("--scene", options.scene, "Scene file (default: the clearing, built in)");
  serve->add_option("--listen", options.listen, "Address and port; port 0 is any free one")->capture_default_str();
  const std::map<std::string, gl::ContextKind> kinds{
      {"auto", gl::ContextKind::kAuto}, {"egl", gl::ContextKind::kEgl}, {"osmesa", gl::ContextKind::kOsmesa}};
  serve->add_option("--gl", options.gl, "Where triangles are drawn: auto, egl or osmesa")
      ->transform(CLI::Transformer(kinds))
      ->type_name("KIND");
  serve->add_option("--frames-in-flight", options.host.framesInFlight, "Frames of a visitor that are made at once")
      ->check(CLI::Range(1, 8))
      ->capture_default_str();
  serve->add_option("--fps", options.host.framesPerSecond, "Frames a second for each visitor")
      ->check(CLI::Range(1, 120))
      ->capture_default_str();
  serve->add_option("--max-visitors", options.host.mostVisitors, "How many may be in the world at once")
      ->check(CLI::Range(1, 1024))
      ->capture_default_str();
  serve->add_option("--jpeg-quality", options.host.jpegQuality, "1 to 100")
      ->check(CLI::Range(1, 100))
      ->capture_default_str();
  serve->add_option("--shader-dir", options.shaderDirectory, "Read shaders from here instead of the built-in ones");
}

void addBench(CLI::App& app, BenchFluidOptions& options) {
  CLI::App* bench = app.add_subcommand("bench", "Measure a part of Grove");
  bench->require_subcommand(1);
  CLI::App* fluid = bench->add_subcommand("fluid", "Time and accuracy of a step of the fluid simulation");
  fluid->add_option("--grid", options.grid, "Cells per edge")->capture_default_str();
  fluid->add_option("--steps", options.steps, "Steps to measure")->capture_default_str();
  fluid->add_option("--threads", options.threads, "Threads per step")->capture_default_str();
  fluid->add_flag("--json", options.json, "One JSON document on stdout");
}

void addLoad(CLI::App& app, LoadOptions& options) {
  CLI::App* load = app.add_subcommand("load", "Visit a running server with many websocket clients and measure");
  load->add_option("url", options.url, "ws://HOST:PORT/")->required();
  load->add_option("--sessions", options.sessions, "Number of visitors")
      ->check(CLI::Range(1, 1024))
      ->capture_default_str();
  load->add_option("--seconds", options.seconds, "How long")->check(CLI::Range(0.1, 86400.0))->capture_default_str();
  load->add_option("--width", options.width, "Pixels")->check(CLI::Range(16, 16384))->capture_default_str();
  load->add_option("--height", options.height, "Pixels")->check(CLI::Range(16, 16384))->capture_default_str();
  load->add_flag("--json", options.json, "One JSON document on stdout");
}

}  // namespace

int run(int argc, char** argv) {
  ServeOptions serve;
  BenchFluidOptions benchFluid;
  LoadOptions load;
  CLI::App app("Grove: one living world, a camera for every browser", "grove");
  app.require_subcommand(1);
  addServe(app, serve);
  addBench(app, benchFluid);
  addLoad(app, load);
  try {
    app.parse(argc, argv);
  } catch (const CLI::Success& e) {  // --help
    return app.exit(e);
  } catch (const CLI::ParseError& e) {
    std::fprintf(stderr, "grove: %s (see grove --help)\n", e.what());
    return 2;
  }
  try {
    if (app.got_subcommand("serve")) return runServe(serve);
    if (app.got_subcommand("load")) return runLoad(load);
    return runBenchFluid(benchFluid);
  } catch (const std::exception& e) {
    log::error(e.what());
    return 1;
  }
}

}  // namespace grove::cli

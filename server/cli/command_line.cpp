#include "cli/command_line.h"

#include <CLI/CLI.hpp>
#include <array>
#include <cstdio>
#include <exception>
#include <map>
#include <new>
#include <span>
#include <string>
#include <string_view>
#include <system_error>
#include <vector>

#include "base/address_space.h"
#include "base/log.h"
#include "base/simd/target.h"
#include "base/version.h"
#include "cli/bake.h"
#include "cli/bench_commands.h"
#include "cli/load.h"
#include "cli/options/choose.h"
#include "cli/options/shape.h"
#include "cli/serve/serve_commands.h"
#include "cli/version_report.h"
#include "models/plants/plants.h"
#include "node/limits.h"
#include "objects/lightfield/format/light_field.h"

namespace grove::cli {
namespace {

void addBake(CLI::App& app, BakeCommand& command) {
  using objects::lightfield::kMaxLightings;
  using objects::lightfield::kMaxSize;
  using objects::lightfield::kMinSize;
  using objects::lightfield::ViewSphere;
  CLI::App* bake = app.add_subcommand("bake", "Bake a light field of a model or of a plant");
  bake->add_option("model", command.model, "glTF file, .glb or .gltf");
  bake->add_option("--plant", command.plant, "Generate this plant instead")->type_name(oneOf(models::plantNames()));
  bake->add_option("--seed", command.seed, "Seed of the plant; each seed is a different plant")->capture_default_str();
  const std::map<std::string, bool> details{{"small", false}, {"full", true}};
  choose(bake->add_option("--detail", command.full, "Detail of the plant; full is several million triangles"), details);
  addNumber(*bake, "--subdivision", command.options.subdivision, 1, ViewSphere::kMaxSubdivision,
            "Parts per edge of the octahedron of views");
  const auto powerOfTwo = [](const std::string& text) -> std::string {
    for (int size = kMinSize; size <= kMaxSize; size *= 2) {
      if (text == std::to_string(size)) return {};
    }
    return "must be a power of two from " + std::to_string(kMinSize) + " to " + std::to_string(kMaxSize);
  };
  bake->add_option("--size", command.options.size, "Texels per edge of a view")
      ->check(powerOfTwo, "POWER OF TWO")
      ->capture_default_str();
  addNumber(*bake, "--lightings", command.options.lightings, 1, kMaxLightings,
            "Directions of the sun, for rotated objects");
  addNumber(*bake, "--samples", command.options.samples, 1, 16, "Samples per edge of a texel");
  bake->add_option("--threads", command.options.threads, "Threads (default: one per core)")->check(CLI::Range(1, 1024));
  bake->add_option("-o,--output", command.output, "Light-field file to write")->required();
  bake->add_flag("--json", command.json, "Print one JSON document");
}

void addLoad(CLI::App& app, LoadOptions& options) {
  CLI::App* load = app.add_subcommand("load", "Measure a running server with many websocket clients");
  load->add_option("url", options.url, "ws://HOST:PORT/ or wss://HOST:PORT/")->required();
  addNumber(*load, "--sessions", options.sessions, 1, 1024, "Number of visitors");
  addNumber(*load, "--seconds", options.seconds, 0.1, 86400.0, "Seconds to measure");
  addNumber(*load, "--warm-up", options.warmUp, 0.0, 3600.0, "Seconds that visitors move before");
  addNumber(*load, "--width", options.width, 16, 16384, "Width of a picture in pixels");
  addNumber(*load, "--height", options.height, 16, 16384, "Height of a picture in pixels");
  load->add_flag("--insecure", options.insecure, "With wss://: accept any certificate");
  constexpr std::array<std::string_view, 2> kCodecs = {"h264", "jpeg"};
  load->add_option("--codec", options.codec, "Offer only this codec (default: h264, then jpeg)")
      ->check(CLI::IsMember(std::vector<std::string>(kCodecs.begin(), kCodecs.end())).description(""))
      ->type_name(oneOf(kCodecs));
  CLI::Option* walk = load->add_option_function<std::string>(
                              "--walk", [&options](const std::string& file) { options.walkFile = file; },
                              "Stroll (the default), or follow a walk file of the built-in world, as in tests/walks")
                          ->type_name("[FILE]")
                          ->expected(0, 1);
  CLI::Option* look = load->add_flag("--look", options.look, "Only look around")->excludes(walk);
  load->add_flag("--stand", options.stand, "Stand still; inputs are still sent")->excludes(walk)->excludes(look);
  load->add_flag("--late-walk", options.lateWalk, "Ask for what pages with late walk need, and take fewer pictures");
  load->add_option("--shape", options.shape, "Shape each visitor's line, as in 5mbit,80ms; see grove shape --help")
      ->type_name("PROFILE");
  load->add_flag("--json", options.json, "Print one JSON document");
}

void addShape(CLI::App& app, ShapeOptions& options) {
  CLI::App* shape = app.add_subcommand("shape", "Imitate a bad line: a proxy between browsers and a server");
  shape
      ->add_option("profile", options.profile,
                   "RATE,RTT[,up=RATE][,jitter=TIME][,stall=TIME/TIME][,loss=PERCENT][,seed=N], as in "
                   "5mbit,80ms,jitter=10ms,loss=0.5 or 5mbit@0s/500kbit@10s,80ms,stall=1s/10s")
      ->required();
  shape->add_option("--listen", options.listen, "Address and port; port 0 is any free one")->capture_default_str();
  shape->add_option("--to", options.target, "Address and port of the server")->required();
}

/// All commands of the program, with their options.
class Commands {
 public:
  explicit Commands(CLI::App& app) : app_(app) {
    addServe(app, serve_);
    addBake(app, bake_);
    bench_.addTo(app);
    addLoad(app, load_);
    addNode(app, node_);
    addShape(app, shape_);
    addWorld(app, world_);
  }

  /// Runs the parsed command; returns the process's exit code.
  [[nodiscard]] int run() const {
    if (app_.got_subcommand("serve")) return runServe(serve_);
    if (app_.got_subcommand("node")) return runNode(node_);
    if (app_.got_subcommand("bake")) return runBake(bake_);
    if (app_.got_subcommand("load")) return runLoad(load_);
    if (app_.got_subcommand("shape")) return runShape(shape_);
    if (app_.got_subcommand("world")) return runWorld(world_);
    return bench_.run();
  }

 private:
  const CLI::App& app_;
  ServeOptions serve_;
  BakeCommand bake_;
  BenchCommands bench_;
  LoadOptions load_;
  NodeOptions node_;
  ShapeOptions shape_;
  WorldOptions world_;
};

}  // namespace

int run(int argc, char** argv) {
  CLI::App app("Grove: one living world, a camera for every browser", "grove");
  app.require_subcommand(1);
  app.set_version_flag("--version", std::string(version()), "Print version, SIMD target, GL and codecs, and exit");
  Commands commands(app);
  bool versionAsked = false;
  try {
    app.parse(argc, argv);
  } catch (const CLI::CallForVersion&) {
    versionAsked = true;
  } catch (const CLI::Success& e) {  // --help
    return app.exit(e);
  } catch (const CLI::ParseError& e) {
    std::fprintf(stderr, "grove: %s (see grove --help)\n", e.what());
    return 2;
  }
  try {
    returnFreedBlocks();
    spareAddressSpace();
    simd::chooseTarget();
    if (versionAsked) {
      std::fputs(versionReport().c_str(), stdout);
      return 0;
    }
    return commands.run();
  } catch (const std::bad_alloc&) {
    log::error(memoryShortage());
    return 1;
  } catch (const std::system_error& e) {
    const bool ofThreads = e.code() == std::errc::resource_unavailable_try_again;
    log::error(ofThreads ? memoryShortage() + ", or for another thread (ulimit -u)" : e.what());
    return 1;
  } catch (const std::exception& e) {
    log::error(e.what());
    return 1;
  }
}

}  // namespace grove::cli

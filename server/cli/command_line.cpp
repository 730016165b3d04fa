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
#include "cli/choose.h"
#include "cli/load.h"
#include "cli/node.h"
#include "cli/serve.h"
#include "cli/shape.h"
#include "cli/version_report.h"
#include "cli/world.h"
#include "models/plants/plants.h"
#include "node/limits.h"
#include "objects/lightfield/format/light_field.h"

namespace grove::cli {
namespace {

std::string isNamedFile(const std::string& file) { return file.empty() ? "must name a file" : ""; }

/// Certificate and key, which need each other; the first of them.
CLI::Option* addCertificate(CLI::App& command, TlsFiles& files, const std::string& what) {
  CLI::Option* certificate =
      command.add_option(files.option + "-cert", files.certificate, what)->check(isNamedFile, "FILE");
  CLI::Option* key =
      command.add_option(files.option + "-key", files.key, "The certificate's key, PEM")->check(isNamedFile, "FILE");
  certificate->needs(key);
  key->needs(certificate);
  return certificate;
}

void addInternet(CLI::App& serve, ServeOptions& options) {
  serve.add_option("--origin", options.origins, "Origin whose pages may open a socket; may be given several times")
      ->type_name("URL")
      ->expected(1)
      ->multi_option_policy(CLI::MultiOptionPolicy::TakeAll);
  serve
      .add_option("--proxy", options.proxies,
                  "Address, or ADDRESS/BITS, whose X-Forwarded-* are believed; may be given several times")
      ->type_name("ADDRESS")
      ->expected(1)
      ->multi_option_policy(CLI::MultiOptionPolicy::TakeAll);
  CLI::Option* certificate = addCertificate(serve, options.tls, "Certificate and its issuers, PEM: https, wss");
  serve.add_option("--hsts", options.hsts, "Seconds for which browsers shall come by https only")
      ->type_name("SECONDS")
      ->check(CLI::Range(0, 2 * 365 * 86'400))
      ->needs(certificate);
}

/// A world that several servers show.
void addJoining(CLI::App& serve, ServeOptions& options) {
  CLI::Option* join = serve.add_option("--join", options.join, "Show the world that the process there owns");
  CLI::Option* share = serve.add_option("--share", options.share, "Let other servers join this one's world there");
  for (CLI::Option* option : {join, share}) option->type_name("HOST:PORT")->excludes("--private");
  join->excludes(share);
  CLI::Option* authorities =
      serve
          .add_option("--link-tls-ca", options.links.authorities,
                      "Certificates of authorities, PEM: links by TLS, to processes that one of them has signed")
          ->check(isNamedFile, "FILE");
  addCertificate(serve, options.links.own, "Certificate that is shown on links, and its issuers, PEM")
      ->needs(authorities);
}

/// Of who listens for the links of servers.
void addListenerTls(CLI::App& command, LinkOptions& links) {
  CLI::Option* certificate = addCertificate(command, links.own, "Certificate and its issuers, PEM: links by TLS");
  command
      .add_option("--tls-ca", links.authorities,
                  "Certificates of authorities, PEM: only servers that one of them has signed")
      ->check(isNamedFile, "FILE")
      ->needs(certificate);
}

void addServe(CLI::App& app, ServeOptions& options) {
  CLI::App* serve = app.add_subcommand("serve", "Serve a world to browsers");
  serve->add_option("--scene", options.scene, "Scene file (default: the grove, built in)");
  serve->add_option("--listen", options.listen, "Address and port; port 0 is any free one")->capture_default_str();
  serve->add_option("--operator", options.operators,
                    "Address and port of the operator's page (default: 127.0.0.1, the next port)");
  serve->add_option("--name", options.names, "Host name that browsers know it by; may be given several times")
      ->type_name("TEXT")
      ->expected(1)
      ->multi_option_policy(CLI::MultiOptionPolicy::TakeAll);
  addInternet(*serve, options);
  const std::map<std::string, gl::ContextKind> kinds{
      {"auto", gl::ContextKind::kAuto}, {"egl", gl::ContextKind::kEgl}, {"osmesa", gl::ContextKind::kOsmesa}};
  choose(serve->add_option("--gl", options.gl, "Where triangles are drawn"), kinds);
  serve->add_option("--frames-in-flight", options.host.framesInFlight, "Frames of a visitor that are made at once")
      ->check(CLI::Range(1, 8))
      ->capture_default_str();
  serve->add_flag("--private", options.host.privateWorlds,
                  "Each visitor gets copies of his own of everything: what serving costs without sharing");
  serve
      ->add_option("--nodes", options.nodes,
                   "Nodes (grove node) that serve some of the objects, with commas between; the rest is served here")
      ->type_name("HOST:PORT")
      ->delimiter(',')
      ->excludes("--private");
  addJoining(*serve, options);
  serve->add_flag("--raise-quality", options.host.raiseQuality,
                  "Let shared work (grid of the fluid, light fields) get finer while enough visitors share its cost");
  serve->add_option("--fps", options.host.framesPerSecond, "Frames a second for each visitor")
      ->check(CLI::Range(1, 120))
      ->capture_default_str();
  serve
      ->add_option_function<int>(
          "--frame-deadline", [&options](int milliseconds) { options.host.deadlineSeconds = milliseconds / 1000.0; },
          "Milliseconds that a frame waits for its objects; those that are later show their last state")
      ->type_name("INT")
      ->check(CLI::Range(10, 60'000))
      ->default_str("500");
  serve->add_option("--max-visitors", options.host.maxVisitors, "How many may be in the world at once")
      ->check(CLI::Range(1, 1024))
      ->capture_default_str();
  serve->add_option("--visitors-per-address", options.visitorsPerAddress, "How many of them may have one address")
      ->check(CLI::Range(1, 1024))
      ->capture_default_str();
  serve->add_option("--jpeg-quality", options.host.jpegQuality, "1 to 100")
      ->check(CLI::Range(1, 100))
      ->capture_default_str();
  serve
      ->add_option("--view-cache", options.viewCacheMegabytes,
                   "MB of light-field pictures that visitors share; 0: none")
      ->check(CLI::Range(0, 1 << 20))
      ->capture_default_str();
  serve
      ->add_option("--view-error", options.viewError,
                   "Pixels of parallax that a shared picture may have to mend (default: as the scene says, or 16)")
      ->check(CLI::Range(0.25, 64.0));
  serve->add_option("--shader-dir", options.shaderDirectory, "Read shaders from here instead of the built-in ones");
}

void addWorld(CLI::App& app, WorldOptions& options) {
  CLI::App* world = app.add_subcommand("world", "Own a world that servers show (grove serve --join)");
  world->add_option("--scene", options.scene, "Scene file, that of the servers (default: the grove, built in)");
  world->add_option("--listen", options.listen, "Address and port; port 0 is any free one")->capture_default_str();
  addListenerTls(*world, options.links);
}

void addNode(CLI::App& app, NodeOptions& options) {
  CLI::App* node = app.add_subcommand("node", "Serve some objects of a world to servers (grove serve --nodes)");
  node->add_option("--objects", options.objects, "Names or types of those that it owns, with commas between")
      ->type_name("NAME")
      ->delimiter(',')
      ->required();
  node->add_option("--scene", options.scene, "Scene file, that of the servers (default: the grove, built in)");
  node->add_option("--listen", options.listen, "Address and port; port 0 is any free one")->capture_default_str();
  addListenerTls(*node, options.links);
  const std::map<std::string, gl::ContextKind> kinds{
      {"auto", gl::ContextKind::kAuto}, {"egl", gl::ContextKind::kEgl}, {"osmesa", gl::ContextKind::kOsmesa}};
  choose(node->add_option("--gl", options.gl, "Where triangles are drawn"), kinds);
}

void addBake(CLI::App& app, BakeCommand& command) {
  using objects::lightfield::kMaxLightings;
  using objects::lightfield::kMaxSize;
  using objects::lightfield::kMinSize;
  using objects::lightfield::ViewSphere;
  CLI::App* bake = app.add_subcommand("bake", "Make a light field of a model or of a plant");
  bake->add_option("model", command.model, "glTF file, .glb or .gltf");
  bake->add_option("--plant", command.plant, "A plant to grow instead")->type_name(oneOf(models::plantNames()));
  bake->add_option("--seed", command.seed, "The plant's; another seed is another plant")->capture_default_str();
  const std::map<std::string, bool> details{{"small", false}, {"full", true}};
  choose(bake->add_option("--detail", command.full, "The plant's; full is several million triangles"), details);
  bake->add_option("--subdivision", command.options.subdivision, "Parts per edge of the octahedron of views")
      ->check(CLI::Range(1, ViewSphere::kMaxSubdivision))
      ->capture_default_str();
  const auto powerOfTwo = [](const std::string& text) -> std::string {
    for (int size = kMinSize; size <= kMaxSize; size *= 2) {
      if (text == std::to_string(size)) return {};
    }
    return "must be a power of two from " + std::to_string(kMinSize) + " to " + std::to_string(kMaxSize);
  };
  bake->add_option("--size", command.options.size, "Texels per edge of a view")
      ->check(powerOfTwo, "POWER OF TWO")
      ->capture_default_str();
  bake->add_option("--lightings", command.options.lightings, "Suns around the object, for objects that are turned")
      ->check(CLI::Range(1, kMaxLightings))
      ->capture_default_str();
  bake->add_option("--samples", command.options.samples, "Samples per edge of a texel")
      ->check(CLI::Range(1, 16))
      ->capture_default_str();
  bake->add_option("--threads", command.options.threads, "Threads (default: one per core)")->check(CLI::Range(1, 1024));
  bake->add_option("-o,--output", command.output, "Light-field file to write")->required();
  bake->add_flag("--json", command.json, "One JSON document on stdout");
}

void addLoad(CLI::App& app, LoadOptions& options) {
  CLI::App* load = app.add_subcommand("load", "Visit a running server with many websocket clients and measure");
  load->add_option("url", options.url, "ws://HOST:PORT/, or wss://")->required();
  load->add_option("--sessions", options.sessions, "Number of visitors")
      ->check(CLI::Range(1, 1024))
      ->capture_default_str();
  load->add_option("--seconds", options.seconds, "How long")->check(CLI::Range(0.1, 86400.0))->capture_default_str();
  load->add_option("--width", options.width, "Pixels")->check(CLI::Range(16, 16384))->capture_default_str();
  load->add_option("--height", options.height, "Pixels")->check(CLI::Range(16, 16384))->capture_default_str();
  load->add_flag("--insecure", options.insecure, "With wss://: take any certificate");
  constexpr std::array<std::string_view, 2> kCodecs = {"h264", "jpeg"};
  load->add_option("--codec", options.codec, "The only one that is offered (default: h264, then jpeg)")
      ->check(CLI::IsMember(std::vector<std::string>(kCodecs.begin(), kCodecs.end())).description(""))
      ->type_name(oneOf(kCodecs));
  CLI::Option* walk = load->add_option_function<std::string>(
                              "--walk", [&options](const std::string& file) { options.walkFile = file; },
                              "Walk about (the default), or along a walk of the built-in world, as in tests/walks")
                          ->type_name("[FILE]")
                          ->expected(0, 1);
  CLI::Option* look = load->add_flag("--look", options.look, "Look about only")->excludes(walk);
  load->add_flag("--stand", options.stand, "Stand still; inputs are sent all the same")->excludes(walk)->excludes(look);
  load->add_option("--shape", options.shape, "A line for each visitor, as in 5mbit,80ms; see grove shape --help")
      ->type_name("PROFILE");
  load->add_flag("--json", options.json, "One JSON document on stdout");
}

void addShape(CLI::App& app, ShapeOptions& options) {
  CLI::App* shape = app.add_subcommand("shape", "Show a server over a bad line: a proxy for browsers");
  shape
      ->add_option("profile", options.profile,
                   "RATE,RTT[,up=RATE][,jitter=TIME][,stall=TIME/TIME][,seed=N], as in 5mbit,80ms,jitter=10ms or "
                   "5mbit@0s/500kbit@10s,80ms,stall=1s/10s")
      ->required();
  shape->add_option("--listen", options.listen, "Address and port; port 0 is any free one")->capture_default_str();
  shape->add_option("--to", options.target, "Address and port of the server")->required();
}

}  // namespace

int run(int argc, char** argv) {
  ServeOptions serve;
  BakeCommand bake;
  BenchCommands bench;
  LoadOptions load;
  NodeOptions node;
  ShapeOptions shape;
  WorldOptions world;
  CLI::App app("Grove: one living world, a camera for every browser", "grove");
  app.require_subcommand(1);
  app.set_version_flag("--version", std::string(version()), "Print version, SIMD target, GL and codecs, and exit");
  addServe(app, serve);
  addBake(app, bake);
  bench.addTo(app);
  addLoad(app, load);
  addNode(app, node);
  addShape(app, shape);
  addWorld(app, world);
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
    if (app.got_subcommand("serve")) return runServe(serve);
    if (app.got_subcommand("node")) return runNode(node);
    if (app.got_subcommand("bake")) return runBake(bake);
    if (app.got_subcommand("load")) return runLoad(load);
    if (app.got_subcommand("shape")) return runShape(shape);
    if (app.got_subcommand("world")) return runWorld(world);
    return bench.run();
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

#include "cli/serve/serve_commands.h"

#include <CLI/CLI.hpp>
#include <map>
#include <optional>
#include <string>

#include "cli/options/choose.h"
#include "cli/prepare/prepare_world.h"

namespace grove::cli {
namespace {

std::string isNamedFile(const std::string& file) { return file.empty() ? "must name a file" : ""; }

/// Adds options for a certificate and its key, which require each other; returns the first.
CLI::Option* addCertificate(CLI::App& command, TlsFiles& files, const std::string& what) {
  CLI::Option* certificate =
      command.add_option(files.option + "-cert", files.certificate, what)->check(isNamedFile, "FILE");
  CLI::Option* key =
      command.add_option(files.option + "-key", files.key, "The certificate's key, PEM")->check(isNamedFile, "FILE");
  certificate->needs(key);
  key->needs(certificate);
  return certificate;
}

void addViewError(CLI::App& command, std::optional<float>& viewError) {
  command
      .add_option("--view-error", viewError,
                  "Maximum gap in pixels when a shared picture is reprojected; 0: visitors share none (default: the "
                  "scene's, or 16)")
      ->check(CLI::Range(0.0, 64.0));
}

void addInternet(CLI::App& serve, ServeOptions& options) {
  serve.add_option("--origin", options.origins, "Another origin whose pages may open a websocket; may be repeated")
      ->type_name("URL")
      ->expected(1)
      ->multi_option_policy(CLI::MultiOptionPolicy::TakeAll);
  serve
      .add_option("--proxy", options.proxies,
                  "Proxy, ADDRESS or ADDRESS/BITS, whose X-Forwarded-* are trusted; may be repeated")
      ->type_name("ADDRESS")
      ->expected(1)
      ->multi_option_policy(CLI::MultiOptionPolicy::TakeAll);
  CLI::Option* certificate =
      addCertificate(serve, options.tls, "Certificate and its issuers, PEM: enables https and wss");
  serve.add_option("--hsts", options.hsts, "Seconds during which browsers must use https only")
      ->type_name("SECONDS")
      ->check(CLI::Range(0, 2 * 365 * 86'400))
      ->needs(certificate);
}

/// Of who links to other processes; the first of the options.
CLI::Option* addLinkTls(CLI::App& command, LinkOptions& links) {
  CLI::Option* authorities =
      command
          .add_option(
              "--link-tls-ca", links.authorities,
              "Authorities' certificates, PEM: links use TLS, only to processes with a certificate signed by one")
          ->check(isNamedFile, "FILE");
  addCertificate(command, links.own, "This process's certificate for links, and its issuers, PEM")->needs(authorities);
  return authorities;
}

/// Options for a world of several servers.
void addJoining(CLI::App& serve, ServeOptions& options) {
  CLI::Option* join = serve.add_option("--join", options.join, "Show the world that the process at this address owns");
  CLI::Option* share =
      serve.add_option("--share", options.share, "Let other servers join this server's world at this address");
  for (CLI::Option* option : {join, share}) option->type_name("HOST:PORT");
  join->excludes(share);
  addLinkTls(serve, options.links);
}

/// Options of processes that listen for links of servers.
void addListenerTls(CLI::App& command, LinkOptions& links) {
  CLI::Option* certificate = addCertificate(command, links.own, "Certificate and its issuers, PEM: links use TLS");
  command
      .add_option("--tls-ca", links.authorities,
                  "Authorities' certificates, PEM: accept only servers with a certificate signed by one")
      ->check(isNamedFile, "FILE")
      ->needs(certificate);
}

void addLimits(CLI::App& serve, ServeOptions& options) {
  addNumber(serve, "--fps", options.host.framesPerSecond, 1, 120, "Frames per second for each visitor");
  serve
      .add_option_function<int>(
          "--frame-deadline", [&options](int milliseconds) { options.host.deadlineSeconds = milliseconds / 1000.0; },
          "Milliseconds that a frame waits for its objects; later ones show their last state")
      ->type_name("INT")
      ->check(CLI::Range(10, 60'000))
      ->default_str("500");
  addNumber(serve, "--max-visitors", options.host.maxVisitors, 1, 1024, "Maximum number of visitors");
  addNumber(serve, "--visitors-per-address", options.visitorsPerAddress, 1, 1024,
            "Maximum number of visitors from one address");
}

void addGl(CLI::App& app, gl::ContextKind& kind) {
  const std::map<std::string, gl::ContextKind> kinds{
      {"auto", gl::ContextKind::kAuto}, {"egl", gl::ContextKind::kEgl}, {"osmesa", gl::ContextKind::kOsmesa}};
  choose(app.add_option("--gl", kind, "GL context that draws triangles"), kinds);
}

}  // namespace

void addServe(CLI::App& app, ServeOptions& options) {
  CLI::App* serve = app.add_subcommand("serve", "Serve a world to browsers");
  serve->add_option("--scene", options.scene, aboutScene());
  serve->add_option("--listen", options.listen, "Address and port; port 0 is any free one")->capture_default_str();
  serve->add_option("--operator", options.operators,
                    "Address and port of the operator's page (default: 127.0.0.1, the next port)");
  serve->add_option("--name", options.names, "Host name of this server for browsers; may be repeated")
      ->type_name("TEXT")
      ->expected(1)
      ->multi_option_policy(CLI::MultiOptionPolicy::TakeAll);
  addInternet(*serve, options);
  addGl(*serve, options.gl);
  addNumber(*serve, "--frames-in-flight", options.host.framesInFlight, 1, 8, "Frames of a visitor in flight");
  serve
      ->add_option("--nodes", options.nodes,
                   "Nodes (grove node) that serve some of the objects, comma-separated; this server serves the rest")
      ->type_name("HOST:PORT")
      ->delimiter(',');
  addJoining(*serve, options);
  serve->add_flag("--raise-quality", options.host.raiseQuality,
                  "Refine shared work (grid of the fluid, light fields) while enough visitors share its cost");
  addLimits(*serve, options);
  addNumber(*serve, "--jpeg-quality", options.host.jpegQuality, 1, 100, "Quality of JPEG, 1 to 100");
  serve
      ->add_option("--view-cache", options.viewCacheMegabytes,
                   "MB for light-field pictures that visitors share; 0: none")
      ->check(CLI::Range(0, 1 << 20))
      ->capture_default_str();
  addViewError(*serve, options.viewError);
  serve->add_option("--shader-dir", options.shaderDirectory,
                    "Read shaders from this folder instead of the built-in ones");
}

void addWorld(CLI::App& app, WorldOptions& options) {
  CLI::App* world = app.add_subcommand("world", "Own a world that servers show (grove serve --join)");
  world->add_option("--scene", options.scene, aboutScene() + "; the same as the servers'");
  world->add_option("--listen", options.listen, "Address and port; port 0 is any free one")->capture_default_str();
  addListenerTls(*world, options.links);
}

void addNode(CLI::App& app, NodeOptions& options) {
  CLI::App* node = app.add_subcommand("node", "Serve some objects of a world to servers (grove serve --nodes)");
  node->add_option("--objects", options.objects, "Names or types of the objects that it serves, comma-separated")
      ->type_name("NAME")
      ->delimiter(',')
      ->required();
  node->add_option("--scene", options.scene, aboutScene() + "; the same as the servers'");
  node->add_option("--listen", options.listen, "Address and port; port 0 is any free one")->capture_default_str();
  addListenerTls(*node, options.links);
  CLI::Option* obstacles =
      node->add_option("--obstacles", options.obstacles,
                       "Node that provides voxels of all obstacles; this one then loads only the models of its own "
                       "objects; for fluids and skies only")
          ->type_name("HOST:PORT");
  addLinkTls(*node, options.obstacleLinks)->needs(obstacles);
  addViewError(*node, options.viewError);
  addGl(*node, options.gl);
}

}  // namespace grove::cli

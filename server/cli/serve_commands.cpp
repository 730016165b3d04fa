#include "cli/serve_commands.h"

#include <CLI/CLI.hpp>
#include <map>
#include <optional>
#include <string>

#include "cli/options/choose.h"

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

void addViewError(CLI::App& command, std::optional<float>& viewError) {
  command
      .add_option("--view-error", viewError,
                  "Pixels of parallax that a shared picture may have to mend; 0: visitors share none (default: as the "
                  "scene says, or 16)")
      ->check(CLI::Range(0.0, 64.0));
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

/// Of who links to other processes; the first of the options.
CLI::Option* addLinkTls(CLI::App& command, LinkOptions& links) {
  CLI::Option* authorities =
      command
          .add_option("--link-tls-ca", links.authorities,
                      "Certificates of authorities, PEM: links by TLS, to processes that one of them has signed")
          ->check(isNamedFile, "FILE");
  addCertificate(command, links.own, "Certificate that is shown on links, and its issuers, PEM")->needs(authorities);
  return authorities;
}

/// A world that several servers show.
void addJoining(CLI::App& serve, ServeOptions& options) {
  CLI::Option* join = serve.add_option("--join", options.join, "Show the world that the process there owns");
  CLI::Option* share = serve.add_option("--share", options.share, "Let other servers join this one's world there");
  for (CLI::Option* option : {join, share}) option->type_name("HOST:PORT")->excludes("--private");
  join->excludes(share);
  addLinkTls(serve, options.links);
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

}  // namespace

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
  addViewError(*serve, options.viewError);
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
  CLI::Option* obstacles =
      node->add_option("--obstacles", options.obstacles,
                       "Node that provides voxels of all obstacles, so that this one loads only the models of its own "
                       "objects; for fluids and skies only")
          ->type_name("HOST:PORT");
  addLinkTls(*node, options.obstacleLinks)->needs(obstacles);
  addViewError(*node, options.viewError);
  const std::map<std::string, gl::ContextKind> kinds{
      {"auto", gl::ContextKind::kAuto}, {"egl", gl::ContextKind::kEgl}, {"osmesa", gl::ContextKind::kOsmesa}};
  choose(node->add_option("--gl", options.gl, "Where triangles are drawn"), kinds);
}

}  // namespace grove::cli

#include "cli/serve/checked_options.h"

#include <algorithm>
#include <cstdio>
#include <string>
#include <string_view>
#include <vector>

#include "base/error.h"
#include "cli/options/host_port.h"
#include "stream/web_server/access/origin.h"

namespace grove::cli {
namespace {

/// Returns the loopback address with the next port after the visitors' port, or with any free port if that one is in
/// use.
stream::HostPort operatorsBeside(const stream::HostPort& visitors) {
  stream::HostPort next{"127.0.0.1", visitors.port + 1};
  try {
    if (visitors.port != 0) {
      (void)stream::findListenAddress(next.host, next.port, "--operator");
      return next;
    }
  } catch (const EnvironmentError&) {  // taken, or there is none
  }
  return {next.host, 0};
}

/// Returns nothing, with a line on stderr, if an option is invalid.
std::optional<stream::EntranceRules> entranceRules(const ServeOptions& options) {
  const auto fail = [](const char* option, const char* wanted, const std::string& given) {
    std::fprintf(stderr, "grove: %s wants %s, not '%s'\n", option, wanted, given.c_str());
    return std::nullopt;
  };
  stream::EntranceRules rules;
  rules.allowance.visitors = options.visitorsPerAddress;
  for (const std::string& name : options.names) {
    if (!stream::isHostName(name)) return fail("--name", "a host's name without port, like grove.example.org", name);
    rules.names.push_back(name);
  }
  for (const std::string& text : options.origins) {
    const auto origin = stream::parseOrigin(text);
    if (!origin) return fail("--origin", "a page's origin, like https://example.org", text);
    rules.origins.push_back(*origin);
  }
  for (const std::string& text : options.proxies) {
    const auto range = stream::AddressRange::parse(text);
    if (!range) return fail("--proxy", "an address, or ADDRESS/BITS", text);
    rules.proxies.push_back(*range);
  }
  return rules;
}

/// Returns false, with a line on stderr, if an option is not an address.
bool isAddress(const char* option, const std::optional<std::string>& text) {
  return !text || parseHostPort(*text, option);
}

/// A server that requires TLS on its links must not share its world without TLS. Returns false and prints one line on
/// stderr if it would.
bool canShareSecurely(const ServeOptions& options) {
  if (!options.share || options.links.authorities.empty() || !options.links.own.certificate.empty()) return true;
  std::fputs("grove: --share with --link-tls-ca wants --link-tls-cert and --link-tls-key, too\n", stderr);
  return false;
}

struct Listeners {
  stream::HostPort visitors;
  stream::HostPort operatorAddress;
};

/// Returns nothing, with a line on stderr, if the addresses are invalid.
std::optional<Listeners> listenersOf(const ServeOptions& options) {
  const auto visitors = parseHostPort(options.listen, "--listen");
  if (!visitors) return std::nullopt;
  const auto operators = options.operators ? parseHostPort(*options.operators, "--operator") : visitors;
  if (!operators) return std::nullopt;
  // libwebsockets distinguishes listeners by their ports.
  if (options.operators && visitors->port != 0 && visitors->port == operators->port) {
    std::fprintf(stderr, "grove: --listen and --operator need different ports, not both %d\n", visitors->port);
    return std::nullopt;
  }
  return Listeners{*visitors, options.operators ? *operators : operatorsBeside(*visitors)};
}

}  // namespace

std::optional<CheckedOptions> checkedOptions(const ServeOptions& options) {
  const auto listeners = listenersOf(options);
  if (!listeners) return std::nullopt;
  const auto rules = entranceRules(options);
  const auto isNode = [](const std::string& node) { return isAddress("--nodes", node); };
  if (!rules || !std::ranges::all_of(options.nodes, isNode)) return std::nullopt;
  if (!isAddress("--join", options.join) || !isAddress("--share", options.share)) return std::nullopt;
  if (!canShareSecurely(options)) return std::nullopt;
  return CheckedOptions{listeners->visitors, listeners->operatorAddress, *rules};
}

}  // namespace grove::cli

#include "stream/web_server/access/entrance.h"

#include "pipeline/clocks.h"
#include "stream/protocol/printable.h"
#include "stream/web_server/access/forwarded.h"
#include "stream/web_server/access/origin.h"
#include "stream/web_server/wsi.h"

namespace grove::stream {
namespace {

constexpr int kTooManyRequests = 429;  // RFC 6585, 4

PageReply textReply(int status, std::string_view text) {
  PageReply reply;
  reply.status = status;
  reply.body = text;
  return reply;
}

}  // namespace

bool Entrance::allowsSocket(const std::string& address) {
  if (isProxy(address) || limits_.allows(address, pipeline::wallSeconds())) return true;
  refuse(address, "its address has too many connections or opens them too fast");
  return false;
}

void Entrance::refuseFull(const std::string& address, std::size_t sockets) {
  refuse(address, "there are " + std::to_string(sockets) + " connections already");
}

void Entrance::reportEvicted(const std::string& name) {
  refusals_.warning("closed the idle connection from " + name + " to make room for a new one");
}

bool Entrance::isProxy(const std::string& address) const { return stream::isProxy(address, rules_.proxies); }

RequestSource Entrance::sourceOf(lws* wsi) const {
  RequestSource source{addressOfPeer(wsi), nameOfPeer(wsi), header(wsi, WSI_TOKEN_HOST), std::nullopt, false};
  if (isSecure(wsi)) source.isSecure = true;
  if (!isProxy(source.address)) return source;
  source.isForwarded = true;
  source.address = visitorBehind(source.address, header(wsi, WSI_TOKEN_X_FORWARDED_FOR), rules_.proxies);
  source.name = source.address + " through " + source.name;
  const std::string host = header(wsi, "x-forwarded-host:");
  if (!host.empty()) source.host = lastEntry(host);
  const std::string protocol = header(wsi, "x-forwarded-proto:");
  if (!protocol.empty()) source.isSecure = isSecureScheme(lastEntry(protocol));
  return source;
}

std::optional<PageReply> Entrance::refuseRequest(lws* wsi, const RequestSource& source, bool isSecure) {
  // RFC 9112, 3.2: a proxy might have read the other Host and taken this for another request.
  if (isRepeated(wsi, WSI_TOKEN_HOST)) return textReply(HTTP_STATUS_BAD_REQUEST, "more than one Host header\n");
  if (!isKnown(source)) return textReply(HTTP_STATUS_FORBIDDEN, "this server is not known by that name\n");
  if (source.isForwarded && !isWithinLimits(source, AddressLimits::kRequest)) {
    return textReply(kTooManyRequests, "too many requests from this address\n");
  }
  if (!isSecure || stream::isSecure(wsi)) return std::nullopt;
  const auto secure = parseOrigin("https://" + source.host);
  if (!secure) return textReply(HTTP_STATUS_BAD_REQUEST, "this server requires https\n");
  PageReply reply = textReply(HTTP_STATUS_MOVED_PERMANENTLY, "this server requires https\n");
  reply.location = *secure + encodedTarget(wsi);
  return reply;
}

std::optional<unsigned> Entrance::refuseUpgrade(lws* wsi, const RequestSource& source, bool isSecure) {
  if (isRepeated(wsi, WSI_TOKEN_HOST)) return HTTP_STATUS_BAD_REQUEST;
  if (!isKnown(source) || (isSecure && !stream::isSecure(wsi))) return HTTP_STATUS_FORBIDDEN;
  const std::string origin = header(wsi, WSI_TOKEN_ORIGIN);
  if (!origin.empty() && !isSameOrigin(origin, source.host, source.isSecure) && !isOneOf(rules_.origins, origin)) {
    refusals_.warning("refused a websocket from " + source.name + ": a page of " + printable(origin, 100) +
                      " opened it at " + printable(source.host, 100) +
                      "; to allow that page, start the server with --origin");
    return HTTP_STATUS_FORBIDDEN;
  }
  if (source.isForwarded && !isWithinLimits(source, 1.0)) return kTooManyRequests;
  return std::nullopt;
}

bool Entrance::isKnown(const RequestSource& source) {
  if (isKnownHost(source.host, rules_.names)) return true;
  refusals_.warning("refused a request from " + source.name + " for the host " + printable(source.host, 100) +
                    "; if that is this server, start it with --name");
  return false;
}

bool Entrance::isWithinLimits(const RequestSource& source, double cost) {
  if (limits_.allows(source.address, pipeline::wallSeconds(), cost)) return true;
  refuse(source.name, "its address has too many connections or opens them too fast");
  return false;
}

void Entrance::refuse(const std::string& who, const std::string& why) {
  if (host_ != nullptr) host_->countRefusedConnection();
  refusals_.warning("refused a connection from " + who + ": " + why);
}

}  // namespace grove::stream

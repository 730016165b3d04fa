#include "stream/web_server/pages/web_pages.h"

#include <array>
#include <cstdint>
#include <cstdio>
#include <utility>

namespace grove::stream {
namespace {

using Pair = std::pair<std::string_view, std::string_view>;
constexpr std::array kTypes = {
    Pair{".html", "text/html; charset=utf-8"},
    Pair{".css", "text/css; charset=utf-8"},
    Pair{".js", "text/javascript; charset=utf-8"},
    Pair{".svg", "image/svg+xml"},
};

/// Some have a name of their own.
std::string_view fileOf(std::string_view path, Audience audience) {
  if (path == "/") return audience == Audience::kOperator ? "/operator.html" : "/index.html";
  if (path == "/operator") return "/operator.html";
  return path;
}

std::string_view typeOf(std::string_view path) {
  for (const auto& [suffix, type] : kTypes) {
    if (path.ends_with(suffix)) return type;
  }
  return "application/octet-stream";
}

/// FNV-1a: the tag only has to change with the file.
std::string tagOf(std::string_view body) {
  std::uint64_t hash = 0xCBF29CE484222325U;
  for (const char c : body) hash = (hash ^ static_cast<unsigned char>(c)) * 0x100000001B3U;
  std::array<char, 24> text{};
  std::snprintf(text.data(), text.size(), "\"%016llx\"", static_cast<unsigned long long>(hash));
  return text.data();
}

}  // namespace

WebPages::WebPages(std::span<const embedded::File> files, Audience audience) : audience_(audience) {
  for (const embedded::File& file : files) {
    if (audience == Audience::kVisitors && std::string_view(file.path).starts_with("operator")) continue;
    const std::string path = std::string("/") + file.path;
    pages_.emplace(path, Page{typeOf(path), tagOf(file.text()), file.text()});
  }
}

PageReply WebPages::answer(std::string_view method, std::string_view path, std::string_view ifNoneMatch) const {
  PageReply reply;
  reply.sendBody = method != "HEAD";
  if (method != "GET" && method != "HEAD") {
    reply.status = 405;
    reply.body = "only GET and HEAD\n";
    return reply;
  }
  if (path == "/healthz") {
    reply.body = "ok";
    return reply;
  }
  const auto found = pages_.find(fileOf(path, audience_));
  if (found == pages_.end()) {
    reply.status = 404;
    reply.body = "there is no such page\n";
    return reply;
  }
  reply.type = found->second.type;
  reply.etag = found->second.etag;
  if (ifNoneMatch.find(reply.etag) != std::string_view::npos) {
    reply.status = 304;
    return reply;
  }
  reply.body = found->second.body;
  return reply;
}

}  // namespace grove::stream

#include "stream/web_server/pages/web_pages.h"

#include <algorithm>
#include <array>
#include <cstdint>
#include <cstdio>
#include <utility>

#include "stream/web_server/pages/content_coding.h"

namespace grove::stream {
namespace {

using Pair = std::pair<std::string_view, std::string_view>;
constexpr std::array kTypes = {
    Pair{".html", "text/html; charset=utf-8"},
    Pair{".css", "text/css; charset=utf-8"},
    Pair{".js", "text/javascript; charset=utf-8"},
    Pair{".svg", "image/svg+xml"},
};

constexpr std::string_view kIdentity = "identity";
constexpr std::array kCodings = {Pair{".gz", "gzip"}, Pair{".br", "br"}};
/// Paths below this change with their content.
constexpr std::string_view kHashed = "/v/";
constexpr std::string_view kNotFound = "/not_found.html";

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

/// FNV-1a suffices: the tag only has to change with the file.
std::string tagOf(std::string_view body) {
  std::uint64_t hash = 0xCBF29CE484222325U;
  for (const char c : body) hash = (hash ^ static_cast<unsigned char>(c)) * 0x100000001B3U;
  std::array<char, 24> text{};
  std::snprintf(text.data(), text.size(), "\"%016llx\"", static_cast<unsigned long long>(hash));
  return text.data();
}

/// The file's name without the suffix of a coding, and its content coding.
Pair codingOf(std::string_view file) {
  for (const auto& [suffix, coding] : kCodings) {
    if (file.ends_with(suffix)) return {file.substr(0, file.size() - suffix.size()), coding};
  }
  return {file, kIdentity};
}

bool isOperators(std::string_view file) { return file.substr(file.rfind('/') + 1).starts_with("operator"); }

/// Returns whether If-None-Match names the tag, in a list or as a weak one.
bool isNamed(std::string_view ifNoneMatch, std::string_view tag) {
  return ifNoneMatch == "*" || ifNoneMatch.find(tag) != std::string_view::npos;
}

}  // namespace

WebPages::WebPages(std::span<const embedded::File> files, Audience audience) : audience_(audience) {
  for (const embedded::File& file : files) {
    const std::string_view whole = file.path;
    if (audience == Audience::kVisitors && isOperators(whole)) continue;
    const auto [name, coding] = codingOf(whole);
    Page& page = pages_[std::string("/").append(name)];
    page.type = typeOf(name);
    page.representations.push_back({coding, tagOf(file.text()), file.text()});
  }
  for (auto& [path, page] : pages_) {
    std::ranges::sort(page.representations, {}, [](const Representation& one) { return one.body.size(); });
  }
}

PageReply WebPages::answer(const PageRequest& request) const {
  PageReply reply;
  if (request.method != "GET" && request.method != "HEAD") {
    reply.status = 405;
    reply.body = "only GET and HEAD\n";
    return reply;
  }
  const std::string_view path = fileOf(request.path, audience_);
  const auto found = pages_.find(path);
  if (path == "/healthz") {
    reply.body = "ok";
  } else if (found == pages_.end()) {
    reply = represent(pages_.find(kNotFound)->second, request.acceptEncoding);
    reply.status = 404;
  } else {
    reply = represent(found->second, request.acceptEncoding);
    reply.isForGood = path.starts_with(kHashed);
    if (isNamed(request.ifNoneMatch, reply.etag)) reply.status = 304;
  }
  reply.sendBody = request.method == "GET" && reply.status != 304;
  return reply;
}

PageReply WebPages::represent(const Page& page, std::string_view acceptEncoding) {
  // A client that accepts none of them, not even identity, gets a page rather than a refusal.
  const Representation* best = &page.representations.back();
  int weight = 0;
  for (const Representation& one : page.representations) {
    const int its = codingWeight(acceptEncoding, one.coding);
    if (its > weight) {
      best = &one;
      weight = its;
    }
  }
  PageReply reply;
  reply.type = page.type;
  reply.etag = best->etag;
  reply.body = best->body;
  reply.variesByCoding = true;
  if (best->coding != kIdentity) reply.coding = best->coding;
  return reply;
}

}  // namespace grove::stream

#include "stream/web_server/pages/http_service.h"

#include <algorithm>
#include <array>
#include <utility>

#include "pipeline/clocks.h"
#include "pipeline/embedded.h"
#include "stream/web_server/wsi.h"

namespace grove::stream {
namespace {

constexpr std::size_t kChunk = 16 * 1024;

}  // namespace

bool HttpService::writeHeaders(lws* wsi, const PageReply& reply) const {
  std::array<unsigned char, LWS_PRE + 2048> buffer{};
  unsigned char* const begin = buffer.data() + LWS_PRE;
  unsigned char* const end = buffer.data() + buffer.size();
  unsigned char* at = begin;
  const auto add = [&](lws_token_indexes token, std::string_view value) {
    const auto* bytes = reinterpret_cast<const unsigned char*>(value.data());
    return lws_add_http_header_by_token(wsi, token, bytes, static_cast<int>(value.size()), &at, end) == 0;
  };
  const std::string_view cache = reply.isForGood ? "public, max-age=31536000, immutable" : "no-cache";
  return lws_add_http_common_headers(wsi, static_cast<unsigned>(reply.status), std::string(reply.type).c_str(),
                                     reply.body.size(), &at, end) == 0 &&
         (reply.etag.empty() || add(WSI_TOKEN_HTTP_ETAG, reply.etag)) &&
         (reply.location.empty() || add(WSI_TOKEN_HTTP_LOCATION, reply.location)) &&
         // Not by plain http, where an attacker could have written it (RFC 6797, 7.2).
         (hsts_.empty() || !isSecure(wsi) || add(WSI_TOKEN_HTTP_STRICT_TRANSPORT_SECURITY, hsts_)) &&
         (reply.coding.empty() || add(WSI_TOKEN_HTTP_CONTENT_ENCODING, reply.coding)) &&
         (!reply.variesByCoding || add(WSI_TOKEN_HTTP_VARY, "accept-encoding")) &&
         add(WSI_TOKEN_HTTP_CACHE_CONTROL, cache) && lws_finalize_write_http_header(wsi, begin, &at, end) == 0;
}

HttpService::HttpService(Audience audience, std::optional<int> hsts)
    : audience_(audience), pages_(embedded::web(), audience), hsts_(hsts ? "max-age=" + std::to_string(*hsts) : "") {}

int HttpService::answer(lws* wsi, std::optional<PageReply> refusal) {
  const std::string getPath = header(wsi, WSI_TOKEN_GET_URI);
  const std::string headPath = header(wsi, WSI_TOKEN_HEAD_URI);
  const std::string_view method = !getPath.empty() ? "GET" : !headPath.empty() ? "HEAD" : "another";
  const std::string& path = getPath.empty() ? headPath : getPath;
  Answer answer;
  answer.reply = pages_.answer(
      {method, path, header(wsi, WSI_TOKEN_HTTP_IF_NONE_MATCH), header(wsi, WSI_TOKEN_HTTP_ACCEPT_ENCODING)});
  // The body of such a request is not read, so the next request cannot be found.
  answer.isLast = method == "another";
  if (refusal) {
    answer.reply = std::move(*refusal);
    answer.reply.sendBody = method == "GET";
  } else if (!answer.isLast && LiveReports::has(path, audience_) && reports_ == nullptr) {
    answer.reply = {HTTP_STATUS_SERVICE_UNAVAILABLE, "text/plain; charset=utf-8", "", "the world is being prepared\n",
                    method == "GET"};
  } else if (!answer.isLast && LiveReports::has(path, audience_)) {
    answer.reply = {HTTP_STATUS_OK, "application/json", "", "", method == "GET"};
    answer.waitsFor = path;
    answer.asked = pipeline::wallSeconds();
  }
  answers_[wsi] = std::move(answer);
  return resume(wsi);
}

int HttpService::resume(lws* wsi) {
  const auto found = answers_.find(wsi);
  if (found == answers_.end()) return 0;
  Answer& answer = found->second;
  if (!answer.waitsFor.empty()) {
    answer.report = reports_->find(answer.waitsFor, answer.asked);
    lws_set_timeout(wsi, PENDING_TIMEOUT_HTTP_CONTENT, kHttpSeconds);
    if (!answer.report) return 0;
    answer.waitsFor.clear();
    answer.reply.body = *answer.report;
  }
  if (!answer.begun) return begin(wsi, answer);
  const std::string_view chunk = answer.rest.substr(0, kChunk);
  answer.rest.remove_prefix(chunk.size());
  std::array<unsigned char, LWS_PRE + kChunk> buffer;
  std::copy(chunk.begin(), chunk.end(), buffer.begin() + LWS_PRE);
  const lws_write_protocol kind = answer.rest.empty() ? LWS_WRITE_HTTP_FINAL : LWS_WRITE_HTTP;
  if (lws_write(wsi, buffer.data() + LWS_PRE, chunk.size(), kind) < 0) return -1;
  if (answer.rest.empty()) return finish(wsi);
  lws_set_timeout(wsi, PENDING_TIMEOUT_HTTP_CONTENT, kHttpSeconds);
  lws_callback_on_writable(wsi);
  return 0;
}

int HttpService::begin(lws* wsi, Answer& answer) {
  answer.begun = true;
  if (!writeHeaders(wsi, answer.reply)) return -1;
  if (!answer.reply.sendBody || answer.reply.body.empty()) return finish(wsi);
  answer.rest = answer.reply.body;
  lws_callback_on_writable(wsi);
  return 0;
}

int HttpService::finish(lws* wsi) {
  const bool isLast = answers_.at(wsi).isLast;
  answers_.erase(wsi);
  if (isLast) return -1;
  return lws_http_transaction_completed(wsi) != 0 ? -1 : 0;
}

void HttpService::wakeWaiting() {
  for (const auto& [wsi, answer] : answers_) {
    if (!answer.waitsFor.empty()) lws_callback_on_writable(wsi);
  }
}

}  // namespace grove::stream

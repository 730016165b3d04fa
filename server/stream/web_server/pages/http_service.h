#pragma once

#include <libwebsockets.h>

#include <map>
#include <optional>
#include <string>
#include <string_view>

#include "stream/web_server/pages/live_reports.h"
#include "stream/web_server/pages/web_pages.h"

namespace grove::stream {

/// Timeout of an HTTP request or response without progress, seconds.
inline constexpr int kHttpSeconds = 10;

/// Serves the http requests of one listener: pages, and reports once there is a world. On libwebsockets' thread only;
/// each method returns what the library's callback must return.
class HttpService {
 public:
  /// `hsts`: max-age of Strict-Transport-Security, seconds; none: no such header.
  HttpService(Audience audience, std::optional<int> hsts);

  /// From now on reports can be served; `reports` outlives this.
  void open(LiveReports& reports) noexcept { reports_ = &reports; }

  /// Handles a request; sends `refusal` instead if there is one.
  int answer(lws* wsi, std::optional<PageReply> refusal);
  /// The socket is writable: sends more of a response.
  int resume(lws* wsi);
  /// A report is ready: resumes the requests that wait for one.
  void wakeWaiting();
  /// Returns whether a response is in progress.
  [[nodiscard]] bool isAnswering(lws* wsi) const { return answers_.contains(wsi); }
  /// The socket is closed.
  void forget(lws* wsi) { answers_.erase(wsi); }

 private:
  struct Answer {
    PageReply reply;
    bool begun = false;
    std::string waitsFor;        ///< path of the report it waits for; empty: none
    double asked = 0.0;          ///< time of the request, of pipeline::wallSeconds()
    LiveReports::Report report;  ///< owns the reply's body
    std::string_view rest = {};  ///< of the body, not yet sent
    bool isLast = false;         ///< close the socket after this response
  };
  [[nodiscard]] bool writeHeaders(lws* wsi, const PageReply& reply) const;
  int begin(lws* wsi, Answer& answer);
  int finish(lws* wsi);

  const Audience audience_;
  const WebPages pages_;
  LiveReports* reports_ = nullptr;  ///< null until the world is ready
  const std::string hsts_;          ///< value of the header; empty: no header
  std::map<lws*, Answer> answers_;
};

}  // namespace grove::stream

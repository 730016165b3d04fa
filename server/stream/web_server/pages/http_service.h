#pragma once

#include <libwebsockets.h>

#include <map>
#include <optional>
#include <string>
#include <string_view>

#include "stream/web_server/pages/live_reports.h"
#include "stream/web_server/pages/web_pages.h"

namespace grove::stream {

/// A request or an answer over HTTP that stands still for so long is given up.
inline constexpr int kHttpSeconds = 10;

/// Answers the http requests of one listener: pages, and reports once they are made. On the library's thread only; each
/// call returns what its callback has to.
class HttpService {
 public:
  /// `hsts`: seconds for which browsers shall come by https only; none: they are not asked to.
  HttpService(Audience audience, std::optional<int> hsts);

  /// From now on there are reports; they outlive it.
  void open(LiveReports& reports) noexcept { reports_ = &reports; }

  /// A request has come. `refusal` is answered instead, if there is one.
  int answer(lws* wsi, std::optional<PageReply> refusal);
  /// There is room for more of an answer.
  int resume(lws* wsi);
  /// A report is there: who waits for one is served.
  void wakeWaiting();
  /// Whether an answer is on its way.
  [[nodiscard]] bool isAnswering(lws* wsi) const { return answers_.contains(wsi); }
  /// The socket is gone.
  void forget(lws* wsi) { answers_.erase(wsi); }

 private:
  struct Answer {
    PageReply reply;
    bool begun = false;
    std::string waitsFor;        ///< path of a report; empty: for nothing
    double asked = 0.0;          ///< when it was
    LiveReports::Report report;  ///< owns the reply's body
    std::string_view rest = {};  ///< of the body
    bool isLast = false;         ///< of this socket
  };
  [[nodiscard]] bool writeHeaders(lws* wsi, const PageReply& reply) const;
  int begin(lws* wsi, Answer& answer);
  int finish(lws* wsi);

  const Audience audience_;
  const WebPages pages_;
  LiveReports* reports_ = nullptr;  ///< null until the world is ready
  const std::string hsts_;          ///< a header's value; empty: there is none
  std::map<lws*, Answer> answers_;
};

}  // namespace grove::stream

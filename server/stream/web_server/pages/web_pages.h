#pragma once

#include <functional>
#include <map>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "pipeline/embedded.h"
#include "stream/web_server/audience.h"

namespace grove::stream {

/// A request; headers that it lacks are empty.
struct PageRequest {
  std::string_view method;  ///< "GET", "HEAD" or anything else
  std::string_view path;    ///< without query
  std::string_view ifNoneMatch = {};
  std::string_view acceptEncoding = {};
};

/// The reply to an http request.
struct PageReply {
  int status = 200;
  std::string_view type = "text/plain; charset=utf-8";
  std::string_view etag;  ///< empty: none
  std::string_view body;  ///< its length is sent even if the body is not (HEAD)
  bool sendBody = true;
  std::string location = {};     ///< redirects there; empty: no redirect
  std::string_view coding = {};  ///< of the body; empty: none
  bool variesByCoding = false;   ///< another Accept-Encoding may get another body
  bool isForGood = false;        ///< immutable: the content of this path never changes
};

/// The page's files, embedded in the program: only their exact names exist, so no path leads elsewhere. Some are for
/// the operator only. Each file exists uncompressed and compressed (server/cmake/web.cmake): `main.js`, `main.js.gz`
/// and `main.js.br` are one page, and a client gets the smallest of the codings that it prefers most.
class WebPages {
 public:
  WebPages(std::span<const embedded::File> files, Audience audience);

  [[nodiscard]] PageReply answer(const PageRequest& request) const;

 private:
  struct Representation {
    std::string_view coding;  ///< "gzip", "br" or "identity"
    std::string etag;
    std::string_view body;
  };
  struct Page {
    std::string_view type;
    std::vector<Representation> representations;  ///< smallest first
  };
  [[nodiscard]] static PageReply represent(const Page& page, std::string_view acceptEncoding);

  const Audience audience_;
  std::map<std::string, Page, std::less<>> pages_;
};

}  // namespace grove::stream

#pragma once

#include <functional>
#include <map>
#include <span>
#include <string>
#include <string_view>

#include "pipeline/embedded.h"
#include "stream/web_server/audience.h"

namespace grove::stream {

/// What to answer an http request with.
struct PageReply {
  int status = 200;
  std::string_view type = "text/plain; charset=utf-8";
  std::string_view etag;  ///< empty: none
  std::string_view body;  ///< its length is announced even if it is not sent
  bool sendBody = true;
  std::string location = {};  ///< where to ask instead; empty: nowhere else
};

/// The page's files, which lie in the program: only their exact names exist, so no path leads elsewhere. The operator's
/// are for the operator only.
class WebPages {
 public:
  WebPages(std::span<const embedded::File> files, Audience audience);

  /// `method` is "GET", "HEAD" or anything else; `path` is without query; `ifNoneMatch` is the header or empty.
  [[nodiscard]] PageReply answer(std::string_view method, std::string_view path, std::string_view ifNoneMatch) const;

 private:
  struct Page {
    std::string_view type;
    std::string etag;
    std::string_view body;
  };
  const Audience audience_;
  std::map<std::string, Page, std::less<>> pages_;
};

}  // namespace grove::stream

#include <zlib.h>

#include <map>

#include "stream/web_server/pages/page_paths.h"
#include "stream/web_server/served_world.h"

namespace grove::stream {
namespace {

/// The page as it travels.
class CompressedPages : public ServedWorld {
 protected:
  HttpAnswer get(const std::string& path, const std::string& acceptEncoding, const std::string& more = "") {
    return request(port(), "GET", path, "Accept-Encoding: " + acceptEncoding + "\r\n" + more);
  }
};

/// Of a header, in lower case; empty if there is none.
std::string value(const HttpAnswer& answer, const std::string& name) {
  const std::size_t at = answer.head.find("\r\n" + name + ": ");
  if (at == std::string::npos) return {};
  const std::size_t begin = at + name.size() + 4;
  return answer.head.substr(begin, answer.head.find("\r\n", begin) - begin);
}

std::string unpacked(const std::string& gzip) {
  std::string text(1'000'000, '\0');
  z_stream stream{};
  EXPECT_EQ(inflateInit2(&stream, 16 + MAX_WBITS), Z_OK);
  stream.next_in = reinterpret_cast<Bytef*>(const_cast<char*>(gzip.data()));
  stream.avail_in = static_cast<uInt>(gzip.size());
  stream.next_out = reinterpret_cast<Bytef*>(text.data());
  stream.avail_out = static_cast<uInt>(text.size());
  EXPECT_EQ(inflate(&stream, Z_FINISH), Z_STREAM_END);
  text.resize(stream.total_out);
  inflateEnd(&stream);
  return text;
}

TEST_F(CompressedPages, DecompressToTheOriginals) {
  for (const std::string& path : {std::string("/"), pathOf("main.js"), pathOf("style.css"), pathOf("icon.svg")}) {
    const HttpAnswer plain = get(path, "identity");
    const HttpAnswer gzip = get(path, "gzip");
    EXPECT_EQ(value(plain, "content-encoding"), "") << path;
    EXPECT_EQ(value(gzip, "content-encoding"), "gzip") << path;
    EXPECT_EQ(unpacked(gzip.body), plain.body) << path;
    EXPECT_EQ(value(gzip, "content-type"), value(plain, "content-type")) << path;
  }
}

TEST_F(CompressedPages, AreSentOnlyIfAccepted) {
  const std::map<std::string, std::string> wanted = {
      {"gzip, deflate", "gzip"},
      {"gzip, deflate, br, zstd", "br"},
      {"gzip;q=1, br;q=0.5", "gzip"},
      {"*", "br"},
      {"br;q=0, *", "gzip"},
      {"deflate", ""},
      {"", ""},
      {"gzip;q=0", ""},
      {"identity, gzip;q=0.5", ""},
      {"gzip;q=0, br;q=0", ""},
      {"identity;q=0, gzip", "gzip"},
      {"gzip;q=seven", ""},
      {"identity;q=0, *;q=0", ""},
      {"gzip;q=0.5, br;q=0.4", "gzip"},
      {std::string(2000, ','), ""},
  };
  const std::string path = pathOf("main.js");
  for (const auto& [accepted, coding] : wanted) {
    const HttpAnswer answer = get(path, accepted);
    EXPECT_EQ(answer.status, 200) << accepted;
    EXPECT_EQ(value(answer, "content-encoding"), coding) << accepted;
    EXPECT_EQ(value(answer, "content-length"), std::to_string(answer.body.size())) << accepted;
    EXPECT_EQ(value(answer, "vary"), "accept-encoding") << accepted;
  }
  EXPECT_EQ(value(request(port(), "GET", path), "content-encoding"), "") << "who says nothing gets it as it is";
  EXPECT_EQ(value(get(path, "gzip;q=0", "Accept-Encoding: br\r\n"), "content-encoding"), "br")
      << "one list in two lines";
}

/// With one tag for all, a cache would hand the packed page to who cannot unpack it.
TEST_F(CompressedPages, HaveTheirOwnEtags) {
  const std::string path = pathOf("style.css");
  const std::string plain = value(get(path, "identity"), "etag");
  const std::string gzip = value(get(path, "gzip"), "etag");
  EXPECT_NE(plain, gzip);
  EXPECT_EQ(get(path, "gzip", "If-None-Match: " + gzip + "\r\n").status, 304);
  EXPECT_EQ(get(path, "gzip", "If-None-Match: \"other\", W/" + gzip + "\r\n").status, 304) << "as proxies weaken it";
  EXPECT_EQ(get(path, "gzip", "If-None-Match: *\r\n").status, 304);
  EXPECT_EQ(get(path, "gzip", "If-None-Match: " + plain + "\r\n").status, 200);
  EXPECT_EQ(get(path, "identity", "If-None-Match: " + gzip + "\r\n").status, 200);
}

TEST_F(CompressedPages, HeadAndNotModifiedMatchGet) {
  const std::string path = pathOf("main.js");
  const std::string accept = "Accept-Encoding: gzip\r\n";
  const HttpAnswer whole = request(port(), "GET", path, accept);
  const HttpAnswer head = request(port(), "HEAD", path, accept);
  const HttpAnswer same = request(port(), "GET", path, accept + "If-None-Match: " + value(whole, "etag") + "\r\n");
  EXPECT_EQ(same.status, 304);
  for (const HttpAnswer& answer : {head, same}) {
    EXPECT_TRUE(answer.body.empty());
    for (const char* name : {"content-length", "content-encoding", "vary", "etag", "cache-control"}) {
      EXPECT_EQ(value(answer, name), value(whole, name)) << name;
    }
  }
}

TEST_F(CompressedPages, HashedAddressesAreImmutable) {
  const std::string forGood = "public, max-age=31536000, immutable";
  EXPECT_EQ(value(get(pathOf("main.js"), "gzip"), "cache-control"), forGood);
  EXPECT_EQ(value(get("/", "gzip"), "cache-control"), "no-cache") << "names the others";
  const HttpAnswer old = get("/v/0123456789abcdef/main.js", "gzip");
  EXPECT_EQ(old.status, 404) << "a page of another version must not be given ours, nor keep it";
  EXPECT_EQ(value(old, "cache-control"), "no-cache");
  EXPECT_EQ(get(pathOf("main.js") + ".gz", "gzip").status, 404) << "no page of its own";
}

TEST_F(CompressedPages, MissingPageLinksHome) {
  const HttpAnswer missing = get("/no/such/page", "identity");
  EXPECT_EQ(missing.status, 404);
  EXPECT_EQ(value(missing, "content-type"), "text/html; charset=utf-8");
  EXPECT_NE(missing.body.find("href=\"/\""), std::string::npos);
  EXPECT_NE(missing.body.find(pathOf("not_found.css")), std::string::npos) << "by its whole path, from any folder";
  EXPECT_EQ(get("/no/such/page", "identity", "If-None-Match: " + value(missing, "etag") + "\r\n").status, 404);
}

}  // namespace
}  // namespace grove::stream

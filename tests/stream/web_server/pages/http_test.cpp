#include <chrono>
#include <nlohmann/json.hpp>
#include <thread>
#include <vector>

#include "base/version.h"
#include "pipeline/embedded.h"
#include "stream/web_server/pages/page_paths.h"
#include "stream/web_server/served_world.h"

namespace grove::stream {
namespace {

using Http = ServedWorld;

bool contains(const std::string& text, std::string_view part) { return text.find(part) != std::string::npos; }

TEST_F(Http, ServesThePage) {
  const HttpAnswer page = request(port(), "GET", "/");
  EXPECT_EQ(page.status, 200);
  EXPECT_TRUE(contains(page.head, "content-type: text/html"));
  EXPECT_TRUE(contains(page.head, "content-security-policy: default-src 'self'; connect-src 'self' ws: wss:;"));
  EXPECT_TRUE(contains(page.head, "x-content-type-options: nosniff"));
  EXPECT_TRUE(contains(page.head, "referrer-policy: no-referrer"));
  EXPECT_TRUE(contains(page.head, "cache-control: no-cache"));
  EXPECT_TRUE(contains(page.body, "</html>"));
  EXPECT_EQ(request(port(), "GET", "/?name=Ada").body, page.body);
}

TEST_F(Http, ServesTheOperatorsPageToTheOperatorOnly) {
  const HttpAnswer page = request(operatorPort(), "GET", "/operator");
  EXPECT_EQ(page.status, 200);
  EXPECT_TRUE(contains(page.head, "content-type: text/html"));
  EXPECT_TRUE(contains(page.head, "content-security-policy: default-src 'self';"));
  EXPECT_TRUE(contains(page.body, "operator.js"));
  EXPECT_EQ(request(operatorPort(), "GET", "/operator.html").body, page.body);
  EXPECT_EQ(request(operatorPort(), "GET", "/").body, page.body);
  EXPECT_EQ(request(operatorPort(), "GET", "/operator/").status, 404) << "one address for one page";
  std::vector<std::string> paths{"/operator", "/statistics.json", "/trace.json"};
  for (const std::string& path : pagePaths()) {
    if (contains(path, "/operator")) paths.push_back(path);
  }
  EXPECT_GE(paths.size(), 7U) << "html, js and two css";
  for (const std::string& path : paths) {
    EXPECT_EQ(request(port(), "GET", path).status, 404) << path;
    EXPECT_EQ(request(operatorPort(), "GET", path).status, 200) << path;
  }
}

TEST_F(Http, TheOperatorsListenerHasNoWorld) {
  const std::string upgrade =
      "Connection: Upgrade\r\nUpgrade: websocket\r\nSec-WebSocket-Version: 13\r\n"
      "Sec-WebSocket-Protocol: grove.v1\r\nSec-WebSocket-Key: dGhlIHNhbXBsZSBub25jZQ==\r\n";
  RawSocket socket(operatorPort());
  socket.send("GET / HTTP/1.1\r\nHost: localhost\r\n" + upgrade + "\r\n");
  EXPECT_EQ(socket.receive().substr(8, 4), " 404");
}

TEST_F(Http, ServesEveryFileWholeAndWithItsType) {
  for (const embedded::File& file : embedded::web()) {
    const std::string path = std::string("/") + file.path;
    if (isCompressed(path)) continue;
    const HttpAnswer answer = request(operatorPort(), "GET", path);
    EXPECT_EQ(answer.status, 200) << path;
    EXPECT_EQ(answer.body, file.text()) << path;
    EXPECT_FALSE(contains(answer.head, "application/octet-stream")) << path;
    if (!contains(path, "/operator")) {
      EXPECT_EQ(request(port(), "GET", path).body, file.text()) << path;
    }
  }
  EXPECT_TRUE(contains(request(port(), "GET", pathOf("main.js")).head, "content-type: text/javascript"));
  EXPECT_TRUE(contains(request(port(), "GET", pathOf("style.css")).head, "content-type: text/css"));
}

TEST_F(Http, AnswersHeadWithoutBody) {
  const HttpAnswer page = request(port(), "GET", "/");
  const HttpAnswer head = request(port(), "HEAD", "/");
  EXPECT_EQ(head.status, 200);
  EXPECT_TRUE(head.body.empty());
  EXPECT_TRUE(contains(head.head, "content-length: " + std::to_string(page.body.size())));
}

TEST_F(Http, AnswersNotModified) {
  const HttpAnswer page = request(port(), "GET", pathOf("main.js"));
  const std::size_t at = page.head.find("etag: ");
  ASSERT_NE(at, std::string::npos);
  const std::string tag = page.head.substr(at + 6, page.head.find("\r\n", at) - at - 6);
  EXPECT_EQ(request(port(), "GET", pathOf("main.js"), "If-None-Match: " + tag + "\r\n").status, 304);
  EXPECT_EQ(request(port(), "GET", pathOf("main.js"), "If-None-Match: \"other\"\r\n").status, 200);
}

TEST_F(Http, ReportsHealth) {
  const HttpAnswer answer = request(port(), "GET", "/healthz");
  EXPECT_EQ(answer.status, 200);
  EXPECT_EQ(answer.body, "ok");
}

TEST_F(Http, ReportsStatistics) {
  const HttpAnswer answer = request(operatorPort(), "GET", "/statistics.json");
  EXPECT_EQ(answer.status, 200);
  EXPECT_TRUE(contains(answer.head, "content-type: application/json"));
  const auto statistics = nlohmann::json::parse(answer.body);
  EXPECT_EQ(statistics.at("version"), version());
  EXPECT_EQ(statistics.at("visitors"), 0);
  EXPECT_TRUE(statistics.at("stages").is_object());
  EXPECT_TRUE(statistics.at("counters").is_object());
  EXPECT_TRUE(statistics.at("amortization").is_null()) << "nobody is served";
  EXPECT_GT(statistics.at("memory").at("resident_mb"), 1.0);
  EXPECT_TRUE(statistics.at("memory").at("holders").is_array());
  const HttpAnswer head = request(operatorPort(), "HEAD", "/statistics.json");
  EXPECT_EQ(head.status, 200);
  EXPECT_TRUE(head.body.empty());
}

TEST_F(Http, ReportsSharingToVisitors) {
  for (const int at : {port(), operatorPort()}) {
    const auto reported = nlohmann::json::parse(request(at, "GET", "/sharing.json").body);
    EXPECT_EQ(reported.at("version"), version());
    EXPECT_TRUE(reported.at("counters").is_object());
    EXPECT_TRUE(reported.contains("amortization"));
    EXPECT_FALSE(reported.contains("memory")) << "that is the operator's";
  }
}

TEST_F(Http, ConcurrentRequestsShareOneReport) {
  GoodClient visitor(port());
  ASSERT_TRUE(visitor.receiveFrames(5));
  std::vector<RawSocket> readers;
  readers.reserve(30);
  for (int i = 0; i < 30; ++i) readers.emplace_back(operatorPort());
  for (RawSocket& reader : readers) {
    reader.send("GET /trace.json HTTP/1.1\r\nHost: localhost\r\nConnection: close\r\n\r\n");
  }
  const std::string first = readers.front().receiveAll();
  EXPECT_TRUE(contains(first, "traceEvents"));
  for (std::size_t i = 1; i < readers.size(); ++i) EXPECT_TRUE(readers[i].receiveAll() == first) << i;
  std::this_thread::sleep_for(std::chrono::milliseconds(1100));
  ASSERT_TRUE(visitor.receiveFrames(1));
  EXPECT_NE(request(operatorPort(), "GET", "/trace.json").body, first.substr(first.find("\r\n\r\n") + 4))
      << "made anew after a second";
}

TEST_F(Http, AnswersPipelinedRequestsInOrder) {
  RawSocket socket(operatorPort());
  std::string requests;
  for (const char* path : {"/statistics.json", "/healthz", "/sharing.json"}) {
    requests.append("GET ").append(path).append(" HTTP/1.1\r\nHost: localhost\r\n\r\n");
  }
  socket.send(requests + "GET /healthz HTTP/1.1\r\nHost: localhost\r\nConnection: close\r\n\r\n");
  const std::string all = socket.receiveAll();
  const std::size_t statistics = all.find("\"stages\"");
  const std::size_t well = all.find("\r\n\r\nok", statistics);
  EXPECT_NE(statistics, std::string::npos);
  EXPECT_NE(well, std::string::npos);
  EXPECT_NE(all.find("\"version\"", well), std::string::npos);
  EXPECT_TRUE(all.ends_with("ok"));
}

TEST_F(Http, NotFound) {
  for (const char* path : {"/nothing", "/../CMakeLists.txt", "/%2e%2e/%2e%2e/etc/passwd", "/input/../../etc/passwd",
                           "/input/..%2f..%2fetc/passwd", "//etc/passwd", "/main.js%00.html"}) {
    const int status = request(port(), "GET", path).status;
    EXPECT_TRUE(status == 404 || status == 403 || status == 0) << path << " " << status;
  }
  EXPECT_EQ(request(port(), "GET", "/nothing").status, 404);
  EXPECT_EQ(request(port(), "GET", "/..").body, request(port(), "GET", "/").body);
  EXPECT_EQ(request(port(), "GET", "/healthz").status, 200);
}

TEST_F(Http, RefusesOtherMethods) {
  const auto refused = request(port(), "POST", "/", "Content-Length: 3\r\n");
  EXPECT_EQ(refused.status, 405);
  EXPECT_EQ(refused.body, "only GET and HEAD\n") << "whole, as long as it announces";
  EXPECT_EQ(request(port(), "DELETE", pathOf("main.js")).status, 405);
  EXPECT_EQ(request(port(), "GET", "/healthz").status, 200);
}

TEST_F(Http, KeepsConnectionsAlive) {
  RawSocket socket(port());
  const std::string text = "GET /healthz HTTP/1.1\r\nHost: localhost\r\n\r\n";
  for (int i = 0; i < 3; ++i) {
    socket.send(text);
    std::string answer;
    while (!answer.ends_with("\r\n\r\nok")) {
      const std::string more = socket.receive();
      ASSERT_FALSE(more.empty());
      answer += more;
    }
  }
}

TEST_F(Http, RefusesForeignHostNames) {
  const auto ask = [&](const std::string& host, const std::string& more) {
    RawSocket socket(port());
    socket.send("GET / HTTP/1.1\r\nHost: " + host + "\r\n" + more + "\r\n");
    return socket.receive().substr(0, 12);
  };
  const std::string close = "Connection: close\r\n";
  for (const char* host : {"localhost:8080", "LOCALHOST", "127.0.0.1", "192.168.1.7:8080", "[::1]:8080"}) {
    EXPECT_EQ(ask(host, close), "HTTP/1.1 200") << host;
  }
  for (const char* host :
       {"rebound.example", "rebound.example:8080", "localhost.rebound.example", "1.2.3.4.example", "[rebound]", "["}) {
    EXPECT_NE(ask(host, close), "HTTP/1.1 200") << host;
  }
  const std::string upgrade =
      "Connection: Upgrade\r\nUpgrade: websocket\r\nSec-WebSocket-Version: 13\r\nSec-WebSocket-Protocol: grove.v1\r\n"
      "Sec-WebSocket-Key: dGhlIHNhbXBsZSBub25jZQ==\r\nOrigin: http://";
  EXPECT_EQ(ask("localhost", upgrade + "localhost\r\n"), "HTTP/1.1 101");
  EXPECT_NE(ask("rebound.example", upgrade + "rebound.example\r\n"), "HTTP/1.1 101");
}

TEST_F(Http, ChoosesTheFirstKnownSubProtocol) {
  const auto agreed = [&](const std::string& offered) {
    RawSocket socket(port());
    socket.send(
        "GET / HTTP/1.1\r\nHost: localhost\r\nConnection: Upgrade\r\nUpgrade: websocket\r\n"
        "Sec-WebSocket-Version: 13\r\nSec-WebSocket-Key: dGhlIHNhbXBsZSBub25jZQ==\r\nSec-WebSocket-Protocol: " +
        offered + "\r\n\r\n");
    const std::string answer = socket.receive();
    const std::string name = "Sec-WebSocket-Protocol: ";
    const std::size_t at = answer.find(name);
    if (at == std::string::npos) return std::string("none");
    return answer.substr(at + name.size(), answer.find('\r', at) - at - name.size());
  };
  EXPECT_EQ(agreed("grove.v1.1, grove.v1"), "grove.v1.1");
  EXPECT_EQ(agreed("grove.v1"), "grove.v1") << "older pages";
  EXPECT_EQ(agreed("grove.v9, grove.v1"), "grove.v1") << "newer pages";
}

/// A proxy that goes by the first would let through what the server takes for a request of the second.
TEST_F(Http, RefusesTwoHostHeaders) {
  EXPECT_EQ(request(port(), "GET", "/healthz", "Host: evil.example\r\n").status, 400);
  EXPECT_EQ(request(port(), "GET", "/healthz", "Host: localhost\r\n").status, 400);
  EXPECT_EQ(RawWebsocket(port(), "Host: localhost\r\n").status(), 400);
  EXPECT_EQ(request(port(), "GET", "/healthz").status, 200);
}

}  // namespace
}  // namespace grove::stream

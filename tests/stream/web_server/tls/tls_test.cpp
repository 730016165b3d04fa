#include <gmock/gmock.h>

#include <chrono>

#include "base/tls/certificates.h"
#include "eventually.h"
#include "stream/load/load_client.h"
#include "stream/web_server/served_world.h"

namespace grove::stream {
namespace {

using testing::HasSubstr;
using testing::Not;

/// A second server of the same world, which takes TLS.
class Tls : public ServedWorld {
 protected:
  Tls() { secure_.start(); }

  static TlsFiles written(const TlsFiles& files, const CertificateWish& wish) {
    writePair(files, wish);
    return files;
  }
  [[nodiscard]] std::string host() const { return "localhost:" + std::to_string(secure_.port()); }
  [[nodiscard]] RawSocket connect() const {
    RawSocket socket(secure_.port());
    EXPECT_TRUE(socket.startTls());
    return socket;
  }
  [[nodiscard]] HttpAnswer ask(RawSocket socket, const std::string& method, const std::string& path) const {
    return request(socket, method, path, "Host: " + host() + "\r\n");
  }
  [[nodiscard]] RawWebsocket websocket(const std::string& origin) const {
    return {connect(), host(), "Origin: " + origin + "\r\n"};
  }

  TestFolder folder_;
  const TlsFiles files_ = written({folder_.file("cert.pem"), folder_.file("key.pem")}, {.name = "first"});
  const std::shared_ptr<TlsStore> store_ = std::make_shared<TlsStore>(files_);
  WebsocketServer secure_{host_,
                          {.visitors = {"127.0.0.1", 0},
                           .operators = {},
                           .rules = {.allowance = {.socketsPerSecond = 20, .burst = 400}},
                           .tls = store_,
                           .hsts = 600}};
};

TEST_F(Tls, ServesPageAndSocketOnOnePort) {
  const HttpAnswer page = ask(connect(), "GET", "/");
  EXPECT_EQ(page.status, 200);
  EXPECT_EQ(page.body, request(port(), "GET", "/").body);
  EXPECT_THAT(page.head, HasSubstr("strict-transport-security: max-age=600\r\n"));
  EXPECT_THAT(request(port(), "GET", "/").head, Not(HasSubstr("strict-transport"))) << "only who asks for it";
  GoodClient client(websocket("https://" + host()));
  ASSERT_EQ(client.websocket().status(), 101);
  EXPECT_TRUE(client.receiveFrames(5));
}

TEST_F(Tls, SendsFramesOverPartialWrites) {
  RawSocket socket(secure_.port(), 4096);
  ASSERT_TRUE(socket.startTls());
  GoodClient client(RawWebsocket(std::move(socket), host(), ""), 1280, 720);
  EXPECT_TRUE(client.receiveFrames(10));
}

TEST_F(Tls, RedirectsPlainHttp) {
  const auto plain = [&](const std::string& method, const std::string& target, const std::string& headers) {
    RawSocket socket(secure_.port());
    return request(socket, method, target, headers);
  };
  const HttpAnswer page = plain("GET", "/a%20b?name=Ad%20a&x=1%0d%0aevil:%201", "Host: " + host() + "\r\n");
  EXPECT_EQ(page.status, 301);
  EXPECT_THAT(page.head, HasSubstr("location: https://" + host() + "/a%20b"));
  EXPECT_THAT(page.head, Not(HasSubstr("\r\nevil"))) << "what was asked for is no header of the answer";
  EXPECT_THAT(page.head, Not(HasSubstr("strict-transport"))) << "by http anybody could say so";
  EXPECT_THAT(plain("GET", "/?name=Ada&x=1", "Host: " + host() + "\r\n").head,
              HasSubstr("location: https://" + host() + "/?name=ada&x=1\r\n"));
  EXPECT_EQ(plain("GET", "/", "Host: rebound.example\r\n").status, 403);
  EXPECT_EQ(plain("GET", "/", "Host: 127.0.0.1:80\"><script>\r\n").status, 400);
  EXPECT_NE(plain("GET", "/", "").status, 301) << "without a host there is no address";
  RawWebsocket websocket(RawSocket(secure_.port()), host(), "");
  EXPECT_EQ(websocket.status(), 403) << "no visitor comes in the clear";
}

TEST_F(Tls, UsesModernTlsWithoutHttp2) {
  RawSocket modern(secure_.port());
  ASSERT_TRUE(modern.startTls(std::string_view("\x02h2\x08http/1.1", 12)));
  EXPECT_STREQ(SSL_get_version(modern.tls()), "TLSv1.3");
  const unsigned char* agreed = nullptr;
  unsigned length = 0;
  SSL_get0_alpn_selected(modern.tls(), &agreed, &length);
  EXPECT_EQ(std::string(reinterpret_cast<const char*>(agreed), length), "http/1.1");
  RawSocket older(secure_.port());
  ASSERT_TRUE(older.startTls("", TLS1_2_VERSION));
  EXPECT_THAT(SSL_get_cipher_name(older.tls()), testing::StartsWith("ECDHE-"));
  EXPECT_FALSE(RawSocket(secure_.port()).startTls("", TLS1_1_VERSION));
}

TEST_F(Tls, NewCertificateServesNewConnections) {
  RawSocket socket = connect();
  EXPECT_EQ(socket.certificateName(), "first");
  GoodClient old(RawWebsocket(std::move(socket), host(), ""));
  ASSERT_TRUE(old.receiveFrames(2));
  writePair(files_, {.name = "second", .rsaBits = 2048});
  store_->reload();
  EXPECT_EQ(connect().certificateName(), "second") << "a key of another kind does not stay beside it";
  EXPECT_TRUE(old.receiveFrames(5));
  writePair(files_, {.name = "third"});
  store_->look();
  store_->look();
  EXPECT_EQ(connect().certificateName(), "third");
  writePair(files_, {.name = "bad", .expiresIn = -60});
  store_->reload();
  EXPECT_EQ(connect().certificateName(), "third");
  EXPECT_TRUE(old.receiveFrames(5));
}

TEST_F(Tls, AcceptsOnlySecureOrigins) {
  EXPECT_EQ(websocket("https://" + host()).status(), 101);
  EXPECT_EQ(websocket("http://" + host()).status(), 403) << "whoever is on the way could have written that page";
  EXPECT_EQ(websocket("https://other.example").status(), 403);
}

TEST_F(Tls, OperatorListenerUsesTlsUnlessLoopback) {
  EXPECT_FALSE(secure_.isSecure(Audience::kOperator));
  EXPECT_EQ(request(secure_.operatorPort(), "GET", "/operator").status, 200);
  WebsocketServer open(host_, {.visitors = {"127.0.0.1", 0}, .operators = HostPort{"0.0.0.0", 0}, .tls = store_});
  open.start();
  EXPECT_TRUE(open.isSecure(Audience::kOperator));
  EXPECT_EQ(request(open.operatorPort(), "GET", "/operator").status, 301);
  RawSocket socket(open.operatorPort());
  ASSERT_TRUE(socket.startTls());
  EXPECT_EQ(request(socket, "GET", "/operator", "Host: localhost\r\n").status, 200);
}

/// Each waits for the rest of a handshake: the thread of all sockets must not, nor others find no place.
TEST_F(Tls, StalledHandshakesAffectNobodyElse) {
  GoodClient visitor(websocket("https://" + host()));
  ASSERT_TRUE(visitor.receiveFrames(1));
  std::vector<RawSocket> idle;
  idle.reserve(300);
  for (int i = 0; i < 300; ++i) {
    idle.emplace_back(secure_.port(), 0, "127.0.0.2");
    // The beginning of a record, or of a request, or nothing.
    if (i % 3 == 0) idle.back().send(std::string_view("\x16\x03\x01\x02\x00\x01", 6));
    if (i % 3 == 1) idle.back().send("G");
  }
  EXPECT_TRUE(visitor.receiveFrames(5));
  EXPECT_EQ(ask(connect(), "GET", "/healthz").status, 200);
  EXPECT_GE(host_.timeline().counters().at("refused connections"), 300 - 48) << "one address has no more";
}

TEST_F(Tls, GarbageEndsOnlyItsConnection) {
  GoodClient visitor(websocket("https://" + host()));
  for (const std::string_view nonsense :
       {std::string_view("\x16\x03\x01\x00\x05zzzzz", 10), std::string_view("\0\0\0\0\0\0\0\0\0\0\0", 11),
        std::string_view("\x15\x03\x03\x00\x02\x02\x28", 7), std::string_view("\xFF\xFF\xFF\xFF\xFF\xFF", 6),
        std::string_view("no request\r\n\r\n")}) {
    RawSocket socket(secure_.port());
    socket.send(nonsense);
    (void)socket.receive();
  }
  for (int i = 0; i < 5; ++i) {
    RawSocket socket(secure_.port());
    ASSERT_TRUE(socket.startTls());
    socket.reset();
  }
  EXPECT_TRUE(visitor.receiveFrames(5));
}

TEST_F(Tls, LoadClientsVerifyTheCertificate) {
  const LoadReport strict = summarise(
      runLoadClients({"127.0.0.1", secure_.port(), true}, LoadPlan{.seconds = 0.3, .width = 320, .height = 180}));
  EXPECT_EQ(strict.sessions, 0) << "nobody has signed it";
  const LoadReport lax = summarise(runLoadClients(
      {"127.0.0.1", secure_.port(), true, true}, LoadPlan{.sessions = 2, .seconds = 0.5, .width = 320, .height = 180}));
  EXPECT_EQ(lax.sessions, 2);
  EXPECT_GT(lax.frames, 0U);
}

}  // namespace
}  // namespace grove::stream

#include "stream/web_server/tls/tls_store.h"

#include <gmock/gmock.h>

#include <filesystem>
#include <optional>

#include "base/tls/certificates.h"

namespace grove::stream {
namespace {

using testing::AllOf;
using testing::HasSubstr;

class TlsStoreTest : public testing::Test {
 protected:
  TlsStoreTest() { writePair(good_); }

  /// What it logs meanwhile.
  template <class Action>
  static std::string logged(const Action& action) {
    testing::internal::CaptureStderr();
    action();
    return testing::internal::GetCapturedStderr();
  }

  TestFolder folder_;
  const TlsFiles good_{folder_.file("good.pem"), folder_.file("good.key")};
  const TlsFiles other_{folder_.file("other.pem"), folder_.file("other.key")};
};

TEST_F(TlsStoreTest, ReloadsChangedFiles) {
  TlsStore store(good_);
  const auto first = store.current();
  EXPECT_EQ(logged([&] { store.look(); }), "");
  writePair(good_, {.expiresIn = 80 * 86'400});
  EXPECT_EQ(logged([&] { store.look(); }), "") << "its key may still be on its way";
  EXPECT_EQ(store.current(), first);
  EXPECT_THAT(logged([&] { store.look(); }), HasSubstr("new connections"));
  EXPECT_NE(store.current(), first);
  EXPECT_EQ(logged([&] { store.look(); }), "");
}

TEST_F(TlsStoreTest, FollowsReplacedLinks) {
  writePair(other_);
  const TlsFiles live{folder_.file("live.pem"), folder_.file("live.key")};
  std::filesystem::create_symlink(good_.certificate, live.certificate);
  std::filesystem::create_symlink(good_.key, live.key);
  TlsStore store(live);
  const auto first = store.current();
  std::filesystem::create_symlink(other_.certificate, folder_.file("next"));
  std::filesystem::rename(folder_.file("next"), live.certificate);
  std::filesystem::create_symlink(other_.key, folder_.file("next"));
  std::filesystem::rename(folder_.file("next"), live.key);
  store.look();
  store.look();
  EXPECT_NE(store.current(), first);
}

TEST_F(TlsStoreTest, KeepsTheOldOnErrors) {
  TlsStore store(good_);
  const auto first = store.current();
  const std::string key = readFile(good_.key);
  writePair(other_);
  writeFile(good_.key, readFile(other_.key));
  EXPECT_THAT(logged([&] { store.look(), store.look(); }), AllOf(HasSubstr("not the key"), HasSubstr("stays")));
  EXPECT_EQ(logged([&] { store.look(), store.look(); }), "") << "told once";
  std::filesystem::remove(good_.key);
  EXPECT_THAT(logged([&] { store.look(), store.look(); }), AllOf(HasSubstr("No such file"), HasSubstr("stays")));
  EXPECT_THAT(logged([&] { store.reload(); }), HasSubstr("No such file")) << "who asks is told again";
  EXPECT_EQ(store.current(), first);
  writeFile(good_.key, key);
  EXPECT_THAT(logged([&] { store.look(), store.look(); }), HasSubstr("new connections"));
}

TEST_F(TlsStoreTest, WarnsBeforeExpiry) {
  writePair(good_, {.expiresIn = 15 * 86'400});
  EXPECT_EQ(logged([&] { TlsStore store(good_); }), "");
  writePair(good_, {.expiresIn = 13 * 86'400});
  std::optional<TlsStore> store;
  EXPECT_THAT(logged([&] { store.emplace(good_); }), AllOf(HasSubstr("expires on"), HasSubstr("renew")));
  EXPECT_EQ(logged([&] { store->look(); }), "") << "once a day";
}

}  // namespace
}  // namespace grove::stream

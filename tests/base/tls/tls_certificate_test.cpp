#include "base/tls/tls_certificate.h"

#include <gmock/gmock.h>
#include <openssl/pem.h>
#include <sys/stat.h>
#include <unistd.h>

#include "base/error.h"
#include "base/tls/certificates.h"

namespace grove {
namespace {

using testing::AllOf;
using testing::HasSubstr;

constexpr uid_t kNobody = 65534;

class TlsCertificateTest : public testing::Test {
 protected:
  TlsCertificateTest() { writePair(good_); }

  /// What is wrong with them; empty: nothing.
  static std::string complaint(const TlsFiles& files) {
    try {
      const TlsCertificate certificate(files, std::time(nullptr));
      return {};
    } catch (const EnvironmentError& e) {
      return e.what();
    }
  }

  TestFolder folder_;
  const TlsFiles good_{folder_.file("good.pem"), folder_.file("good.key")};
  const TlsFiles other_{folder_.file("other.pem"), folder_.file("other.key")};
};

TEST_F(TlsCertificateTest, LoadsWithItsKey) {
  EXPECT_EQ(complaint(good_), "");
  writePair(other_, {.rsaBits = 2048});
  EXPECT_EQ(complaint(other_), "");
  writeFile(good_.certificate, readFile(good_.certificate) + readFile(other_.certificate));
  EXPECT_EQ(complaint(good_), "") << "its issuer's behind it";
}

TEST_F(TlsCertificateTest, NamesAMissingFile) {
  EXPECT_THAT(complaint({folder_.file("no.pem"), good_.key}),
              AllOf(HasSubstr("--tls-cert"), HasSubstr("no.pem"), HasSubstr("No such file"), HasSubstr("PEM")));
  EXPECT_THAT(complaint({good_.certificate, folder_.file("no.key")}),
              AllOf(HasSubstr("--tls-key"), HasSubstr("no.key"), HasSubstr("No such file"), HasSubstr("PEM")));
}

TEST_F(TlsCertificateTest, NamesAnUnreadableFile) {
  EXPECT_THAT(complaint({folder_.file("."), good_.key}), AllOf(HasSubstr("--tls-cert"), HasSubstr("not a regular file")));
  const std::string pipe = folder_.file("pipe");
  ASSERT_EQ(mkfifo(pipe.c_str(), 0600), 0);
  EXPECT_THAT(complaint({good_.certificate, pipe}), AllOf(HasSubstr("--tls-key"), HasSubstr("not a regular file")));
  EXPECT_THAT(complaint({"/dev/zero", good_.key}), HasSubstr("not a regular file"));
  // Root may read everything, so it is somebody else for a moment, who may enter the folder.
  const uid_t self = geteuid();
  ASSERT_EQ(chmod(folder_.file(".").c_str(), 0755), 0);
  ASSERT_EQ(chmod(good_.certificate.c_str(), 0644), 0);
  ASSERT_EQ(chmod(good_.key.c_str(), 0), 0);
  ASSERT_EQ(seteuid(self == 0 ? kNobody : self), 0);
  const std::string found = complaint(good_);
  ASSERT_EQ(seteuid(self), 0);
  EXPECT_THAT(found, AllOf(HasSubstr("--tls-key"), HasSubstr("Permission denied")));
}

TEST_F(TlsCertificateTest, NamesMalformedFiles) {
  const std::string text = folder_.file("text");
  for (const std::string content : {"", "nonsense\n", "\x30\x82\x01\x0A"}) {
    writeFile(text, content);
    EXPECT_THAT(complaint({text, good_.key}), AllOf(HasSubstr("--tls-cert"), HasSubstr("not in PEM form")));
    EXPECT_THAT(complaint({good_.certificate, text}), AllOf(HasSubstr("--tls-key"), HasSubstr("not in PEM form")));
  }
  EXPECT_THAT(complaint({good_.key, good_.key}), AllOf(HasSubstr("--tls-cert"), HasSubstr("no readable certificate")));
  EXPECT_THAT(complaint({good_.certificate, good_.certificate}),
              AllOf(HasSubstr("--tls-key"), HasSubstr("no readable key")));
  const std::string whole = readFile(good_.certificate);
  writeFile(text, whole.substr(0, whole.size() / 2));
  EXPECT_THAT(complaint({text, good_.key}), HasSubstr("no readable certificate"));
  writeFile(text, whole + whole.substr(0, whole.size() / 2));
  EXPECT_THAT(complaint({text, good_.key}), HasSubstr("after the first is damaged"));
}

TEST_F(TlsCertificateTest, ReportsItsValidity) {
  const std::time_t now = std::time(nullptr);
  writePair(other_, {.beginsIn = -7200, .expiresIn = -3600});
  EXPECT_THAT(complaint(other_),
              AllOf(HasSubstr(other_.certificate), HasSubstr("expired on " + dateOf(now - 3600).substr(0, 10)),
                    HasSubstr("renew")));
  writePair(other_, {.beginsIn = 86'400, .expiresIn = 2 * 86'400});
  EXPECT_THAT(complaint(other_),
              AllOf(HasSubstr("not valid before " + dateOf(now + 86'400).substr(0, 10)), HasSubstr("clock")));
}

TEST_F(TlsCertificateTest, NamesAMismatchedKey) {
  for (const int bits : {0, 2048}) {
    writePair(other_, {.rsaBits = bits});
    EXPECT_THAT(complaint({good_.certificate, other_.key}),
                AllOf(HasSubstr("--tls-key " + other_.key), HasSubstr("not the key"), HasSubstr(good_.certificate)));
  }
}

TEST_F(TlsCertificateTest, NamesAnEncryptedKey) {
  writePair(other_, {.passphrase = "sesame"});
  EXPECT_THAT(complaint(other_), AllOf(HasSubstr("--tls-key"), HasSubstr("passphrase"), HasSubstr("openssl pkey")));
}

TEST_F(TlsCertificateTest, NamesAWeakKey) {
  writePair(other_, {.rsaBits = 512});
  EXPECT_THAT(complaint(other_), AllOf(HasSubstr("too small"), HasSubstr("2048")));
}

}  // namespace
}  // namespace grove

#include "base/tls/tls_authorities.h"

#include <gmock/gmock.h>

#include "base/error.h"
#include "base/tls/certificates.h"

namespace grove {
namespace {

using testing::AllOf;
using testing::HasSubstr;
using testing::Optional;
using Role = TlsAuthorities::Role;

class TlsAuthoritiesTest : public testing::Test {
 protected:
  /// A new certificate that nobody else has signed, as text.
  std::string made(const CertificateWish& wish = {}) {
    const TlsFiles files{folder_.file("made.pem"), folder_.file("made.key")};
    writePair(files, wish);
    return readFile(files.certificate);
  }
  /// What is said of a certificate by authorities of which it is one.
  std::optional<std::string> complaint(const CertificateWish& wish, const std::string& host = "localhost") {
    const std::string certificate = made(wish);
    return authorities(certificate).complaint(certificate, "", Role::kServer, host);
  }
  TlsAuthorities authorities(const std::string& text) {
    writeFile(file_, text);
    return {"--tls-ca", file_};
  }
  std::string errorOf(const std::string& text) {
    try {
      (void)authorities(text);
      return "";
    } catch (const EnvironmentError& e) {
      return e.what();
    }
  }

  TestFolder folder_;
  const std::string file_ = folder_.file("authorities.pem");
};

TEST_F(TlsAuthoritiesTest, TrustTheirCertificates) {
  const std::string one = made();
  const std::string other = made();
  const std::string stranger = made({.name = "stranger"});
  const TlsAuthorities both = authorities(one + other);
  for (const Role role : {Role::kServer, Role::kClient}) {
    EXPECT_EQ(both.complaint(one, "", role, "localhost"), std::nullopt);
    EXPECT_EQ(both.complaint(other, "", role, ""), std::nullopt);
    EXPECT_THAT(
        both.complaint(stranger, one, role, ""),
        Optional(AllOf(HasSubstr("its certificate is signed by 'stranger', no authority of"), HasSubstr(file_))))
        << "who sends a good one along with it is not good";
  }
}

TEST_F(TlsAuthoritiesTest, ErrorsNameTheReason) {
  EXPECT_THAT(complaint({.beginsIn = -7200, .expiresIn = -60}), Optional(HasSubstr("its certificate expired on 2")));
  EXPECT_THAT(complaint({.beginsIn = 3600}), Optional(HasSubstr("is not valid before 2")));
  EXPECT_THAT(complaint({.name = "elsewhere"}), Optional(std::string("its certificate does not name localhost")));
  EXPECT_THAT(complaint({.name = "elsewhere"}, "127.0.0.1"),
              Optional(std::string("its certificate does not name 127.0.0.1")));
  EXPECT_THAT(complaint({.rsaBits = 1024}), Optional(HasSubstr("its certificate is not valid: ")));
  for (const std::string nothing : {"", "nonsense", "-----BEGIN CERTIFICATE-----\n"}) {
    EXPECT_THAT(authorities(made()).complaint(nothing, "", Role::kClient, ""),
                Optional(std::string("it shows no certificate")));
  }
}

TEST_F(TlsAuthoritiesTest, NameABadFile) {
  const std::string whole = made();
  for (const std::string& text : {std::string(), std::string("nonsense"), whole.substr(0, whole.size() / 2)}) {
    EXPECT_THAT(errorOf(text), AllOf(HasSubstr("--tls-ca " + file_), HasSubstr("has no readable certificate")));
  }
  EXPECT_THAT(errorOf(whole + whole.substr(0, whole.size() / 2)), HasSubstr("a certificate is damaged"));
  EXPECT_THAT(errorOf(readFile(folder_.file("made.key"))), HasSubstr("has no readable certificate"));
  try {
    const TlsAuthorities missing("--tls-ca", folder_.file("no.pem"));
    FAIL() << "there is no such file";
  } catch (const EnvironmentError& e) {
    EXPECT_THAT(e.what(), AllOf(HasSubstr("--tls-ca"), HasSubstr("no.pem"), HasSubstr("No such file")));
  }
}

}  // namespace
}  // namespace grove

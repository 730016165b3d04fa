#include "base/tls/tls_certificate.h"

#include <openssl/err.h>
#include <openssl/pem.h>

#include <array>
#include <string_view>

#include "base/error.h"
#include "base/plain_file.h"

namespace grove {
namespace {

constexpr std::uint64_t kMaxCertificateBytes = std::uint64_t{1} << 20U;
constexpr std::string_view kCertificateMend =
    "a certificate in PEM form, followed by those of its issuers, is required";
constexpr std::string_view kKeyMend = "the certificate's key in PEM form is required";

struct FreeBio {
  void operator()(BIO* bio) const noexcept { BIO_free(bio); }
};
struct FreeContext {
  void operator()(SSL_CTX* context) const noexcept { SSL_CTX_free(context); }
};
using Bio = std::unique_ptr<BIO, FreeBio>;

/// A file's text, erased from memory when it is no longer needed.
class Secret {
 public:
  explicit Secret(std::string text) : text_(std::move(text)) {}
  ~Secret() { OPENSSL_cleanse(text_.data(), text_.size()); }
  Secret(const Secret&) = delete;
  Secret& operator=(const Secret&) = delete;
  [[nodiscard]] Bio open() const { return Bio(BIO_new_mem_buf(text_.data(), static_cast<int>(text_.size()))); }
  [[nodiscard]] std::string_view text() const { return text_; }

 private:
  std::string text_;
};

std::string read(const std::string& option, const std::string& file, std::string_view mend) {
  try {
    return PlainFile(file, std::string(mend), kMaxCertificateBytes).readAll();
  } catch (const EnvironmentError& e) {
    throw EnvironmentError(e.what(), option, "");
  }
}

std::string lastOpensslError() {
  const unsigned long code = ERR_peek_last_error();
  const char* const reason = code == 0 ? nullptr : ERR_reason_error_string(code);
  ERR_clear_error();
  return reason == nullptr ? "without a reason" : reason;
}

std::time_t timeOf(const ASN1_TIME* time) {
  std::tm parts{};
  return ASN1_TIME_to_tm(time, &parts) == 1 ? timegm(&parts) : 0;
}

std::string certificateOption(const TlsFiles& files) { return files.option + "-cert " + files.certificate; }

std::string keyOption(const TlsFiles& files) { return files.option + "-key " + files.key; }

/// OpenSSL calls this for a key with a passphrase.
int notePassphrase(char* /*buffer*/, int /*size*/, int /*writing*/, void* asked) {
  *static_cast<bool*>(asked) = true;
  return -1;
}

}  // namespace

std::string dateOf(std::time_t time) {
  std::tm parts{};
  gmtime_r(&time, &parts);
  std::array<char, 64> text{};
  return {text.data(), std::strftime(text.data(), text.size(), "%Y-%m-%d %H:%M:%S UTC", &parts)};
}

TlsCertificate::TlsCertificate(const TlsFiles& files, std::time_t now) {
  ERR_clear_error();
  readCertificates(files);
  readKey(files);
  checkDates(files, now);
  checkPair(files);
}

TlsCertificate::~TlsCertificate() = default;

void TlsCertificate::readCertificates(const TlsFiles& files) {
  const Secret text(read(files.option + "-cert", files.certificate, kCertificateMend));
  const Bio bio = text.open();
  certificate_.reset(PEM_read_bio_X509_AUX(bio.get(), nullptr, nullptr, nullptr));
  const std::string where = certificateOption(files);
  if (!certificate_) {
    ERR_clear_error();
    const bool isPem = text.text().find("-----BEGIN ") != std::string_view::npos;
    throw EnvironmentError(isPem ? "has no readable certificate" : "is not in PEM form", where,
                           std::string(kCertificateMend) + ": openssl x509 -in FILE -text shows one");
  }
  issuers_.reset(sk_X509_new_null());
  while (X509* const issuer = PEM_read_bio_X509(bio.get(), nullptr, nullptr, nullptr)) {
    if (sk_X509_push(issuers_.get(), issuer) == 0) X509_free(issuer);
  }
  // This error after the last certificate is the normal end.
  const bool isWhole = ERR_GET_REASON(ERR_peek_last_error()) == PEM_R_NO_START_LINE;
  ERR_clear_error();
  if (!isWhole)
    throw EnvironmentError("a certificate after the first is damaged", where, std::string(kCertificateMend));
}

void TlsCertificate::readKey(const TlsFiles& files) {
  const Secret text(read(files.option + "-key", files.key, kKeyMend));
  const Bio bio = text.open();
  bool hasPassphrase = false;
  key_.reset(PEM_read_bio_PrivateKey(bio.get(), nullptr, &notePassphrase, &hasPassphrase));
  if (key_) return;
  ERR_clear_error();
  const std::string where = keyOption(files);
  if (hasPassphrase) {
    throw EnvironmentError("the key has a passphrase, which this program cannot request", where,
                           "openssl pkey -in FILE -out NEW writes it without one");
  }
  const bool isPem = text.text().find("-----BEGIN ") != std::string_view::npos;
  throw EnvironmentError(isPem ? "has no readable key" : "is not in PEM form", where, std::string(kKeyMend));
}

void TlsCertificate::checkDates(const TlsFiles& files, std::time_t now) {
  const std::time_t begins = timeOf(X509_get0_notBefore(certificate_.get()));
  expires_ = timeOf(X509_get0_notAfter(certificate_.get()));
  const std::string where = certificateOption(files);
  if (now < begins) {
    throw EnvironmentError("the certificate is not valid before " + dateOf(begins), where,
                           "wait, or set this machine's clock, which shows " + dateOf(now));
  }
  if (now > expires_) {
    throw EnvironmentError("the certificate expired on " + dateOf(expires_), where, "renew it");
  }
}

void TlsCertificate::checkPair(const TlsFiles& files) const {
  if (X509_check_private_key(certificate_.get(), key_.get()) != 1) {
    ERR_clear_error();
    throw EnvironmentError("is not the key of the certificate in " + files.certificate, keyOption(files),
                           "use a pair that was made together; the server's own certificate comes first in its file");
  }
  // A context checks the strength, by this machine's rules.
  const std::unique_ptr<SSL_CTX, FreeContext> context(SSL_CTX_new(TLS_server_method()));
  if (SSL_CTX_use_cert_and_key(context.get(), certificate_.get(), key_.get(), issuers_.get(), 1) == 1) return;
  throw EnvironmentError("OpenSSL refuses the certificate: " + lastOpensslError(), certificateOption(files),
                         "have a new one made, with an RSA key of 2048 bits or an elliptic one");
}

bool TlsCertificate::show(SSL* connection) const {
  return SSL_use_cert_and_key(connection, certificate_.get(), key_.get(), issuers_.get(), 1) == 1;
}

}  // namespace grove

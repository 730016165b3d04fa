#pragma once

#include <openssl/ssl.h>

#include <ctime>
#include <memory>
#include <string>
#include <vector>

namespace grove {

/// The files of a process's certificate and key, in PEM form.
struct TlsFiles {
  std::string certificate;       ///< the process's own first, then those of its issuers
  std::string key;               ///< without a passphrase
  std::string option = "--tls";  ///< how the options that name them begin; errors do so, too
};

/// A certificate with its key, checked and ready for use. Immutable.
class TlsCertificate {
 public:
  /// Reads both files. Throws EnvironmentError that names option and file if one cannot be read, has other contents, is
  /// not valid at `now`, does not match the other, or is too weak for OpenSSL.
  TlsCertificate(const TlsFiles& files, std::time_t now);
  ~TlsCertificate();
  TlsCertificate(const TlsCertificate&) = delete;
  TlsCertificate& operator=(const TlsCertificate&) = delete;

  /// Makes the connection use this certificate; called in its handshake, from OpenSSL's certificate callback. The
  /// connection's context has none, because one with another kind of key would stay in use beside this one.
  [[nodiscard]] bool show(SSL* connection) const;

  /// The last second at which it is valid.
  [[nodiscard]] std::time_t expires() const noexcept { return expires_; }

 private:
  struct Deleter {
    void operator()(X509* certificate) const noexcept { X509_free(certificate); }
    void operator()(EVP_PKEY* key) const noexcept { EVP_PKEY_free(key); }
    void operator()(STACK_OF(X509) * issuers) const noexcept { sk_X509_pop_free(issuers, X509_free); }
  };
  void readCertificates(const TlsFiles& files);
  void readKey(const TlsFiles& files);
  void checkDates(const TlsFiles& files, std::time_t now);
  void checkPair(const TlsFiles& files) const;

  std::unique_ptr<X509, Deleter> certificate_;
  std::unique_ptr<STACK_OF(X509), Deleter> issuers_;
  std::unique_ptr<EVP_PKEY, Deleter> key_;
  std::time_t expires_ = 0;
};

/// "2027-01-31 12:00:00 UTC".
[[nodiscard]] std::string dateOf(std::time_t time);

}  // namespace grove

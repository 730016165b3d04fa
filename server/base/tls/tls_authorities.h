#pragma once

#include <openssl/x509.h>

#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <string_view>

namespace grove {

/// Authorities that a process trusts, and what they say of another process's certificate. Immutable.
class TlsAuthorities {
 public:
  /// What the other process is to be.
  enum class Role : std::uint8_t { kServer, kClient };

  /// Reads certificates in PEM form. Throws EnvironmentError that names the option and the file, if there is none in it
  /// or one cannot be read.
  TlsAuthorities(const std::string& option, const std::string& file);

  /// Why the certificate is not to be trusted, in words that follow "the process": it is expired, none of the
  /// authorities has signed it, it is for another purpose or for another host. Nothing: it is to be trusted. `chain`
  /// has the certificates of its issuers. An empty `host` is not compared.
  [[nodiscard]] std::optional<std::string> complaint(std::string_view certificate, std::string_view chain, Role role,
                                                     const std::string& host) const;

 private:
  struct Deleter {
    void operator()(X509_STORE* store) const noexcept { X509_STORE_free(store); }
  };
  const std::string file_;
  const std::unique_ptr<X509_STORE, Deleter> store_;
};

}  // namespace grove

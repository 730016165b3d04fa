#include "base/tls/tls_authorities.h"

#include <openssl/err.h>
#include <openssl/pem.h>
#include <openssl/x509v3.h>

#include <array>
#include <ctime>

#include "base/error.h"
#include "base/plain_file.h"
#include "base/tls/tls_certificate.h"

namespace grove {
namespace {

constexpr std::uint64_t kMaxAuthoritiesBytes = std::uint64_t{4} << 20U;
constexpr const char* kAuthoritiesMend = "certificates of authorities in PEM form are required";
/// As OpenSSL's security level of Debian: RSA keys of 2048 bits, SHA-256.
constexpr int kAuthLevel = 2;

template <auto Function>
struct FreeBy {
  template <class Handle>
  void operator()(Handle* handle) const noexcept {
    Function(handle);
  }
};
void freeChain(STACK_OF(X509) * chain) { sk_X509_pop_free(chain, X509_free); }
using Chain = std::unique_ptr<STACK_OF(X509), FreeBy<&freeChain>>;
using Judgement = std::unique_ptr<X509_STORE_CTX, FreeBy<&X509_STORE_CTX_free>>;

/// Reads the certificates in a text, up to the first that cannot be read.
Chain certificatesIn(std::string_view text) {
  Chain chain(sk_X509_new_null());
  const std::unique_ptr<BIO, FreeBy<&BIO_vfree>> bio(BIO_new_mem_buf(text.data(), static_cast<int>(text.size())));
  ERR_clear_error();
  while (X509* const next = PEM_read_bio_X509(bio.get(), nullptr, nullptr, nullptr)) {
    if (sk_X509_push(chain.get(), next) == 0) X509_free(next);
  }
  return chain;
}

/// Whether reading ended because there was no further certificate.
bool endedWell() {
  const bool isWhole = ERR_GET_REASON(ERR_peek_last_error()) == PEM_R_NO_START_LINE;
  ERR_clear_error();
  return isWhole;
}

std::string textOf(const X509_NAME* name) {
  std::array<char, 256> text{};
  const int length = X509_NAME_get_text_by_NID(name, NID_commonName, text.data(), static_cast<int>(text.size()));
  if (length <= 0) return "an unnamed issuer";
  std::string quoted = "'";
  quoted.append(text.data(), static_cast<std::size_t>(length));
  return quoted + "'";
}

std::string dateIn(const ASN1_TIME* time) {
  std::tm parts{};
  return ASN1_TIME_to_tm(time, &parts) == 1 ? dateOf(timegm(&parts)) : "an unreadable date";
}

/// OpenSSL's result as a reason in our words.
std::string reasonOf(X509_STORE_CTX* judged, const std::string& file, const std::string& host) {
  const int error = X509_STORE_CTX_get_error(judged);
  const X509* const wrong = X509_STORE_CTX_get_current_cert(judged);
  const std::string whose =
      X509_STORE_CTX_get_error_depth(judged) == 0 ? "its certificate" : "its issuer's certificate";
  switch (error) {
    case X509_V_ERR_CERT_HAS_EXPIRED:
      return whose + " expired on " + dateIn(X509_get0_notAfter(wrong));
    case X509_V_ERR_CERT_NOT_YET_VALID:
      return whose + " is not valid before " + dateIn(X509_get0_notBefore(wrong));
    case X509_V_ERR_UNABLE_TO_GET_ISSUER_CERT:
    case X509_V_ERR_UNABLE_TO_GET_ISSUER_CERT_LOCALLY:
    case X509_V_ERR_UNABLE_TO_VERIFY_LEAF_SIGNATURE:
    case X509_V_ERR_DEPTH_ZERO_SELF_SIGNED_CERT:
    case X509_V_ERR_SELF_SIGNED_CERT_IN_CHAIN:
    case X509_V_ERR_CERT_SIGNATURE_FAILURE:
      return whose + " is signed by " + textOf(X509_get_issuer_name(wrong)) + ", no authority of " + file;
    case X509_V_ERR_HOSTNAME_MISMATCH:
    case X509_V_ERR_IP_ADDRESS_MISMATCH:
      return "its certificate does not name " + host;
    case X509_V_ERR_INVALID_PURPOSE:
      return whose + " is for another purpose";
    default:
      return whose + " is not valid: " + X509_verify_cert_error_string(error);
  }
}

/// Returns false if no certificate can name the host.
bool require(X509_VERIFY_PARAM* rules, const std::string& host) {
  return X509_VERIFY_PARAM_set1_ip_asc(rules, host.c_str()) == 1 ||
         X509_VERIFY_PARAM_set1_host(rules, host.data(), host.size()) == 1;
}

}  // namespace

TlsAuthorities::TlsAuthorities(const std::string& option, const std::string& file)
    : file_(file), store_(X509_STORE_new()) {
  std::string text;
  try {
    text = PlainFile(file, kAuthoritiesMend, kMaxAuthoritiesBytes).readAll();
  } catch (const EnvironmentError& e) {
    throw EnvironmentError(e.what(), option, "");
  }
  const Chain authorities = certificatesIn(text);
  const bool isWhole = endedWell();
  if (sk_X509_num(authorities.get()) == 0) {
    throw EnvironmentError("has no readable certificate", option + " " + file, kAuthoritiesMend);
  }
  if (!isWhole) throw EnvironmentError("a certificate is damaged", option + " " + file, kAuthoritiesMend);
  for (int i = 0; i < sk_X509_num(authorities.get()); ++i) {
    X509_STORE_add_cert(store_.get(), sk_X509_value(authorities.get(), i));
  }
}

std::optional<std::string> TlsAuthorities::complaint(std::string_view certificate, std::string_view chain, Role role,
                                                     const std::string& host) const {
  const Chain own = certificatesIn(certificate);
  const Chain issuers = certificatesIn(chain);
  ERR_clear_error();
  if (sk_X509_num(own.get()) == 0) return "it shows no certificate";
  const Judgement judged(X509_STORE_CTX_new());
  const bool isPrepared =
      X509_STORE_CTX_init(judged.get(), store_.get(), sk_X509_value(own.get(), 0), issuers.get()) == 1 &&
      X509_STORE_CTX_set_default(judged.get(), role == Role::kServer ? "ssl_server" : "ssl_client") == 1;
  if (!isPrepared) return "there is not enough memory to verify its certificate";
  X509_VERIFY_PARAM* const rules = X509_STORE_CTX_get0_param(judged.get());
  X509_VERIFY_PARAM_set_auth_level(rules, kAuthLevel);
  // Certificates in the file are trusted even if others have signed them.
  X509_VERIFY_PARAM_set_flags(rules, X509_V_FLAG_PARTIAL_CHAIN);
  if (!host.empty() && !require(rules, host)) return "its certificate cannot name " + host;
  const bool isTrusted = X509_verify_cert(judged.get()) == 1;
  ERR_clear_error();
  if (isTrusted) return std::nullopt;
  return reasonOf(judged.get(), file_, host);
}

}  // namespace grove

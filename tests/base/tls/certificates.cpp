#include "base/tls/certificates.h"

#include <openssl/pem.h>
#include <openssl/rsa.h>
#include <openssl/x509v3.h>

#include <cstdlib>
#include <fstream>
#include <memory>
#include <sstream>
#include <stdexcept>

namespace grove {
namespace {

template <auto Function>
struct Free {
  template <class Handle>
  void operator()(Handle* handle) const noexcept {
    Function(handle);
  }
};
using Key = std::unique_ptr<EVP_PKEY, Free<&EVP_PKEY_free>>;
using Certificate = std::unique_ptr<X509, Free<&X509_free>>;
using Bio = std::unique_ptr<BIO, Free<&BIO_vfree>>;

std::filesystem::path newFolder() {
  std::string name = (std::filesystem::temp_directory_path() / "grove_tls_XXXXXX").string();
  if (mkdtemp(name.data()) == nullptr) throw std::runtime_error("no temporary folder");
  return name;
}

std::string textOf(BIO* bio) {
  char* bytes = nullptr;
  const long size = BIO_get_mem_data(bio, &bytes);
  return {bytes, static_cast<std::size_t>(size)};
}

}  // namespace

TestFolder::TestFolder() : path_(newFolder()) {}

TestFolder::~TestFolder() {
  std::error_code ignored;
  std::filesystem::remove_all(path_, ignored);
}

void writeFile(const std::string& file, const std::string& text) {
  std::ofstream(file + ".new") << text;
  std::filesystem::rename(file + ".new", file);
}

std::string readFile(const std::string& file) {
  std::ostringstream text;
  text << std::ifstream(file).rdbuf();
  return text.str();
}

void writePair(const TlsFiles& files, const CertificateWish& wish) {
  const Key key(wish.rsaBits > 0 ? EVP_RSA_gen(static_cast<unsigned>(wish.rsaBits)) : EVP_EC_gen("P-256"));
  const Certificate certificate(X509_new());
  X509_set_version(certificate.get(), 2);
  ASN1_INTEGER_set(X509_get_serialNumber(certificate.get()), 1);
  X509_gmtime_adj(X509_getm_notBefore(certificate.get()), wish.beginsIn);
  X509_gmtime_adj(X509_getm_notAfter(certificate.get()), wish.expiresIn);
  X509_NAME* const name = X509_get_subject_name(certificate.get());
  X509_NAME_add_entry_by_txt(name, "CN", MBSTRING_ASC, reinterpret_cast<const unsigned char*>(wish.name.c_str()), -1,
                             -1, 0);
  X509_set_issuer_name(certificate.get(), name);
  X509_set_pubkey(certificate.get(), key.get());
  X509_sign(certificate.get(), key.get(), EVP_sha256());
  const Bio keyText(BIO_new(BIO_s_mem()));
  const bool isSecret = !wish.passphrase.empty();
  PEM_write_bio_PrivateKey(keyText.get(), key.get(), isSecret ? EVP_aes_128_cbc() : nullptr,
                           reinterpret_cast<const unsigned char*>(wish.passphrase.data()),
                           static_cast<int>(wish.passphrase.size()), nullptr, nullptr);
  const Bio certificateText(BIO_new(BIO_s_mem()));
  PEM_write_bio_X509(certificateText.get(), certificate.get());
  writeFile(files.certificate, textOf(certificateText.get()));
  writeFile(files.key, textOf(keyText.get()));
}

}  // namespace grove

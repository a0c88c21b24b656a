// SPDX-License-Identifier: GPL-3.0-or-later
#include "emulated-ui/seals/seal.h"

#include <array>
#include <cerrno>
#include <cstring>
#include <fcntl.h>
#include <optional>
#include <sodium.h>
#include <unistd.h>

#include <nlohmann/json.hpp>

#include "core/data_folder.h"
#include "core/json_fields.h"
#include "core/json_file.h"

namespace standpoint {

namespace {

namespace fs = std::filesystem;

constexpr const char* kKeyFormat = "standpoint-key-1";
constexpr std::size_t kDigestBytes = 32;

// Once, before anything of the library is used; it is safe from several threads.
void wakeSodium() {
  static const int kReady = sodium_init();
  if (kReady < 0) std::abort();  // no source of random bytes: nothing that follows could be trusted
}

const unsigned char* bytesOf(std::string_view text) { return reinterpret_cast<const unsigned char*>(text.data()); }
unsigned char* bytesOf(std::string& text) { return reinterpret_cast<unsigned char*>(text.data()); }

std::string base64(const std::string& bytes) {
  std::string text(sodium_base64_ENCODED_LEN(bytes.size(), sodium_base64_VARIANT_ORIGINAL), '\0');
  sodium_bin2base64(text.data(), text.size(), bytesOf(std::string_view(bytes)), bytes.size(),
                    sodium_base64_VARIANT_ORIGINAL);
  text.pop_back();  // the NUL
  return text;
}

// Nothing where it is no base64 of so many bytes.
std::optional<std::string> fromBase64(const std::string& text, std::size_t size) {
  std::string bytes(size, '\0');
  std::size_t length = 0;
  const char* end = nullptr;
  if (sodium_base642bin(bytesOf(bytes), size, text.data(), text.size(), nullptr, &length, &end,
                        sodium_base64_VARIANT_ORIGINAL) != 0 ||
      length != size || end != text.data() + text.size())
    return std::nullopt;
  return bytes;
}

}  // namespace

std::string digestOf(std::string_view text) {
  wakeSodium();
  std::array<unsigned char, crypto_hash_sha512_BYTES> hash{};
  crypto_hash_sha512(hash.data(), bytesOf(text), text.size());
  std::array<char, 2 * kDigestBytes + 1> hex{};
  sodium_bin2hex(hex.data(), hex.size(), hash.data(), kDigestBytes);
  return hex.data();
}

SigningKey::SigningKey(const std::string& seed) {
  wakeSodium();
  std::string pub(crypto_sign_PUBLICKEYBYTES, '\0');
  secret_.resize(crypto_sign_SECRETKEYBYTES);
  crypto_sign_seed_keypair(bytesOf(pub), bytesOf(secret_), bytesOf(std::string_view(seed)));
  public_ = base64(pub);
}

Result<SigningKey> SigningKey::make(const fs::path& file) {
  wakeSodium();
  std::error_code error;
  if (fs::exists(file, error))
    return failure(ErrorKind::usage, "there is a key already; leave out --new-key to use it", file.string());
  if (file.has_parent_path()) fs::create_directories(file.parent_path(), error);
  std::string seed(crypto_sign_SEEDBYTES, '\0');
  randombytes_buf(seed.data(), seed.size());
  const SigningKey key(seed);
  const nlohmann::json json = {{"format", kKeyFormat}, {"secret", base64(seed)}, {"public", key.public_}};
  const std::string text = json.dump(2) + '\n';
  // Nobody else may read it, from the first moment on.
  const int to = ::open(file.c_str(), O_WRONLY | O_CREAT | O_EXCL | O_CLOEXEC, 0600);
  const bool written =
      to >= 0 && ::write(to, text.data(), text.size()) == static_cast<ssize_t>(text.size()) && ::fsync(to) == 0;
  const int why = errno;
  if (to >= 0) ::close(to);
  if (!written) {
    if (to >= 0) ::unlink(file.c_str());
    return failure(ErrorKind::file_system, std::string("cannot write the key: ") + std::strerror(why), file.string());
  }
  return key;
}

Result<SigningKey> SigningKey::read(const fs::path& file) {
  const auto json = readJsonFile(file);
  if (!json) return failure(json.error());
  JsonFault fault(file.filename().string());
  JsonFields f(fault, *json, "");
  if (f.text("format") != kKeyFormat) f.wrong("format", "is no key of Standpoint");
  const auto seed = fromBase64(f.text("secret"), crypto_sign_SEEDBYTES);
  const auto written = f.text("public");
  f.close();
  TRY(fault.result());
  if (!seed) return failure(ErrorKind::unusable, "is no key: 32 bytes in base64 are needed", fault.file() + " /secret");
  SigningKey key(*seed);
  if (key.public_ != written)
    return failure(ErrorKind::unusable, "does not belong to the secret key; use the file as it was made",
                   fault.file() + " /public");
  return key;
}

std::string SigningKey::signature(std::string_view text) const {
  std::string bytes(crypto_sign_BYTES, '\0');
  crypto_sign_detached(bytesOf(bytes), nullptr, bytesOf(text), text.size(), bytesOf(std::string_view(secret_)));
  return base64(bytes);
}

std::uint64_t SigningKey::drawn(std::string_view text) const {
  // A key of its own for this, so that signatures and numbers say nothing of each other.
  std::array<unsigned char, crypto_auth_hmacsha512256_KEYBYTES> key{};
  constexpr std::string_view kPurpose = "standpoint draws";
  crypto_generichash(key.data(), key.size(), bytesOf(kPurpose), kPurpose.size(), bytesOf(std::string_view(secret_)),
                     crypto_sign_SEEDBYTES);
  std::array<unsigned char, crypto_auth_hmacsha512256_BYTES> mac{};
  crypto_auth_hmacsha512256(mac.data(), bytesOf(text), text.size(), key.data());
  std::uint64_t number = 0;
  for (std::size_t i = 0; i < sizeof number; ++i) number = number << 8U | mac[i];
  return number;
}

Result<SigningKey> ownKey() {
  const auto file = ownPath(nullptr, "student.key");
  if (file.empty())
    return failure(ErrorKind::file_system, "no place for the key: HOME and XDG_CONFIG_HOME are not set", "student.key");
  std::error_code error;
  return fs::exists(file, error) ? SigningKey::read(file) : SigningKey::make(file);
}

std::string fingerprint(const std::string& public_key) {
  const auto hex = digestOf(public_key);
  return hex.substr(0, 4) + ' ' + hex.substr(4, 4) + ' ' + hex.substr(8, 4);
}

bool Sealed::intact() const {
  wakeSodium();
  const auto bytes = fromBase64(signature, crypto_sign_BYTES), pub = fromBase64(key, crypto_sign_PUBLICKEYBYTES);
  const std::string whole = kind + '\n' + text;
  return bytes && pub &&
         crypto_sign_verify_detached(bytesOf(std::string_view(*bytes)), bytesOf(std::string_view(whole)), whole.size(),
                                     bytesOf(std::string_view(*pub))) == 0;
}

Sealed sealed(const std::string& kind, std::string text, const SigningKey& key) {
  auto signature = key.signature(kind + '\n' + text);
  return {kind, std::move(text), key.publicKey(), std::move(signature)};
}

std::string fileText(const Sealed& seal) {
  return nlohmann::json(
             {{"format", seal.kind}, {"payload", seal.text}, {"key", seal.key}, {"signature", seal.signature}})
             .dump(2) +
         '\n';
}

Result<Sealed> parseSeal(const std::string& text, const std::string& file_name, const std::string& kind) {
  TRY_ASSIGN(const auto json, parseJson(text, file_name));
  JsonFault fault(file_name);
  JsonFields f(fault, json, "");
  Sealed seal{f.text("format"), "", "", ""};
  if (!fault.error() && seal.kind != kind)
    return failure(ErrorKind::unusable, "'" + seal.kind + "' is not '" + kind + "'", file_name + " /format");
  seal.text = f.text("payload");
  seal.key = f.text("key");
  seal.signature = f.text("signature");
  f.close();
  TRY(fault.result());
  return seal;
}

Result<Sealed> readSeal(const fs::path& file, const std::string& kind) {
  TRY_ASSIGN(const auto text, readWholeFile(file, kLargestJsonFile));
  return parseSeal(text, file.filename().string(), kind);
}

}  // namespace standpoint

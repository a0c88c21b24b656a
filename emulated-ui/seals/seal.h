// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdint>
#include <filesystem>
#include <string>
#include <string_view>

#include "core/result.h"

namespace standpoint {

// Hashes, signatures and keys, by libsodium. A key inside a program or a file that goes to students is no secret: what
// a seal shows is that a text is as its signer left it, and which key that was.

// The first 32 bytes of SHA-512, as 64 hexadecimal digits.
std::string digestOf(std::string_view text);

// A pair of keys for Ed25519. Its file can be read by its owner only.
class SigningKey {
 public:
  // A new one. A file that is there already is an error: a key is never written over.
  static Result<SigningKey> make(const std::filesystem::path& file);
  static Result<SigningKey> read(const std::filesystem::path& file);

  const std::string& publicKey() const { return public_; }  // base64, 44 characters
  std::string signature(std::string_view text) const;       // base64, of 64 bytes
  // A number that only the owner of the key can draw for `text`, always the same one (HMAC-SHA-512/256).
  std::uint64_t drawn(std::string_view text) const;

 private:
  SigningKey(const std::string& seed);
  std::string secret_, public_;
};

// The key of who works on this computer, for results: XDG_CONFIG_HOME/standpoint/student.key, made when it is missing.
Result<SigningKey> ownKey();

// Short, for people who compare keys: "3f9a 01c2 77be".
std::string fingerprint(const std::string& public_key);

// A text and who signed it. As a file it is an object of these four texts; the signature is that of kind, line feed and
// text, so that a seal of one kind is none of another.
struct Sealed {
  std::string kind;  // "standpoint-result-1"
  std::string text;  // JSON; signed as it is, byte by byte
  std::string key;   // public
  std::string signature;

  bool intact() const;  // the text is what the key's owner signed
};
Sealed sealed(const std::string& kind, std::string text, const SigningKey& key);
std::string fileText(const Sealed& seal);
// What has no seal of that kind is an error of kind unusable with its place; whether it is intact is not asked.
Result<Sealed> readSeal(const std::filesystem::path& file, const std::string& kind);
Result<Sealed> parseSeal(const std::string& text, const std::string& file_name, const std::string& kind);

}  // namespace standpoint

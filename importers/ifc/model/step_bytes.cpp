// SPDX-License-Identifier: GPL-3.0-or-later
#include "importers/ifc/model/step_bytes.h"

#include <cstdint>
#include <cstdio>
#include <cstring>
#include <memory>
#include <string_view>

#include <zlib.h>

namespace standpoint::ifc {
namespace {

constexpr std::size_t kLargestText = std::size_t{4} << 30;  // unpacked; a larger one is a bomb or no building

Result<std::string> slurp(const std::filesystem::path& file) {
  std::error_code code;
  const auto size = std::filesystem::file_size(file, code);
  if (code) return failure(ErrorKind::file_system, "cannot read: " + code.message(), file.string());
  const std::unique_ptr<std::FILE, int (*)(std::FILE*)> in(std::fopen(file.c_str(), "rb"), &std::fclose);
  if (!in) return failure(ErrorKind::file_system, std::string("cannot open: ") + std::strerror(errno), file.string());
  std::string bytes(size, '\0');
  bytes.resize(std::fread(bytes.data(), 1, bytes.size(), in.get()));
  return bytes;
}

// zlib's window_bits: 31 for gzip, -15 for the raw stream in a zip archive.
Result<std::string> inflateAll(std::string_view packed, int window_bits, const std::string& name) {
  z_stream stream{};
  if (inflateInit2(&stream, window_bits) != Z_OK) return failure(ErrorKind::internal, "cannot initialise zlib", name);
  const std::unique_ptr<z_stream, int (*)(z_stream*)> guard(&stream, &inflateEnd);
  std::string text;
  std::size_t fed = 0;
  int state = Z_OK;
  while (state == Z_OK && text.size() < kLargestText) {
    if (stream.avail_in == 0 && fed < packed.size()) {
      const std::size_t piece = std::min<std::size_t>(packed.size() - fed, 1 << 20);
      stream.next_in = reinterpret_cast<Bytef*>(const_cast<char*>(packed.data() + fed));
      stream.avail_in = static_cast<uInt>(piece);
      fed += piece;
    }
    constexpr std::size_t kStep = 1 << 20;
    text.resize(text.size() + kStep);
    stream.next_out = reinterpret_cast<Bytef*>(text.data() + text.size() - kStep);
    stream.avail_out = kStep;
    state = inflate(&stream, Z_NO_FLUSH);
    text.resize(text.size() - stream.avail_out);
  }
  if (state != Z_STREAM_END) return failure(ErrorKind::unusable, "the compressed file is damaged or too large", name);
  return text;
}

std::uint32_t little(std::string_view bytes, std::size_t at, std::size_t count) {
  std::uint32_t x = 0;
  for (std::size_t i = 0; i < count && at + i < bytes.size(); ++i)
    x |= static_cast<std::uint32_t>(static_cast<unsigned char>(bytes[at + i])) << (8 * i);
  return x;
}

// The central directory is read from its end record (APPNOTE 4.3.16), since local headers may lack the sizes.
Result<std::string> unzip(std::string_view zip, const std::string& name) {
  const std::size_t tail = zip.rfind("PK\x05\x06");
  if (tail == std::string_view::npos) return failure(ErrorKind::unusable, "the zip archive has no directory", name);
  std::size_t at = little(zip, tail + 16, 4);
  for (std::uint32_t left = little(zip, tail + 10, 2); left > 0 && at + 46 <= zip.size(); --left) {
    const std::uint32_t name_size = little(zip, at + 28, 2);
    const std::string_view member = zip.substr(at + 46, name_size);
    const std::uint32_t method = little(zip, at + 10, 2), size = little(zip, at + 20, 4),
                        local = little(zip, at + 42, 4);
    if (member.ends_with(".ifc") || member.ends_with(".IFC")) {
      const std::size_t data =
          std::size_t{local} + 30 + little(zip, std::size_t{local} + 26, 2) + little(zip, std::size_t{local} + 28, 2);
      if (data > zip.size() || size > zip.size() - data) break;
      if (method == 0) return std::string(zip.substr(data, size));
      if (method == 8) return inflateAll(zip.substr(data, size), -15, name);
      return failure(ErrorKind::unusable, "the zip archive uses a compression method other than deflate", name);
    }
    at += 46 + name_size + little(zip, at + 30, 2) + little(zip, at + 32, 2);
  }
  return failure(ErrorKind::unusable, "the zip archive contains no readable .ifc file", name);
}

}  // namespace

Result<std::string> readStepBytes(const std::filesystem::path& file) {
  auto bytes = slurp(file);
  if (!bytes) return bytes;
  const std::string name = file.filename().string();
  if (bytes->starts_with("\x1F\x8B")) return inflateAll(*bytes, 31, name);
  if (bytes->starts_with("PK\x03\x04")) return unzip(*bytes, name);
  return bytes;
}

}  // namespace standpoint::ifc

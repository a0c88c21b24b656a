// SPDX-License-Identifier: GPL-3.0-or-later
#include "importers/gltf/gltf_file.h"

#include <algorithm>
#include <array>
#include <cstring>
#include <optional>
#include <sys/mman.h>
#include <utility>

#include <tbb/parallel_for.h>

#include "importers/files/file_bytes.h"
#include "importers/gltf/gltf_shape.h"

namespace standpoint {

namespace {

constexpr std::uint32_t kGlbMagic = 0x46546C67;
constexpr std::uint32_t kJsonChunk = 0x4E4F534A;
constexpr std::uint32_t kBinaryChunk = 0x004E4942;
constexpr std::size_t kLargest = 0xFFFFFFFFU;  // GLB lengths are 32 bit; no honest count is larger

std::uint32_t word(std::span<const std::uint8_t> bytes, std::size_t at) {
  std::uint32_t value = 0;
  std::memcpy(&value, bytes.data() + at, 4);
  return value;
}

int base64Digit(char c) {
  if (c >= 'A' && c <= 'Z') return c - 'A';
  if (c >= 'a' && c <= 'z') return c - 'a' + 26;
  if (c >= '0' && c <= '9') return c - '0' + 52;
  if (c == '+' || c == '-') return 62;
  if (c == '/' || c == '_') return 63;
  return -1;
}

// How many bytes `text` holds, written to `out`, which has room for ¾ of its length; nothing if it is not base64.
std::optional<std::size_t> fromBase64(std::string_view text, std::uint8_t* out) {
  std::size_t count = 0;
  std::uint32_t bits = 0;
  int have = 0;
  for (const char c : text) {
    if (c == '=') break;
    const int digit = base64Digit(c);
    if (digit < 0) return std::nullopt;
    bits = bits << 6U | static_cast<std::uint32_t>(digit);
    have += 6;
    if (have < 8) continue;
    have -= 8;
    out[count++] = static_cast<std::uint8_t>(bits >> static_cast<unsigned>(have));
  }
  return count;
}

// Where brackets are nested deeper than any honest file's: what walks the JSON later, and writes it as text, recurses.
std::optional<std::size_t> tooDeepAt(std::span<const std::uint8_t> json) {
  constexpr int kDeepest = 200;
  int depth = 0;
  bool in_string = false;
  for (std::size_t i = 0; i < json.size(); ++i) {
    const auto c = json[i];
    if (in_string) {
      if (c == '\\') ++i;
      in_string = c != '"';
    } else if (c == '"') {
      in_string = true;
    } else if (c == '{' || c == '[') {
      if (++depth > kDeepest) return i;
    } else if (c == '}' || c == ']') {
      --depth;
    }
  }
  return std::nullopt;
}

int hexDigit(char c) {
  if (c >= '0' && c <= '9') return c - '0';
  if (c >= 'a' && c <= 'f') return c - 'a' + 10;
  if (c >= 'A' && c <= 'F') return c - 'A' + 10;
  return -1;
}

// After a byte order mark and white space.
bool beginsAsJson(std::span<const std::uint8_t> bytes) {
  constexpr std::array<std::uint8_t, 3> kMark = {0xEF, 0xBB, 0xBF};
  if (bytes.size() >= kMark.size() && std::equal(kMark.begin(), kMark.end(), bytes.begin()))
    bytes = bytes.subspan(kMark.size());
  const auto first = std::find_if(bytes.begin(), bytes.end(),
                                  [](std::uint8_t c) { return c != ' ' && c != '\t' && c != '\r' && c != '\n'; });
  return first != bytes.end() && *first == '{';
}

}  // namespace

std::string percentDecoded(std::string_view text) {
  std::string result;
  for (std::size_t i = 0; i < text.size(); ++i) {
    const bool escape =
        text[i] == '%' && i + 2 < text.size() && hexDigit(text[i + 1]) >= 0 && hexDigit(text[i + 2]) >= 0;
    result += escape ? static_cast<char>(hexDigit(text[i + 1]) * 16 + hexDigit(text[i + 2])) : text[i];
    if (escape) i += 2;
  }
  return result;
}

void GltfFile::fail(const std::string& place, std::string message, ErrorKind kind) {
  if (error_) return;
  std::string source = path_.filename().string();
  if (!place.empty()) source += " " + place;
  error_ = Error{kind, std::move(message), std::move(source)};
}

void GltfFile::fail(Error error) { fail(error.source, std::move(error.message), error.kind); }

void GltfFile::load() {
  auto read = readAll(path_, "", kLargest);
  if (!read) return fail(read.error());
  blocks_.push_back(*std::move(read));
  const auto bytes = blocks_[0].bytes();
  allowance_ = (std::size_t{256} << 20U) + 64 * bytes.size();
  const bool binary = bytes.size() >= 4 && word(bytes, 0) == kGlbMagic;
  if (binary) {
    splitBinary(bytes);
  } else if (!beginsAsJson(bytes)) {
    fail("byte 0", "neither binary glTF (GLB) nor JSON");
  } else {
    parse(bytes);
    loadBuffers({});
  }
}

void GltfFile::splitBinary(std::span<const std::uint8_t> bytes) {
  if (bytes.size() < 20)
    return fail("byte 0", "a GLB requires a 12-byte header and a JSON chunk; the file is truncated");
  if (word(bytes, 4) != 2)
    return fail("byte 4", "GLB version " + std::to_string(word(bytes, 4)) + "; only version 2 is supported");
  if (word(bytes, 8) > bytes.size())
    return fail("byte 8", "the header states " + std::to_string(word(bytes, 8)) + " bytes, the file has " +
                              std::to_string(bytes.size()) + ": the file is truncated");
  const std::size_t total = word(bytes, 8);
  bytes_left_ = bytes.size() - total;
  std::span<const std::uint8_t> binary;
  std::size_t at = 12;
  for (int chunk = 0; at + 8 <= total; ++chunk) {
    const std::size_t length = word(bytes, at);
    const std::uint32_t kind = word(bytes, at + 4);
    if (length > total - at - 8)
      return fail("byte " + std::to_string(at), "a chunk extends beyond the end of the file");
    const auto content = bytes.subspan(at + 8, length);
    if (chunk == 0 && kind != kJsonChunk) return fail("byte 12", "the first chunk is not JSON");
    if (chunk == 0) parse(content);
    if (kind == kBinaryChunk && binary.empty()) binary = content;
    at += 8 + length;
  }
  loadBuffers(binary);
}

void GltfFile::parse(std::span<const std::uint8_t> bytes) {
  if (const auto at = tooDeepAt(bytes))
    return fail("byte " + std::to_string(*at), "the JSON is nested more than 200 levels deep");
  nlohmann::json json;
  try {
    json = nlohmann::json::parse(bytes.begin(), bytes.end());
  } catch (const nlohmann::json::parse_error& e) {
    std::string why = e.what();  // which quotes the bytes that it does not like
    std::replace_if(
        why.begin(), why.end(), [](unsigned char c) { return c < ' ' || c > '~'; }, '?');
    return fail("byte " + std::to_string(e.byte), "invalid JSON: " + why);
  } catch (
      const nlohmann::json::exception& e) {  // a number beyond double: the message quotes it, but does not say where
    const std::string why = e.what();
    const auto first = why.find('\''), last = why.rfind('\'');
    const std::string number = first < last ? why.substr(first + 1, last - first - 1) : std::string();
    const auto at = std::search(bytes.begin(), bytes.end(), number.begin(), number.end());
    return fail("byte " + std::to_string(at - bytes.begin()), "the number " + number.substr(0, 40) + " is too large");
  }
  if (!json.is_object()) return fail("byte 0", "the JSON is not an object");
  const auto& asset = memberOf(json, "asset");
  const std::string version = text(asset, "version");
  if (version.empty()) return fail("/asset/version", "is missing: not a glTF 2.0 file");
  if (!version.starts_with("2.")) return fail("/asset/version", "is " + version + "; only glTF 2 is supported");
  const std::string least = text(asset, "minVersion");
  if (!least.empty() && least != "2.0") return fail("/asset/minVersion", "is " + least + "; glTF 2.0 is supported");
  readModel(json);
}

// Text again, for tinygltf takes nothing else, without what it does not read.
void GltfFile::readModel(nlohmann::json& json) {
  const auto sizeOf = [&](const char* array) { return memberOf(json, array).is_array() ? json[array].size() : 0; };
  animations_ = sizeOf("animations");
  cameras_ = sizeOf("cameras");
  for (auto [key, taken] : {std::pair("extensions", &extensions_), std::pair("buffers", &buffers_json_)})
    if (json.contains(key)) {
      *taken = std::move(json[key]);
      json.erase(key);
    }
  GltfShape shape(*this, json);
  shape.check();
  if (failed()) return;
  const std::string text = std::exchange(json, {}).dump();
  std::string wrong, ignored;
  tinygltf::TinyGLTF reader;
  reader.SetStoreOriginalJSONForExtrasAndExtensions(true);
  try {
    if (!reader.LoadASCIIFromString(&model_, &wrong, &ignored, text.data(), static_cast<unsigned>(text.size()), ""))
      return fail("", "tinygltf cannot read it: " + wrong);
  } catch (const std::exception& e) {
    return fail("", std::string("tinygltf cannot read it: ") + e.what());
  }
  shape.putBack(model_);
}

namespace {

// Fresh memory costs as much as the reading: a page of 2 MB is had for the price of one of 4 KB.
void askForLargePages(std::uint8_t* first, std::size_t size) {
  constexpr std::uintptr_t kLarge = std::uintptr_t{1} << 21U;
  const auto begin = reinterpret_cast<std::uintptr_t>(first);
  const auto from = (begin + kLarge - 1) / kLarge * kLarge, to = (begin + size) / kLarge * kLarge;
  if (from < to) ::madvise(first + (from - begin), to - from, MADV_HUGEPAGE);  // a wish only
}

}  // namespace

Result<GltfFile::Block> GltfFile::readAll(const std::filesystem::path& file, const std::string& place,
                                          std::size_t at_most) {
  constexpr std::size_t kPart = std::size_t{1} << 24U;
  const auto unread = [&](const Error& e) {
    return failure(e.kind, "cannot read " + file.string() + ": " + e.message, place);
  };
  const auto bytes = FileBytes::open(file);
  if (!bytes) return unread(bytes.error());
  Block block{nullptr, std::min<std::size_t>(bytes->size(), at_most)};
  block.data = std::make_unique_for_overwrite<std::uint8_t[]>(block.size);
  askForLargePages(block.data.get(), block.size);
  std::vector<std::optional<Error>> wrong(block.size / kPart + 1);
  tbb::parallel_for(std::size_t{0}, wrong.size(), [&](std::size_t part) {
    const std::size_t from = part * kPart, count = std::min(kPart, block.size - from);
    if (auto read = bytes->read(from, reinterpret_cast<char*>(block.data.get()) + from, count); !read)
      wrong[part] = read.error();
  });
  for (const auto& e : wrong)
    if (e) return unread(*e);
  return block;
}

Result<GltfFile::Block> GltfFile::blockOf(const std::string& uri, const std::string& place, std::size_t at_most) {
  if (uri.starts_with("data:")) {
    const auto comma = uri.find(";base64,");
    if (comma == std::string::npos)
      return failure(ErrorKind::unusable, "is a data URI that is not base64", place + "/uri");
    const auto text = std::string_view(uri).substr(comma + 8);
    Block block{std::make_unique_for_overwrite<std::uint8_t[]>(text.size()), 0};
    const auto size = fromBase64(text, block.data.get());
    if (!size) return failure(ErrorKind::unusable, "is a data URI that is not base64", place + "/uri");
    block.size = std::min(*size, at_most);
    return block;
  }
  const std::string shown = "'" + uri.substr(0, 80) + "'";
  const std::filesystem::path relative = percentDecoded(uri);
  std::error_code code;
  const auto folder = std::filesystem::weakly_canonical(std::filesystem::absolute(path_).parent_path(), code);
  const auto file = std::filesystem::weakly_canonical(folder / relative, code);
  const auto inside = file.lexically_relative(folder);
  if (uri.find("://") != std::string::npos || relative.is_absolute() || inside.empty() || *inside.begin() == "..")
    return failure(ErrorKind::unusable, shown + " is not in the model's folder; move it there", place + "/uri");
  if (!std::filesystem::is_regular_file(file, code))
    return failure(ErrorKind::unusable, shown + " does not exist in the model's folder", place + "/uri");
  return readAll(file, place, at_most);
}

Result<std::vector<std::uint8_t>> GltfFile::resource(const std::string& uri, const std::string& place,
                                                     std::size_t at_most) {
  TRY_ASSIGN(auto block, blockOf(uri, place, at_most));
  const auto bytes = block.bytes();
  return std::vector<std::uint8_t>(bytes.begin(), bytes.end());
}

void GltfFile::loadBuffers(std::span<const std::uint8_t> binary_chunk) {
  for (std::size_t i = 0; !failed() && buffers_json_.is_array() && i < buffers_json_.size(); ++i)
    loadBuffer(buffers_json_[i], "/buffers/" + std::to_string(i), binary_chunk);
}

void GltfFile::loadBuffer(const nlohmann::json& json, const std::string& place,
                          std::span<const std::uint8_t> binary_chunk) {
  if (!json.is_object()) return fail(place, "is not an object");
  const std::size_t size = natural(json, "byteLength", 0, place);
  buffers_.emplace_back();
  const std::string uri = text(json, "uri");
  if (!uri.empty()) {
    auto read = blockOf(uri, place, size);
    if (!read) return fail(read.error());
    blocks_.push_back(*std::move(read));
    buffers_.back() = blocks_.back().bytes();
    allowance_ += 64 * buffers_.back().size();
  } else if (buffers_.size() == 1 && !binary_chunk.empty()) {
    buffers_.back() = binary_chunk.first(std::min(size, binary_chunk.size()));
  } else {
    return;  // no data: allowed for the fallback of EXT_meshopt_compression; slice() refuses any other use
  }
  if (buffers_.back().size() < size)
    fail(place, "states " + std::to_string(size) + " bytes but has " + std::to_string(buffers_.back().size()));
}

std::size_t GltfFile::natural(const nlohmann::json& object, const char* key, std::size_t fallback,
                              const std::string& place) {
  const auto& value = memberOf(object, key);
  if (value.is_null()) return fallback;
  if (value.is_number_unsigned() && value.get<std::uint64_t>() <= kLargest) return value.get<std::size_t>();
  if (value.is_number_float() && value.get<double>() >= 0 && value.get<double>() <= static_cast<double>(kLargest) &&
      value.get<double>() == static_cast<double>(static_cast<std::size_t>(value.get<double>())))
    return static_cast<std::size_t>(value.get<double>());  // "12.0", which some exporters write
  fail(place + "/" + key, "is not a whole number from 0 to 4294967295");
  return fallback;
}

std::optional<std::size_t> GltfFile::index(const nlohmann::json& object, const char* key, const std::string& place) {
  if (memberOf(object, key).is_null()) return std::nullopt;
  const auto value = natural(object, key, 0, place);
  return failed() ? std::nullopt : std::optional(value);
}

std::vector<double> GltfFile::numbers(const nlohmann::json& object, const char* key, std::size_t count,
                                      const std::string& place) {
  const auto& value = memberOf(object, key);
  if (value.is_null()) return {};
  std::vector<double> result;
  if (value.is_array())
    for (const auto& x : value)
      if (x.is_number()) result.push_back(x.get<double>());
  if (result.size() != count || !value.is_array() || value.size() != count) {
    fail(place + "/" + key, "is not " + std::to_string(count) + " numbers");
    return {};
  }
  return result;
}

std::string GltfFile::text(const nlohmann::json& object, const char* key) const {
  const auto& value = memberOf(object, key);
  return value.is_string() ? value.get<std::string>() : std::string();
}

bool GltfFile::spend(std::size_t bytes, const std::string& place) {
  if (bytes > allowance_ - spent_) {
    fail(place, "decompresses to more than 64 times the file size");
    return false;
  }
  spent_ += bytes;
  return true;
}

}  // namespace standpoint

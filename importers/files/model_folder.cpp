// SPDX-License-Identifier: GPL-3.0-or-later
#include "importers/files/model_folder.h"

#include <algorithm>
#include <cstring>
#include <optional>
#include <string_view>

#include "importers/files/file_bytes.h"

namespace standpoint {

namespace {

namespace fs = std::filesystem;

constexpr std::uint64_t kMaxImageBytes = 256U << 20U;
constexpr std::size_t kMaxEntries = 100000;  // of a folder that is searched for a name in another case

std::string lower(std::string text) {
  for (auto& c : text)
    if (c >= 'A' && c <= 'Z') c = static_cast<char>(c - 'A' + 'a');
  return text;
}

bool isThere(const fs::path& path) {
  std::error_code code;
  return fs::exists(path, code);
}

// The entry of `folder` whose name differs in case only; the first by name where there are several.
std::optional<fs::path> inOtherCase(const fs::path& folder, const std::string& name) {
  std::optional<fs::path> best;
  std::error_code code;
  std::size_t seen = 0;
  for (fs::directory_iterator it(folder, code), end; !code && it != end && seen < kMaxEntries;
       it.increment(code), ++seen)
    if (lower(it->path().filename().string()) == lower(name) && (!best || it->path() < *best)) best = it->path();
  return best;
}

std::optional<ModelFolder::Found> walk(const fs::path& from, const fs::path& relative) {
  ModelFolder::Found found{from, true};
  for (const auto& part : relative) {
    auto next = found.file / part;
    if (!isThere(next)) {
      const auto other = inOtherCase(found.file, part.string());
      if (!other) return std::nullopt;
      next = *other;
      found.as_named = false;
    }
    found.file = next;
  }
  std::error_code code;
  if (!fs::is_regular_file(found.file, code)) return std::nullopt;
  return found;
}

bool isWithin(const fs::path& file, const fs::path& folder) {
  std::error_code code;
  const auto real = fs::canonical(file, code);
  if (code) return false;
  return std::mismatch(folder.begin(), folder.end(), real.begin(), real.end()).first == folder.end();
}

}  // namespace

ModelFolder::ModelFolder(const fs::path& model) {
  std::error_code code;
  root_ = fs::canonical(model.has_parent_path() ? model.parent_path() : fs::path("."), code);
}

Result<ModelFolder::Found> ModelFolder::find(const std::string& name, const fs::path& base) const {
  std::string plain = name;
  std::replace(plain.begin(), plain.end(), '\\', '/');
  if (plain.size() > 1 && plain.front() == '"' && plain.back() == '"') plain = plain.substr(1, plain.size() - 2);
  if (plain.empty() || plain.find('\0') != std::string::npos || plain.size() > 4096)
    return failure(ErrorKind::unusable, "is not a valid file name", name.substr(0, 60));
  const auto path = fs::path(plain).lexically_normal();
  const bool elsewhere = path.is_absolute() || *path.begin() == ".." || (plain.size() > 1 && plain[1] == ':');
  bool outside = elsewhere;
  for (const bool last_part_only : {false, true}) {
    if (elsewhere && !last_part_only) continue;
    for (const auto& from : {base, root_}) {
      auto found = walk(from, last_part_only ? path.filename() : path);
      if (!found) continue;
      if (!isWithin(found->file, root_)) {
        outside = true;
        continue;
      }
      found->as_named &= !last_part_only || path == path.filename();
      return *found;
    }
  }
  return failure(ErrorKind::unusable, outside ? "is outside the model's folder and was not read" : "is missing",
                 name.substr(0, 200));
}

Result<std::int32_t> ImageFiles::add(const fs::path& file) {
  if (const auto known = known_.find(file); known != known_.end()) return known->second;
  TRY_ASSIGN(const auto bytes, FileBytes::open(file));
  TRY_ASSIGN(auto text, bytes.all(kMaxImageBytes));
  Image image;
  image.name = file.filename().string();
  if (text.starts_with("\x89PNG\r\n\x1A\n"))
    image.media_type = "image/png";
  else if (text.starts_with("\xFF\xD8\xFF"))
    image.media_type = "image/jpeg";
  else
    return failure(ErrorKind::unusable, "is neither PNG nor JPEG; convert it to one of these formats", image.name);
  image.bytes.resize(text.size());
  std::memcpy(image.bytes.data(), text.data(), text.size());
  images_.push_back(std::make_shared<const Image>(std::move(image)));
  return known_[file] = static_cast<std::int32_t>(images_.size()) - 1;
}

}  // namespace standpoint

// SPDX-License-Identifier: GPL-3.0-or-later
#include "editor/desktop/file_list.h"

#include <algorithm>
#include <cctype>

#include <fmt/format.h>

#include "editor/words/words.h"

namespace standpoint {

namespace {

std::string lower(std::string text) {
  for (auto& c : text) c = static_cast<char>(std::tolower(static_cast<unsigned char>(c)));
  return text;
}

bool before(const FileRow& a, const FileRow& b, FileOrder order) {
  if (order == FileOrder::size && a.bytes != b.bytes) return a.bytes < b.bytes;
  if (order == FileOrder::date && a.changed != b.changed) return a.changed < b.changed;
  const auto left = lower(a.name), right = lower(b.name);
  return left != right ? left < right : a.name < b.name;
}

}  // namespace

bool isProjectFolder(const std::filesystem::path& folder) {
  std::error_code ignored;
  return std::filesystem::is_regular_file(folder / "project.json", ignored);
}

FileListing listFolder(const std::filesystem::path& folder, std::span<const std::string> extensions, FileOrder order,
                       bool descending) {
  FileListing listing;
  std::error_code error;
  std::filesystem::directory_iterator entries(folder, error);
  for (; !error && entries != std::filesystem::directory_iterator(); entries.increment(error)) {
    FileRow row;
    row.name = entries->path().filename().string();
    if (row.name.empty() || row.name[0] == '.') continue;
    std::error_code ignored;  // of one entry: a broken link is listed as an empty file
    row.folder = entries->is_directory(ignored);
    const auto extension = lower(entries->path().extension().string());
    if (!row.folder && !extensions.empty() &&
        std::find(extensions.begin(), extensions.end(), extension) == extensions.end())
      continue;
    row.project = row.folder && isProjectFolder(entries->path());
    if (!row.folder) row.bytes = entries->file_size(ignored);
    if (ignored) row.bytes = 0;
    row.changed = entries->last_write_time(ignored);
    listing.rows.push_back(std::move(row));
  }
  if (error) return {{}, error.message()};
  std::sort(listing.rows.begin(), listing.rows.end(), [&](const FileRow& a, const FileRow& b) {
    if (a.folder != b.folder) return a.folder;
    return descending ? before(b, a, order) : before(a, b, order);
  });
  return listing;
}

std::uint64_t folderSize(const std::filesystem::path& folder, std::string_view extension) {
  using std::filesystem::directory_options, std::filesystem::recursive_directory_iterator;
  std::uint64_t bytes = 0;
  std::error_code error, gone;
  for (recursive_directory_iterator at(folder, directory_options::skip_permission_denied, error), end;
       !error && at != end; at.increment(error))
    if (at->is_regular_file(gone) && !at->is_symlink(gone) &&
        (extension.empty() || at->path().extension() == extension))
      if (const auto size = at->file_size(gone); !gone) bytes += size;
  return bytes;
}

std::string readableSize(std::uint64_t bytes) {
  const auto b = static_cast<double>(bytes);
  if (b < 1000) return fmt::format("{} B", bytes);
  if (b < 1e6) return figures("{:.1f} kB", b / 1e3);
  if (b < 1e9) return figures("{:.1f} MB", b / 1e6);
  return figures("{:.2f} GB", b / 1e9);
}

}  // namespace standpoint

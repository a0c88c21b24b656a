// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <filesystem>
#include <map>
#include <memory>
#include <string>
#include <vector>

#include "core/environment.h"
#include "core/result.h"

namespace standpoint {

// The files that a model names (materials, textures): regular files within the model's own folder and below it, and
// never outside, whatever the name or a symbolic link says.
class ModelFolder {
 public:
  explicit ModelFolder(const std::filesystem::path& model);

  struct Found {
    std::filesystem::path file;
    bool as_named = true;  // false: the case differs, or the folders of the name were left out
  };
  // `name` as written: with backslashes, quotes, another case, or a path of another machine, of which only the last
  // part is looked for. Relative to `base` first (the folder of the file that names it), then to the model's folder.
  Result<Found> find(const std::string& name, const std::filesystem::path& base) const;
  const std::filesystem::path& root() const { return root_; }

 private:
  std::filesystem::path root_;
};

// The images of a model, each file once.
class ImageFiles {
 public:
  // Index into images(). PNG and JPEG stay as they are; others are refused by name.
  Result<std::int32_t> add(const std::filesystem::path& file);
  std::vector<std::shared_ptr<const Image>> images() && { return std::move(images_); }

 private:
  std::vector<std::shared_ptr<const Image>> images_;
  std::map<std::filesystem::path, std::int32_t> known_;
};

}  // namespace standpoint

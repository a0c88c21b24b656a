// SPDX-License-Identifier: GPL-3.0-or-later
#include "editor/clouds/cloud_loader.h"

#include <cstdint>
#include <span>
#include <string>
#include <unistd.h>
#include <utility>

#include <fmt/format.h>

#include "editor/desktop/user_folders.h"
#include "pointclouds/formats.h"
#include "pointclouds/octree/octree_builder.h"

namespace standpoint {

namespace {

// The same on every machine and run, so that the cache is found again.
std::uint64_t hashOf(const std::string& text) {
  std::uint64_t hash = 14695981039346656037U;
  for (const char c : text) hash = (hash ^ static_cast<unsigned char>(c)) * 1099511628211U;
  return hash;
}

}  // namespace

std::vector<std::filesystem::path> octreePlaces(const std::filesystem::path& cloud) {
  std::error_code ignored;
  const auto whole = std::filesystem::absolute(cloud, ignored);
  const std::string name = cloud.filename().string();
  return {whole.parent_path() / (name + ".octree"),
          octreeCache() / fmt::format("{:016x}-{}.octree", hashOf(whole.string()), name)};
}

Result<Cloud> cloudOf(std::shared_ptr<const OctreeFile> octree, const std::filesystem::path& file,
                      const Eigen::Vector3d& shift_m) {
  constexpr std::size_t kSample = 200000;  // points that say how the whole is to be coloured
  Cloud cloud{.file = file, .header = octree->header(), .shift_m = shift_m, .points_in_file = octree->points()};
  for (std::size_t i = 0; i < octree->nodes().size() && cloud.points.size() < kSample; ++i) {
    TRY_ASSIGN(auto points, octree->read(i));
    for (auto& p : points) {
      for (int k = 0; k < 3; ++k)
        p.position_m[static_cast<std::size_t>(k)] += static_cast<float>(octree->nodes()[i].min_m[k]);
      cloud.points.push_back(p);
    }
  }
  cloud.colouring = colouringOf(cloud.points, cloud.header.channels);
  for (const auto& p : cloud.points) cloud.colours.push_back(colourOf(p, p.position_m[2], cloud.colouring));
  cloud.octree = std::move(octree);
  return cloud;
}

Result<Cloud> openCloud(const std::filesystem::path& file, const Eigen::Vector3d& shift_m, std::uint64_t most_in_memory,
                        PointSink* preview, Progress& progress) {
  TRY_ASSIGN(const auto points, pointsIn(std::span(&file, 1)));
  if (points <= most_in_memory) return sampleCloud(std::span(&file, 1), points, shift_m, most_in_memory, progress);
  TRY_ASSIGN(const auto key, octreeKeyOf(file));
  const auto places = octreePlaces(file);
  for (const auto& place : places)
    if (auto octree = OctreeFile::open(place, key)) return cloudOf(*std::move(octree), file, shift_m);
  const bool beside = ::access(places.front().parent_path().c_str(), W_OK) == 0;
  const auto& place = beside ? places.front() : places.back();
  std::error_code ignored;  // what cannot be written to says so itself
  std::filesystem::create_directories(place.parent_path(), ignored);
  OctreeOptions options;
  options.watcher = preview;
  TRY(buildOctree(sourceOf(file), key, place, options, progress));
  TRY_ASSIGN(auto octree, OctreeFile::open(place, key));
  return cloudOf(std::move(octree), file, shift_m);
}

void CloudLoader::start(const std::vector<std::filesystem::path>& files, const Eigen::Vector3d& shift_m,
                        std::function<void()> wake) {
  drop();
  preview_ = std::make_shared<LiveCloud>(shift_m, wake);
  task_ = std::make_unique<Task<Cloud>>(
      files.size() == 1 ? "Show " + files.front().filename().string() : "Show all scans together",
      [files, shift_m, preview = preview_](Progress& progress) -> Result<Cloud> {
        if (files.size() == 1) return openCloud(files.front(), shift_m, kMostInMemory, preview.get(), progress);
        TRY_ASSIGN(const auto points, pointsIn(files));
        return sampleCloud(files, points, shift_m, kMostInMemory, progress);
      },
      std::move(wake));
}

void CloudLoader::drop() {
  task_.reset();
  preview_.reset();
}

std::shared_ptr<const Cloud> CloudLoader::newer() { return preview_ ? preview_->newer() : nullptr; }

std::optional<Result<Cloud>> CloudLoader::take() {
  if (!task_ || !task_->done()) return std::nullopt;
  auto cloud = task_->take();
  drop();
  return cloud;
}

}  // namespace standpoint

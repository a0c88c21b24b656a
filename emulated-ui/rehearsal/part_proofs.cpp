// SPDX-License-Identifier: GPL-3.0-or-later
#include "emulated-ui/rehearsal/part_proofs.h"

#include <cmath>

#include "emulated-ui/host.h"
#include "emulated-ui/rehearsal/all_setups.h"
#include "emulated-ui/rehearsal/part_surface.h"
#include "emulated-ui/sighting.h"
#include "pointclouds/formats.h"

namespace standpoint {

namespace {

using Eigen::Vector3d;

constexpr std::size_t kSamplesOfAll = 200000;
constexpr std::string_view kPart = "part.";

struct SeenPart {
  double points = 0;
  SeenCells cells;
};

// Puts the points of one scan where they truly are, to the parts that they are on.
class PartReader final : public PointSink {
 public:
  PartReader(const std::vector<PartSurface>& parts, std::vector<SeenPart>& seen, const Pose& pose)
      : parts_(parts), seen_(seen), pose_(pose) {}
  Result<void> begin(const ScanHeader& header) override {
    is_of_.assign(parts_.size(), std::vector<bool>(header.products.size()));
    for (std::size_t k = 0; k < parts_.size(); ++k)
      for (std::size_t i = 0; i < header.products.size(); ++i) is_of_[k][i] = parts_[k].isLabel(header.products[i]);
    return {};
  }
  Result<void> write(const PointBlock& block) override {
    if (block.product.empty()) return {};
    for (std::size_t i = 0; i < block.size(); ++i)
      for (std::size_t k = 0; k < parts_.size(); ++k) {
        if (!is_of_[k][block.product[i]]) continue;
        const Vector3d p = pose_ * Vector3d(block.x_m[i], block.y_m[i], block.z_m[i]);
        if (!parts_[k].inBox(p)) continue;
        seen_[k].points += 1;
        seen_[k].cells.add(p);
      }
    return {};
  }
  Result<void> end() override { return {}; }
  Result<void> close() override { return {}; }

 private:
  const std::vector<PartSurface>& parts_;
  std::vector<SeenPart>& seen_;
  Pose pose_;
  std::vector<std::vector<bool>> is_of_;
};

}  // namespace

std::map<std::string, double> readParts(const Exercise& exercise, const Device& device, const Document& document) {
  std::map<std::string, double> figures;
  if (exercise.parts.empty() || !document.imported || !document.job) return figures;
  Progress quiet;
  const auto environment = document.environment();
  const auto scene = RayScene::build(environment, quiet);
  if (!scene) return figures;
  const auto samples = sampleSurfaces(**scene, kSamplesOfAll, 1, quiet);
  if (!samples) return figures;
  const Vector3d shift = document.georeference->shift_m;
  std::vector<PartSurface> parts;
  for (const auto& [name, part] : exercise.parts) parts.emplace_back(part, *environment, shift);
  std::vector<SeenPart> seen(parts.size());
  for (const auto* setup : allSetups(device)) {
    const auto* station = stationOf(document, setup->station);
    const auto* format = cloudFormatFor(setup->file);
    if (station == nullptr || format == nullptr) continue;
    PartReader reader(
        parts, seen,
        {leaning(station->true_pose.rotation, setup->stood_x_deg, setup->stood_y_deg), station->true_pose.translation});
    (void)format->read(setup->file, reader, quiet);  // what is gone shows nothing
  }
  std::size_t k = 0;
  for (const auto& [name, part] : exercise.parts) {
    double all = 0;
    std::vector<Vector3d> unseen;
    for (const auto& sample : samples->samples) {
      if (!parts[k].has(sample)) continue;
      all += 1;
      if (!seen[k].cells.near(sample.place.position)) unseen.push_back(sample.place.position);
    }
    const double each = samples->each_m2(), seen_m2 = (all - static_cast<double>(unseen.size())) * each;
    const auto prefix = std::string(kPart) + name + ".";
    const auto figure = [&](const char* what) -> double& { return figures[prefix + what]; };
    figure("area") = all * each;
    figure("seen") = all > 0 ? seen_m2 / (all * each) : 0;
    figure("points") = seen[k].points;
    if (seen[k].points > 0 && seen_m2 > 0) figure("spacing") = std::sqrt(seen_m2 / seen[k].points) * 1000;
    figure("hole") = 0;
    if (!unseen.empty()) {
      const auto patch = largestPatch(unseen);
      Vector3d middle = shift;
      for (const auto& p : patch) middle += p / static_cast<double>(patch.size());
      figure("hole") = static_cast<double>(patch.size()) * each;
      figure("hole_x") = middle.x(), figure("hole_y") = middle.y(), figure("hole_z") = middle.z();
    }
    ++k;
  }
  return figures;
}

std::optional<PartFigure> partFigure(const std::string& fact, const Exercise& exercise) {
  if (!fact.starts_with(kPart)) return std::nullopt;
  const auto dot = fact.rfind('.');
  if (dot < kPart.size() || !exercise.parts.contains(fact.substr(kPart.size(), dot - kPart.size())))
    return std::nullopt;
  const auto what = fact.substr(dot + 1);
  if (what == "area" || what == "hole") return PartFigure{"m²", numbers(0, 1e9)};
  if (what == "seen") return PartFigure{"", numbers(0, 1)};
  if (what == "points") return PartFigure{"", numbers(0, 1e12)};
  if (what == "spacing") return PartFigure{"mm", numbers(0, 1e6)};
  if (what == "hole_x" || what == "hole_y" || what == "hole_z") return PartFigure{"m", numbers(-1e9, 1e9)};
  return std::nullopt;
}

}  // namespace standpoint

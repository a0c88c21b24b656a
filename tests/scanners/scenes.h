// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <memory>
#include <mutex>
#include <vector>

#include "core/environment.h"
#include "core/points.h"
#include "scanners/engine/ray_engine.h"

namespace standpoint::testing {

// Builds environments of simple bodies whose geometry is known exactly.
class SceneBuilder {
 public:
  SceneBuilder();
  std::uint32_t surface(float grey);
  // A parallelogram o, o+u, o+u+v, o+v as one product; its normal is u × v.
  std::uint32_t quad(const Eigen::Vector3d& o, const Eigen::Vector3d& u, const Eigen::Vector3d& v,
                     std::uint32_t surface = 0);
  // The six faces of a box, normals outwards or (room) inwards.
  std::uint32_t box(const Eigen::Vector3d& low, const Eigen::Vector3d& high, bool room, std::uint32_t surface = 0);
  std::uint32_t sphere(const Eigen::Vector3d& centre, double radius, int rings, std::uint32_t surface = 0);
  // What rays meet as a sphere; its triangles are an octahedron's.
  std::uint32_t ball(const Eigen::Vector3d& centre, double radius);
  // Another placement of the mesh of a product.
  std::uint32_t again(std::uint32_t product, const Eigen::Affine3d& world_from_mesh);
  void hide(std::uint32_t product) { environment_->products[product].tangible = false; }
  std::shared_ptr<const Environment> environment() const { return environment_; }
  std::shared_ptr<const RayScene> build() const;

 private:
  std::uint32_t add(Mesh mesh);
  std::vector<RoundInstance> balls_;
  std::shared_ptr<Environment> environment_ = std::make_shared<Environment>();
};

// Keeps all points: for tests only.
class PointsKept final : public PointSink {
 public:
  Result<void> begin(const ScanHeader&) override { return {}; }
  Result<void> write(const PointBlock& block) override;
  Result<void> end() override { return {}; }
  Result<void> close() override { return {}; }
  PointBlock all;
  std::size_t largest_block = 0;
};

struct Scanned {
  PointBlock points;
  ScanCount count;
};

std::vector<Instrument> everyInstrument();
std::vector<Instrument> instruments();  // those for a tripod
Instrument instrument(const std::string& id);

// A small grid over a window of the dome with the instrument's own noise at its best quality.
ScanSettings window(const Instrument& instrument, double azimuth_from_deg, double azimuth_to_deg,
                    double elevation_from_deg, double elevation_to_deg, std::uint32_t columns, std::uint32_t rows);

Scanned scanned(const RayScene& scene, const MaterialAssignment& assignment, const Instrument& instrument,
                const ScanSettings& settings, const ScanOptions& options, const Pose& pose = {});

// Every product's surfaces made of one Lambert material of the given reflectance (or the given material).
MaterialAssignment allOf(const Environment& environment, double reflectance);
MaterialAssignment allOf(const Environment& environment, PhysicalMaterial material);
PhysicalMaterial lambert(double reflectance);

// Without systematic errors, so that only white noise is left.
Instrument withoutBias(Instrument instrument);

}  // namespace standpoint::testing

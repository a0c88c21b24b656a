// SPDX-License-Identifier: GPL-3.0-or-later
#include "tests/scanners/scenes.h"

#include <algorithm>
#include <numbers>
#include <stdexcept>

#include "core/units.h"

namespace standpoint::testing {

SceneBuilder::SceneBuilder() { surface(0.8F); }

std::uint32_t SceneBuilder::surface(float grey) {
  Surface surface;
  surface.colour = {grey, grey, grey, 1};
  environment_->surfaces.push_back(surface);
  return static_cast<std::uint32_t>(environment_->surfaces.size() - 1);
}

std::uint32_t SceneBuilder::add(Mesh mesh) {
  Instance instance;
  instance.mesh = static_cast<std::uint32_t>(environment_->meshes.size());
  instance.product = static_cast<std::uint32_t>(environment_->products.size());
  environment_->meshes.push_back(std::make_shared<Mesh>(std::move(mesh)));
  environment_->products.emplace_back();
  environment_->instances.push_back(instance);
  return instance.product;
}

std::uint32_t SceneBuilder::again(std::uint32_t product, const Eigen::Affine3d& world_from_mesh) {
  Instance instance = environment_->instances[product];
  instance.product = static_cast<std::uint32_t>(environment_->products.size());
  instance.world_from_mesh = world_from_mesh;
  environment_->products.emplace_back();
  environment_->instances.push_back(instance);
  return instance.product;
}

namespace {

void addQuad(Mesh& mesh, const Eigen::Vector3d& o, const Eigen::Vector3d& u, const Eigen::Vector3d& v,
             std::uint32_t surface) {
  const auto first = static_cast<std::uint32_t>(mesh.positions.size());
  for (const Eigen::Vector3d& p : {o, Eigen::Vector3d(o + u), Eigen::Vector3d(o + u + v), Eigen::Vector3d(o + v)})
    mesh.positions.push_back(p.cast<float>());
  mesh.triangles.push_back({first, first + 1, first + 2});
  mesh.triangles.push_back({first, first + 2, first + 3});
  mesh.surface_of_triangle.insert(mesh.surface_of_triangle.end(), 2, surface);
}

}  // namespace

std::uint32_t SceneBuilder::quad(const Eigen::Vector3d& o, const Eigen::Vector3d& u, const Eigen::Vector3d& v,
                                 std::uint32_t surface) {
  Mesh mesh;
  addQuad(mesh, o, u, v, surface);
  return add(std::move(mesh));
}

std::uint32_t SceneBuilder::box(const Eigen::Vector3d& low, const Eigen::Vector3d& high, bool room,
                                std::uint32_t surface) {
  Mesh mesh;
  for (int axis = 0; axis < 3; ++axis)
    for (const bool upper : {false, true}) {
      const Eigen::Vector3d size = high - low;
      Eigen::Vector3d u = Eigen::Vector3d::Zero(), v = Eigen::Vector3d::Zero(), o = low;
      u[(axis + 1) % 3] = size[(axis + 1) % 3];
      v[(axis + 2) % 3] = size[(axis + 2) % 3];
      if (upper) o[axis] = high[axis];
      if (upper != room)
        addQuad(mesh, o, u, v, surface);
      else
        addQuad(mesh, o, v, u, surface);
    }
  return add(std::move(mesh));
}

std::uint32_t SceneBuilder::sphere(const Eigen::Vector3d& centre, double radius, int rings, std::uint32_t surface) {
  Mesh mesh;
  const int sectors = 2 * rings;
  const auto at = [&](int ring, int sector) {
    const double polar = std::numbers::pi * ring / rings, turn = 2 * std::numbers::pi * sector / sectors;
    return Eigen::Vector3d(centre + radius * Eigen::Vector3d(std::sin(polar) * std::cos(turn),
                                                             std::sin(polar) * std::sin(turn), std::cos(polar)));
  };
  for (int ring = 0; ring < rings; ++ring)
    for (int sector = 0; sector < sectors; ++sector) {
      const auto first = static_cast<std::uint32_t>(mesh.positions.size());
      for (const auto& p : {at(ring, sector), at(ring + 1, sector), at(ring + 1, sector + 1), at(ring, sector + 1)})
        mesh.positions.push_back(p.cast<float>());
      mesh.triangles.push_back({first, first + 1, first + 2});
      mesh.triangles.push_back({first, first + 2, first + 3});
      mesh.surface_of_triangle.insert(mesh.surface_of_triangle.end(), 2, surface);
    }
  return add(std::move(mesh));
}

std::uint32_t SceneBuilder::ball(const Eigen::Vector3d& centre, double radius) {
  balls_.push_back({static_cast<std::uint32_t>(environment_->instances.size()), radius});
  const auto product = sphere({0, 0, 0}, radius, 2);
  environment_->instances.back().world_from_mesh = Eigen::Affine3d(Eigen::Translation3d(centre));
  return product;
}

std::shared_ptr<const RayScene> SceneBuilder::build() const {
  Progress progress;
  auto scene = RayScene::build(environment_, progress, balls_);
  if (!scene) throw std::runtime_error(describe(scene.error()));
  return *scene;
}

Result<void> PointsKept::write(const PointBlock& block) {
  largest_block = std::max(largest_block, block.size());
  const auto append = [](auto& to, const auto& from) { to.insert(to.end(), from.begin(), from.end()); };
  append(all.x_m, block.x_m), append(all.y_m, block.y_m), append(all.z_m, block.z_m);
  append(all.intensity, block.intensity), append(all.row, block.row), append(all.column, block.column);
  append(all.red, block.red), append(all.green, block.green), append(all.blue, block.blue);
  append(all.product, block.product), append(all.material, block.material);
  append(all.time_s, block.time_s), append(all.return_number, block.return_number),
      append(all.return_count, block.return_count);
  append(all.truth.x_m, block.truth.x_m), append(all.truth.y_m, block.truth.y_m),
      append(all.truth.z_m, block.truth.z_m);
  append(all.truth.range_m, block.truth.range_m), append(all.truth.incidence_rad, block.truth.incidence_rad);
  append(all.truth.received_db, block.truth.received_db), append(all.truth.flags, block.truth.flags);
  return {};
}

std::vector<Instrument> everyInstrument() {
  auto read = readInstruments(SOURCE_DIR "/scanners/instruments");
  if (!read) throw std::runtime_error(describe(read.error()));
  return *read;
}

std::vector<Instrument> instruments() {
  auto all = everyInstrument();
  std::erase_if(all, [](const Instrument& i) { return i.moving.has_value(); });
  return all;
}

Instrument instrument(const std::string& id) {
  for (auto& candidate : everyInstrument())
    if (candidate.id == id) return candidate;
  throw std::runtime_error("no instrument " + id);
}

ScanSettings window(const Instrument& instrument, double azimuth_from_deg, double azimuth_to_deg,
                    double elevation_from_deg, double elevation_to_deg, std::uint32_t columns, std::uint32_t rows) {
  ScanSettings settings = *resolveSettings(instrument, {});
  settings.azimuth_from_rad = azimuth_from_deg * kRadPerDeg;
  settings.azimuth_to_rad = azimuth_to_deg * kRadPerDeg;
  settings.elevation_from_rad = elevation_from_deg * kRadPerDeg;
  settings.elevation_to_rad = elevation_to_deg * kRadPerDeg;
  settings.columns = columns;
  settings.rows = rows;
  settings.noise_factor = 1;
  return settings;
}

Scanned scanned(const RayScene& scene, const MaterialAssignment& assignment, const Instrument& instrument,
                const ScanSettings& settings, const ScanOptions& options, const Pose& pose) {
  PointsKept sink;
  Progress progress;
  const auto count = scan(scene, assignment, instrument, settings, pose, options, sink, progress);
  if (!count) throw std::runtime_error(describe(count.error()));
  return {std::move(sink.all), *count};
}

PhysicalMaterial lambert(double reflectance) {
  PhysicalMaterial material;
  material.id = "lambert";
  material.reflectance = {{1550, reflectance}};
  return material;
}

MaterialAssignment allOf(const Environment& environment, PhysicalMaterial material) {
  MaterialAssignment assignment;
  assignment.materials.push_back(std::move(material));
  for (std::uint32_t product = 0; product < environment.products.size(); ++product)
    for (std::uint32_t surface = 0; surface < environment.surfaces.size(); ++surface)
      assignment.surfaces.push_back({product, surface, 0, "test"});
  return assignment;
}

MaterialAssignment allOf(const Environment& environment, double reflectance) {
  return allOf(environment, lambert(reflectance));
}

Instrument withoutBias(Instrument instrument) {
  instrument.range_bias_m = instrument.range_bias_ppm = 0;
  instrument.angle_sigma_rad = instrument.angle_jitter_rad;
  instrument.range_offset = {};
  return instrument;
}

}  // namespace standpoint::testing

// SPDX-License-Identifier: GPL-3.0-or-later
#include <cstdlib>
#include <fstream>
#include <map>
#include <set>

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include "importers/importers.h"

namespace standpoint::test {
namespace {

using Json = nlohmann::json;

const std::filesystem::path kSamples = std::filesystem::path(BINARY_DIR) / "samples";
const std::filesystem::path kSource = std::filesystem::path(SOURCE_DIR) / "samples";

std::string bytes(const std::filesystem::path& file) {
  std::ifstream stream(file, std::ios::binary);
  EXPECT_TRUE(stream.is_open()) << file;
  return {std::istreambuf_iterator<char>(stream), {}};
}

TEST(Samples, AreMadeByteForByteTheSameTwice) {
  const auto folder = std::filesystem::path(BINARY_DIR) / "scratch" / "samples-again";
  std::filesystem::remove_all(folder);
  ASSERT_EQ(std::system(("'" SAMPLES_PROGRAM "' '" + folder.string() + "'").c_str()), 0);
  for (const char* name : {"house.ifc", "street.ifc", "corridor.ifc", "turbine.ifc", "ornament.glb"}) {
    EXPECT_GT(bytes(folder / name).size(), 50000U) << name;
    EXPECT_EQ(bytes(folder / name), bytes(kSamples / name)) << name;
  }
}

// Every #n that a record uses is defined in the file, and nothing is defined twice.
TEST(Samples, ReferencesOfTheIfcFilesResolve) {
  for (const char* name : {"house.ifc", "street.ifc", "corridor.ifc", "turbine.ifc"}) {
    const auto text = bytes(kSamples / name);
    std::set<int> defined, used;
    for (std::size_t i = 0; i < text.size(); ++i) {
      if (text[i] != '#' || !std::isdigit(static_cast<unsigned char>(text[i + 1]))) continue;
      const int id = std::atoi(text.c_str() + i + 1);
      if (text[i - 1] == '\n') {
        EXPECT_TRUE(defined.insert(id).second) << id;
      } else {
        used.insert(id);
      }
    }
    EXPECT_GT(defined.size(), 100U);
    for (const int id : used) EXPECT_TRUE(defined.contains(id)) << name << " #" << id;
  }
}

TEST(Samples, GlobalIdsAreUnique) {
  Progress progress;
  const auto model = importFile(kSamples / "street.ifc", {}, progress);
  ASSERT_TRUE(model) << describe(model.error());
  std::set<std::string> ids;
  for (const auto& product : model->environment.products) {
    EXPECT_EQ(product.global_id.size(), 22U);
    EXPECT_TRUE(ids.insert(product.global_id).second) << product.name;
  }
}

class Sample : public ::testing::TestWithParam<const char*> {
 protected:
  void SetUp() override {
    const std::string name = GetParam();
    expected_ = Json::parse(bytes(kSource / name / "expected.json"));
    const auto job = Json::parse(bytes(kSource / name / "job.json"));
    Progress progress;
    auto model = importFile(kSamples / job.at(0).at("files").at(0).get<std::string>(), {}, progress);
    ASSERT_TRUE(model) << describe(model.error());
    model_ = std::move(*model);
  }

  const Environment& environment() const { return model_.environment; }

  // Σ over the instances of the products with that name, standing in that storey.
  double volumeOf(const std::string& storey, const std::string& name) const {
    double sum = 0;
    for (const auto& instance : environment().instances) {
      const auto& product = environment().products[instance.product];
      if (product.name != name || (!storey.empty() && product.storey != storey)) continue;
      EXPECT_TRUE(isClosed(*environment().meshes[instance.mesh])) << name;
      sum += volume(*environment().meshes[instance.mesh]) * std::abs(instance.world_from_mesh.linear().determinant());
    }
    return sum;
  }

  double areaOf(const std::string& ifc_class, const std::string& surface) const {
    double sum = 0;
    for (const auto& instance : environment().instances) {
      if (environment().products[instance.product].ifc_class != ifc_class) continue;
      Mesh part = *environment().meshes[instance.mesh];
      std::size_t kept = 0;
      for (std::size_t i = 0; i < part.triangles.size(); ++i)
        if (environment().surfaces[part.surface_of_triangle[i]].name == surface)
          part.triangles[kept++] = part.triangles[i];
      part.triangles.resize(kept);
      sum += area(part);
    }
    return sum;
  }

  Json expected_;
  ImportedModel model_;
};

TEST_P(Sample, HasTheProductsOfItsPlan) {
  std::map<std::string, int> count;
  for (const auto& product : environment().products)
    if (product.tangible) ++count[product.ifc_class];
  EXPECT_EQ(Json(count), expected_["products"]);
}

TEST_P(Sample, LosesNothingOnImport) {
  for (const auto& issue : model_.report.issues)
    EXPECT_NE(issue.severity, Severity::loss) << issue.source << " " << issue.message;
}

TEST_P(Sample, HasTheBoundsOfItsPlan) {
  const auto box = bounds(environment());
  for (int i = 0; i < 3; ++i) {
    EXPECT_NEAR(box.min[i] + model_.georeference.shift_m[i], expected_["bounds_m"][0][i].get<double>(), 1e-4) << i;
    EXPECT_NEAR(box.max[i] + model_.georeference.shift_m[i], expected_["bounds_m"][1][i].get<double>(), 1e-4) << i;
  }
}

TEST_P(Sample, HasTheTrianglesOfItsPlan) {
  EXPECT_GE(triangleCount(environment()), expected_["triangles"]["at_least"].get<std::size_t>());
  EXPECT_LE(triangleCount(environment()), expected_["triangles"]["at_most"].get<std::size_t>());
}

TEST_P(Sample, HasTheVolumesWorkedOutByHand) {
  for (const auto& entry : expected_["volumes_m3"]) {
    const double value = entry["value"].get<double>();
    EXPECT_NEAR(volumeOf(entry["storey"], entry["name"]), value, 1e-3 * value) << entry;
  }
}

TEST_P(Sample, HasTheAreasWorkedOutByHand) {
  for (const auto& entry : expected_["areas_m2"]) {
    const double value = entry["value"].get<double>();
    EXPECT_NEAR(areaOf(entry["class"], entry["surface"]), value, 1e-4 * value) << entry;
  }
}

TEST_P(Sample, HasItsGeoreference) {
  if (!expected_.contains("georeference")) {
    EXPECT_FALSE(model_.georeference.map_from_file);
    return;
  }
  const auto& want = expected_["georeference"];
  ASSERT_TRUE(model_.georeference.map_from_file);
  const auto& map = *model_.georeference.map_from_file;
  EXPECT_EQ(model_.georeference.crs, want["crs"].get<std::string>());
  EXPECT_EQ(map.eastings_m, want["eastings_m"]);
  EXPECT_EQ(map.northings_m, want["northings_m"]);
  EXPECT_EQ(map.orthogonal_height_m, want["height_m"]);
  EXPECT_NEAR(std::atan2(map.x_axis_ordinate, map.x_axis_abscissa) * 180 / 3.14159265358979, 23, 1e-9);
}

// A tripod stands where the job puts it: floor below within a centimetre, half a metre of air around the instrument.
TEST_P(Sample, StationsStandInFreeSpace) {
  const auto job = Json::parse(bytes(kSource / GetParam() / "job.json"));
  int stations = 0;
  for (const auto& step : job) {
    if (step["verb"] != "station") continue;
    ++stations;
    const bool on = step.contains("on");
    const auto& p = step[on ? "on" : "at"];
    const Eigen::Vector3d centre(p[0], p[1], p[2].get<double>() + (on ? 1.6 : 0));
    double floor = -1e9;
    for (const auto& instance : environment().instances) {
      const auto& mesh = *environment().meshes[instance.mesh];
      for (const auto& t : mesh.triangles) {
        Eigen::Vector3d c[3];
        for (int k = 0; k < 3; ++k)
          c[k] = instance.world_from_mesh * mesh.positions[t[static_cast<std::size_t>(k)]].cast<double>() +
                 model_.georeference.shift_m - centre;
        Eigen::Vector3d low = c[0].cwiseMin(c[1]).cwiseMin(c[2]), high = c[0].cwiseMax(c[1]).cwiseMax(c[2]);
        const Eigen::Vector3d n = (c[1] - c[0]).cross(c[2] - c[0]);
        const auto side = [&](int i, int j) { return c[i].x() * c[j].y() - c[i].y() * c[j].x(); };
        const double a = side(0, 1), b = side(1, 2), d = side(2, 0);
        if (std::abs(n.z()) > 1e-9 && ((a >= 0 && b >= 0 && d >= 0) || (a <= 0 && b <= 0 && d <= 0)))
          if (const double z = n.dot(c[0]) / n.z(); z < 0) floor = std::max(floor, z);
        const double plane = n.norm() > 0 ? std::abs(n.dot(c[0])) / n.norm() : 1e9;
        const bool near = (low.array() < 0.5).all() && (high.array() > -0.5).all() && plane < 0.5;
        EXPECT_FALSE(near) << environment().products[instance.product].name << " is within 0.5 m of " << step;
      }
    }
    if (on) {
      EXPECT_NEAR(floor, -1.6, 0.01) << step;
    }
  }
  EXPECT_GE(stations, 2);
}

INSTANTIATE_TEST_SUITE_P(All, Sample, ::testing::Values("house", "street", "corridor", "turbine", "ornament"),
                         [](const auto& sample) { return std::string(sample.param); });

}  // namespace
}  // namespace standpoint::test

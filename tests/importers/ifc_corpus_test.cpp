// SPDX-License-Identifier: GPL-3.0-or-later
// Whole buildings of others against web-ifc's reading of them: bounds of every product that a beam can meet.
#include <algorithm>
#include <cstdlib>
#include <fstream>
#include <sstream>

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>
#include <zlib.h>

#include "tests/importers/ifc_fixture.h"

namespace standpoint::test {
namespace {

std::filesystem::path corpus() {
  const char* shared = std::getenv("STANDPOINT_SHARED");
  return std::filesystem::path(shared ? shared : SOURCE_DIR "/../shared") / "corpus/ifc";
}

std::string gunzip(const std::filesystem::path& path) {
  std::string text;
  gzFile in = gzopen(path.c_str(), "rb");
  char buffer[65536];
  for (int n = 0; in && (n = gzread(in, buffer, sizeof buffer)) > 0;) text.append(buffer, static_cast<std::size_t>(n));
  if (in) gzclose(in);
  return text;
}

// What the manifest calls `first`, except the railway: there web-ifc draws an arc of 362 m with 12 chords and is 0.4 m
// off.
std::vector<std::string> wholeBuildings() {
  std::vector<std::string> names;
  std::ifstream manifest(corpus() / "manifest.tsv");
  for (std::string line; std::getline(manifest, line);) {
    std::istringstream cells(line);
    std::string file, role;
    std::getline(cells, file, '\t');
    std::getline(cells, role, '\t');
    if (role == "first" && file.find("Telecom") == std::string::npos) names.push_back(file.substr(0, file.size() - 4));
  }
  return names;
}

bool isAskedFor(const nlohmann::json& product) {
  const std::string entity = product["class"];
  if (product["triangles"] == 0 || product["bounds"].is_null()) return false;
  for (const char* unseen : {"IfcOpening", "IfcSpace", "IfcVirtual", "IfcStructural", "IfcReferent", "IfcAnnotation",
                             "IfcGrid", "IfcAlignment", "IfcProjectionElement"})
    if (entity.starts_with(unseen)) return false;
  return true;
}

Bounds boundsFrom(const nlohmann::json& b) {
  Bounds bounds;
  for (int i = 0; i < 2; ++i)
    bounds.extend(Eigen::Vector3d(b[i][0].get<double>(), b[i][1].get<double>(), b[i][2].get<double>()));
  return bounds;
}

// 2 mm and 0.1 % of the size; a body with more triangles may be 1.8 % wider, because web-ifc's circles have 12
// inscribed chords.
bool agree(const Bounds& ours, const Bounds& theirs, bool finer) {
  const double size = (theirs.max - theirs.min).maxCoeff();
  const double wider = std::max((theirs.min - ours.min).maxCoeff(), (ours.max - theirs.max).maxCoeff());
  const double narrower = std::max((ours.min - theirs.min).maxCoeff(), (theirs.max - ours.max).maxCoeff());
  const double tolerance = 0.002 + 0.001 * size;
  return (wider <= tolerance && narrower <= tolerance) || (finer && narrower <= 0.002 && wider <= 0.002 + 0.018 * size);
}

TEST(IfcCorpus, WholeBuildingsHaveTheBoundsThatWebIfcSees) {
  if (!std::filesystem::exists(corpus())) GTEST_SKIP() << "no corpus at " << corpus();
  std::size_t asked = 0, agreed = 0;
  for (const std::string& name : wholeBuildings()) {
    Progress progress;
    const auto model = importFile(corpus() / (name + ".ifc"), {}, progress);
    ASSERT_TRUE(model.has_value()) << describe(model.error());
    const auto bounds = productBounds(model->environment);
    std::map<std::string, std::size_t> index;
    std::vector<std::size_t> triangles(bounds.size(), 0);
    for (std::size_t i = 0; i < bounds.size(); ++i) index[model->environment.products[i].id] = i;
    for (const Instance& i : model->environment.instances)
      triangles[i.product] += model->environment.meshes[i.mesh]->triangles.size();
    std::size_t asked_here = 0, agreed_here = 0;
    const auto oracle = nlohmann::json::parse(gunzip(corpus() / "oracle" / (name + ".json.gz")));
    for (const auto& product : oracle["products"]) {
      if (!isAskedFor(product)) continue;
      ++asked_here;
      const auto it = index.find("#" + std::to_string(product["id"].get<long>()));
      if (it == index.end() || bounds[it->second].empty()) continue;
      Bounds ours = bounds[it->second];
      ours.min += model->georeference.shift_m;
      ours.max += model->georeference.shift_m;
      agreed_here +=
          agree(ours, boundsFrom(product["bounds"]), triangles[it->second] > product["triangles"].get<std::size_t>())
              ? 1
              : 0;
    }
    EXPECT_GE(static_cast<double>(agreed_here), 0.98 * static_cast<double>(asked_here)) << name;
    asked += asked_here;
    agreed += agreed_here;
  }
  EXPECT_GT(asked, 10000U);
  EXPECT_GE(static_cast<double>(agreed), 0.995 * static_cast<double>(asked));
}

}  // namespace
}  // namespace standpoint::test

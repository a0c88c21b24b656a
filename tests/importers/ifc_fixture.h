// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdio>
#include <filesystem>
#include <fstream>
#include <string>
#include <unistd.h>

#include <gtest/gtest.h>

#include "importers/importers.h"

namespace standpoint::test {

// A file that is gone when the test is over.
class TemporaryFile {
 public:
  explicit TemporaryFile(const std::string& content, const std::string& ending = ".ifc") {
    static int count = 0;
    path_ = std::filesystem::temp_directory_path() /
            ("standpoint-" + std::to_string(::getpid()) + "-" + std::to_string(count++) + ending);
    std::ofstream(path_, std::ios::binary) << content;
  }
  ~TemporaryFile() {
    std::error_code ignored;
    std::filesystem::remove(path_, ignored);
  }
  TemporaryFile(const TemporaryFile&) = delete;
  TemporaryFile& operator=(const TemporaryFile&) = delete;
  const std::filesystem::path& path() const { return path_; }

 private:
  std::filesystem::path path_;
};

// Numbers up to 99 are the frame that every small model needs: units, placement at the origin, axes, building and
// storey.
inline std::string ifcText(const std::string& records,
                           const std::string& length_unit = "IFCSIUNIT(*,.LENGTHUNIT.,$,.METRE.)",
                           const std::string& schema = "IFC4") {
  return "ISO-10303-21;\nHEADER;\nFILE_DESCRIPTION((''),'2;1');\nFILE_NAME('','',(''),(''),'','','');\nFILE_SCHEMA(('" +
         schema +
         "'));\nENDSEC;\nDATA;\n"
         "#1=IFCCARTESIANPOINT((0.,0.,0.));\n#2=IFCAXIS2PLACEMENT3D(#1,$,$);\n#3=IFCLOCALPLACEMENT($,#2);\n"
         "#4=IFCDIRECTION((0.,0.,1.));\n#5=IFCDIRECTION((1.,0.,0.));\n#6=IFCCARTESIANPOINT((0.,0.));\n#7="
         "IFCAXIS2PLACEMENT2D(#6,$);\n"
         "#10=" +
         length_unit +
         ";\n#11=IFCUNITASSIGNMENT((#10,#13));\n#13=IFCSIUNIT(*,.PLANEANGLEUNIT.,$,.RADIAN.);\n"
         "#12=IFCGEOMETRICREPRESENTATIONCONTEXT($,'Model',3,1.E-5,#2,$);\n"
         "#20=IFCPROJECT('0000000000000000000001',$,'House',$,$,$,$,(#12),#11);\n"
         "#21=IFCBUILDING('0000000000000000000002',$,'Block A',$,$,#3,$,$,.ELEMENT.,$,$,$);\n"
         "#22=IFCBUILDINGSTOREY('0000000000000000000003',$,'Ground',$,$,#3,$,$,.ELEMENT.,2.5);\n"
         "#23=IFCRELAGGREGATES('0000000000000000000004',$,$,$,#20,(#21));\n#24=IFCRELAGGREGATES('"
         "0000000000000000000005',$,$,$,#21,(#22));\n" +
         records + "ENDSEC;\nEND-ISO-10303-21;\n";
}

// A box of x × y × z with its base centred at the origin, as records n … n+2; n+2 is the solid.
inline std::string boxSolid(int n, const std::string& x, const std::string& y, const std::string& z,
                            const std::string& position = "$") {
  const auto id = [&](int k) { return "#" + std::to_string(n + k); };
  return id(0) + "=IFCRECTANGLEPROFILEDEF(.AREA.,$,#7," + x + "," + y + ");\n" + id(2) + "=IFCEXTRUDEDAREASOLID(" +
         id(0) + "," + position + ",#4," + z + ");\n";
}

// A product of that class with these items as its body, as records n … n+2; n is the product.
inline std::string product(int n, const std::string& entity, const std::string& items,
                           const std::string& type = "SweptSolid", const std::string& placement = "#3") {
  const auto id = [&](int k) { return "#" + std::to_string(n + k); };
  return id(0) + "=" + entity + "('guid" + std::to_string(n) + "',$,'Product " + std::to_string(n) + "',$,$," +
         placement + "," + id(1) + ",$,$);\n" + id(1) + "=IFCPRODUCTDEFINITIONSHAPE($,$,(" + id(2) + "));\n" + id(2) +
         "=IFCSHAPEREPRESENTATION(#12,'Body','" + type + "',(" + items + "));\n";
}

inline Result<ImportedModel> tryImport(const std::string& text, const ImportOptions& options = {}) {
  const TemporaryFile file(text);
  Progress progress;
  return importFile(file.path(), options, progress);
}

inline ImportedModel importText(const std::string& text, const ImportOptions& options = {}) {
  auto model = tryImport(text, options);
  EXPECT_TRUE(model.has_value()) << describe(model.error());
  return model ? std::move(*model) : ImportedModel();
}

inline std::size_t indexOf(const ImportedModel& model, const std::string& id) {
  const auto& products = model.environment.products;
  for (std::size_t i = 0; i < products.size(); ++i)
    if (products[i].id == id) return i;
  ADD_FAILURE() << "there is no product " << id;
  return 0;
}

inline const Product& productOf(const ImportedModel& model, const std::string& id) {
  return model.environment.products.at(indexOf(model, id));
}

// In the file's frame.
inline Bounds boundsOf(const ImportedModel& model, const std::string& id) {
  Bounds b = productBounds(model.environment).at(indexOf(model, id));
  b.min += model.georeference.shift_m;
  b.max += model.georeference.shift_m;
  return b;
}

inline double volumeOf(const ImportedModel& model, const std::string& id) {
  double sum = 0;
  const std::size_t product = indexOf(model, id);
  for (const Instance& i : model.environment.instances)
    if (i.product == product)
      sum += volume(*model.environment.meshes[i.mesh]) * i.world_from_mesh.linear().determinant();
  return sum;
}

inline double areaOf(const ImportedModel& model, const std::string& id) {
  double sum = 0;
  const std::size_t product = indexOf(model, id);
  for (const Instance& i : model.environment.instances) {
    if (i.product != product) continue;
    const Mesh& mesh = *model.environment.meshes[i.mesh];
    for (const Triangle& t : mesh.triangles)
      sum +=
          (mesh.positions[t[1]] - mesh.positions[t[0]]).cross(mesh.positions[t[2]] - mesh.positions[t[0]]).norm() / 2;
  }
  return sum;
}

inline std::string issuesOf(const ImportedModel& model) {
  std::string text;
  for (const Issue& i : model.report.issues)
    text += std::string(name(i.severity)) + " " + i.source + ": " + i.message + "\n";
  return text;
}

inline bool tells(const ImportedModel& model, const std::string& source, const std::string& words) {
  for (const Issue& i : model.report.issues)
    if (i.source == source && i.message.find(words) != std::string::npos) return true;
  return false;
}

inline void expectNear(const Eigen::Vector3d& a, const Eigen::Vector3d& b, double tolerance = 1e-5) {
  EXPECT_LE((a - b).norm(), tolerance) << a.transpose() << " against " << b.transpose();
}

}  // namespace standpoint::test

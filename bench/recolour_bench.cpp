// SPDX-License-Identifier: GPL-3.0-or-later
// What the author waits for when a million faces take other colours: in the editor's own scene view, drawn by the
// machine's OpenGL without a display (EGL); with a software rasteriser the drawing itself is most of it, so it is told
// apart.
#include <algorithm>
#include <chrono>
#include <cmath>
#include <cstdio>
#include <string>

#include "editor/viewport/merged_scene.h"
#include "editor/viewport/offscreen.h"
#include "editor/viewport/vtk_scene_view.h"
#include "project/materials/materials_verb.h"
#include "project/model/model_verbs.h"

using namespace standpoint;

namespace {

constexpr int kProducts = 10000, kSide = 7;  // of a curved sheet: 2 · 7² triangles and two more
constexpr const char* kNames[] = {"Beton",          "Ziegel rot", "Glas",    "Eiche",
                                  "Stahl verzinkt", "Gipskarton", "Teppich", "Fliesen weiss"};

double milliseconds(const auto& work) {
  const auto from = std::chrono::steady_clock::now();
  work();
  return std::chrono::duration<double, std::milli>(std::chrono::steady_clock::now() - from).count();
}

std::shared_ptr<const Mesh> sheet(std::uint32_t surface) {
  auto mesh = std::make_shared<Mesh>();
  for (int y = 0; y <= kSide; ++y)
    for (int x = 0; x <= kSide; ++x)
      mesh->positions.emplace_back(0.12F * x, 0.12F * y, 0.1F * std::sin(0.9F * x) * std::cos(0.7F * y));
  const auto at = [](int x, int y) { return static_cast<std::uint32_t>(y * (kSide + 1) + x); };
  for (int y = 0; y < kSide; ++y)
    for (int x = 0; x < kSide; ++x) {
      mesh->triangles.push_back({at(x, y), at(x + 1, y), at(x + 1, y + 1)});
      mesh->triangles.push_back({at(x, y), at(x + 1, y + 1), at(x, y + 1)});
    }
  mesh->triangles.push_back({at(0, 0), at(kSide, 0), at(kSide, kSide)});
  mesh->triangles.push_back({at(0, 0), at(kSide, kSide), at(0, kSide)});
  mesh->surface_of_triangle.assign(mesh->triangles.size(), surface);
  return mesh;
}

Document field() {
  auto e = std::make_shared<Environment>();
  for (const char* name : kNames)
    e->surfaces.push_back({name, {0.6F, 0.6F, 0.6F, std::string(name) == "Glas" ? 0.4F : 1.0F}, {}});
  for (std::uint32_t p = 0; p < kProducts; ++p) {
    e->meshes.push_back(sheet(p % std::size(kNames)));
    Product product;
    product.id = "#" + std::to_string(p + 1);
    product.ifc_class = p % 3 == 0 ? "IfcSlab" : "IfcCovering";
    e->products.push_back(std::move(product));
    e->instances.push_back({p, p, Eigen::Affine3d(Eigen::Translation3d(p % 100, static_cast<double>(p / 100), 0))});
  }
  Document d;
  d.imported = e;
  d.georeference = std::make_shared<const Georeference>();
  d.import_report = std::make_shared<const Report>();
  d.job = std::make_shared<const Job>();
  return d;
}

Document assigned(const Document& document, std::vector<MaterialOverride> overrides) {
  Progress progress;
  MaterialRequest request;
  request.assign = std::move(overrides);
  return assignDocumentMaterials(document, request, progress)->document;
}

}  // namespace

int main() {
  const auto document = field();
  std::printf("%zu triangles of %d products\n", triangleCount(*document.imported), kProducts);
  Document before = assigned(document, {}), after, face;
  std::printf("the verb, one product     %6.0f ms\n", milliseconds([&] {
                after = assigned(before, {{"#5050", "carpet"}});
              }));
  std::printf("the verb, one face        %6.0f ms\n", milliseconds([&] {
                face = assigned(before, {{"#5050@0,0,1@49.4,50.4,0.05", "carpet"}});
              }));
  auto offscreen = Offscreen::create(1280, 800, 1);
  if (!offscreen) return std::printf("no OpenGL without a display: %s\n", describe(offscreen.error()).c_str()), 1;
  const auto view = makeVtkSceneView();
  ViewState state;
  state.environment = document.imported;
  state.materials = before.materials;
  state.edges = false;
  frame(state.camera, bounds(*document.imported), 1.6);
  // The least of seven pictures: others work on the machine too.
  const auto drawn = [&](const auto& change) {
    double least = 1e9;
    for (int i = 0; i < 7; ++i) {
      change(i);
      least = std::min(least, milliseconds([&] { view->texture(state, 1280, 800, false); }));
    }
    return least;
  };
  const double still = drawn([&](int) { state.camera.distance_m *= 1.001; });
  std::printf("a moved camera            %6.0f ms: the drawing alone\n", still);
  const auto more = [&](const char* what, const auto& change) {
    std::printf("%s %6.0f ms more\n", what, drawn(change) - still);
  };
  state.colour = ColourMode::material;
  more("confidence and expected  ",
       [&](int i) { state.colour = i % 2 == 0 ? ColourMode::confidence : ColourMode::expected_noise; });
  more("model and material       ",
       [&](int i) { state.colour = i % 2 == 0 ? ColourMode::model : ColourMode::material; });
  state.colour = ColourMode::material;
  more("a stroke on a product    ", [&](int i) { state.materials = i % 2 == 0 ? after.materials : before.materials; });
  more("a stroke on a face       ", [&](int i) { state.materials = i % 2 == 0 ? face.materials : before.materials; });
  more("all triangles anew       ", [&](int) { state.hidden = std::make_shared<const HiddenProducts>(); });
  std::printf("its colours alone         %6.0f ms\n", milliseconds([&] { mergeColours(state); }));
  std::printf("its triangles and colours %6.0f ms\n", milliseconds([&] { mergeVisible(state); }));
  return 0;
}

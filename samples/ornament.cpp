// SPDX-License-Identifier: GPL-3.0-or-later
#include <algorithm>
#include <cmath>
#include <cstring>
#include <numbers>

#include <nlohmann/json.hpp>

#include "samples/models.h"

namespace standpoint::samples {

namespace {

using Json = nlohmann::ordered_json;

constexpr int kRings = 500, kSectors = 502;  // 2 · 502 · 499 = 500 996 triangles
constexpr double kRadius_m = 0.3, kHeight_m = 1.35;

// A carved finial: r³ = R³ (1 + f) where f has no mean around the axis, so that the volume is that of the sphere
// whatever the carving: V = ∫ r³/3 dΩ = 4π R³ / 3. That is the number a reader is tested with.
double radius(double polar, double around) {
  const double s = std::sin(polar), c = std::cos(polar);
  const double leaves = 0.30 * std::pow(s, 4) * std::cos(12 * around + 6 * c);
  const double veins = 0.10 * std::pow(s, 8) * std::cos(48 * around - 18 * c);
  const double beads = 0.06 * std::pow(s, 16) * std::cos(96 * around) * std::cos(40 * c);
  return kRadius_m * std::cbrt(1 + leaves + veins + beads);
}

class Glb {
 public:
  Glb() {
    json_["asset"] = {{"version", "2.0"}, {"generator", "Standpoint samples"}};
    json_["scene"] = 0;
    json_["scenes"] = Json::array({Json{{"nodes", Json::array({0, 1})}}});
  }

  // `vertices` in metres, Y up.
  void add(const std::string& name, const std::vector<std::array<float, 3>>& vertices,
           const std::vector<std::uint32_t>& indices, const Paint& paint, double roughness) {
    const std::size_t number = json_["nodes"].size();
    const auto linear = [](double c) { return c <= 0.04045 ? c / 12.92 : std::pow((c + 0.055) / 1.055, 2.4); };
    auto low = vertices[0], high = vertices[0];
    for (const auto& v : vertices)
      for (std::size_t k = 0; k < 3; ++k) low[k] = std::min(low[k], v[k]), high[k] = std::max(high[k], v[k]);
    view(vertices.data(), vertices.size() * 12, 34962);
    view(indices.data(), indices.size() * 4, 34963);
    json_["accessors"].push_back({{"bufferView", 2 * number},
                                  {"componentType", 5126},
                                  {"type", "VEC3"},
                                  {"count", vertices.size()},
                                  {"min", low},
                                  {"max", high}});
    json_["accessors"].push_back(
        {{"bufferView", 2 * number + 1}, {"componentType", 5125}, {"type", "SCALAR"}, {"count", indices.size()}});
    const Json primitive = {
        {"attributes", {{"POSITION", 2 * number}}}, {"indices", 2 * number + 1}, {"material", number}};
    json_["meshes"].push_back({{"name", name}, {"primitives", Json::array({primitive})}});
    json_["materials"].push_back(
        {{"name", paint.name},
         {"pbrMetallicRoughness",
          {{"baseColorFactor", {linear(paint.rgb[0]), linear(paint.rgb[1]), linear(paint.rgb[2]), 1.0}},
           {"metallicFactor", 0.0},
           {"roughnessFactor", roughness}}}});
    json_["nodes"].push_back({{"name", name}, {"mesh", number}});
  }

  std::string bytes() {
    json_["buffers"] = Json::array({Json{{"byteLength", binary_.size()}}});
    std::string text = json_.dump();
    text.resize((text.size() + 3) / 4 * 4, ' ');
    std::string out = "glTF";
    word(out, 2), word(out, 28 + text.size() + binary_.size()), word(out, text.size());
    out += "JSON" + text;
    word(out, binary_.size());
    return out.append("BIN\0", 4) + binary_;
  }

 private:
  static void word(std::string& out, std::size_t value) {
    for (unsigned shift = 0; shift < 32; shift += 8) out += static_cast<char>(value >> shift & 0xFFU);
  }
  void view(const void* data, std::size_t size, int target) {
    json_["bufferViews"].push_back(
        {{"buffer", 0}, {"byteOffset", binary_.size()}, {"byteLength", size}, {"target", target}});
    binary_.append(static_cast<const char*>(data), size);
  }

  Json json_;
  std::string binary_;
};

void addFinial(Glb& glb) {
  std::vector<std::array<float, 3>> vertices;
  std::vector<std::uint32_t> indices;
  const auto vertex = [&](double polar, double around) {
    const double r = radius(polar, around);
    vertices.push_back({static_cast<float>(r * std::sin(polar) * std::cos(around)),
                        static_cast<float>(kHeight_m + r * std::cos(polar)),
                        static_cast<float>(-r * std::sin(polar) * std::sin(around))});
  };
  vertex(0, 0);
  for (int r = 1; r < kRings; ++r)
    for (int s = 0; s < kSectors; ++s) vertex(std::numbers::pi * r / kRings, 2 * std::numbers::pi * s / kSectors);
  vertex(std::numbers::pi, 0);
  const auto ring = [](int r, int s) { return static_cast<std::uint32_t>(1 + (r - 1) * kSectors + s % kSectors); };
  const auto last = static_cast<std::uint32_t>(vertices.size() - 1);
  const auto triangle = [&](std::uint32_t a, std::uint32_t b, std::uint32_t c) {
    indices.insert(indices.end(), {a, b, c});
  };
  for (int s = 0; s < kSectors; ++s) {
    triangle(0, ring(1, s), ring(1, s + 1));
    for (int r = 1; r < kRings - 1; ++r) {
      triangle(ring(r, s), ring(r + 1, s), ring(r + 1, s + 1));
      triangle(ring(r, s), ring(r + 1, s + 1), ring(r, s + 1));
    }
    triangle(last, ring(kRings - 1, s + 1), ring(kRings - 1, s));
  }
  glb.add("Finial", vertices, indices, {"Limestone", {0.85, 0.81, 0.72}}, 0.9);
}

// Three blocks, the widest below; each box has its own twenty-four corners, so that other viewers show sharp edges.
void addPlinth(Glb& glb) {
  std::vector<std::array<float, 3>> vertices;
  std::vector<std::uint32_t> indices;
  const auto box = [&](double half, double low, double high) {
    constexpr int kFaces[6][4] = {{0, 1, 3, 2}, {4, 6, 7, 5}, {0, 4, 5, 1}, {2, 3, 7, 6}, {0, 2, 6, 4}, {1, 5, 7, 3}};
    for (const auto& face : kFaces) {
      const auto first = static_cast<std::uint32_t>(vertices.size());
      for (const int k : face)
        vertices.push_back({static_cast<float>((k & 4) != 0 ? half : -half),
                            static_cast<float>((k & 2) != 0 ? high : low),
                            static_cast<float>((k & 1) != 0 ? half : -half)});
      for (const std::uint32_t k : {0U, 1U, 2U, 0U, 2U, 3U}) indices.push_back(first + k);
    }
  };
  box(0.4, 0, 0.15);
  box(0.3, 0.15, 0.95);
  box(0.375, 0.95, 1.07);
  glb.add("Plinth", vertices, indices, {"Granite", {0.30, 0.30, 0.32}}, 0.6);
}

}  // namespace

std::string ornamentGlb() {
  Glb glb;
  addFinial(glb);
  addPlinth(glb);
  return glb.bytes();
}

}  // namespace standpoint::samples

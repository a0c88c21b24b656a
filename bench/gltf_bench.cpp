// SPDX-License-Identifier: GPL-3.0-or-later
// How long a GLB of 350 MB takes to become an environment, beside what only reads the file and what other programs use:
// assimp and tinygltf. The file is made of six terrains of a million vertices, as a foreign program writes them: with
// normals and texture coordinates, indices of 32 bits.
#include <cmath>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <string>
#include <vector>

#include <assimp/Importer.hpp>
#include <assimp/scene.h>
#include <benchmark/benchmark.h>

#define TINYGLTF_IMPLEMENTATION
#define TINYGLTF_NO_STB_IMAGE
#define TINYGLTF_NO_STB_IMAGE_WRITE
#define TINYGLTF_NO_INCLUDE_STB_IMAGE
#define TINYGLTF_NO_INCLUDE_STB_IMAGE_WRITE
#include <tiny_gltf.h>

#include "importers/importers.h"

namespace standpoint {
namespace {

constexpr std::uint32_t kSide = 1000, kMeshes = 6;

template <class T>
void append(std::string& bytes, const std::vector<T>& values) {
  bytes.append(reinterpret_cast<const char*>(values.data()), values.size() * sizeof(T));
}

std::string terrain() {
  std::vector<float> positions, normals, coordinates;
  std::vector<std::uint32_t> indices;
  for (std::uint32_t y = 0; y < kSide; ++y)
    for (std::uint32_t x = 0; x < kSide; ++x) {
      const float u = static_cast<float>(x) / kSide, v = static_cast<float>(y) / kSide;
      positions.insert(positions.end(), {100 * u, std::sin(40 * u) * std::cos(30 * v), 100 * v});
      normals.insert(normals.end(), {0, 1, 0});
      coordinates.insert(coordinates.end(), {u, v});
      const std::uint32_t a = y * kSide + x;
      if (x + 1 < kSide && y + 1 < kSide)
        indices.insert(indices.end(), {a, a + kSide, a + 1, a + 1, a + kSide, a + kSide + 1});
    }
  std::string bytes;
  append(bytes, positions);
  append(bytes, normals);
  append(bytes, coordinates);
  append(bytes, indices);
  return bytes;
}

std::string viewsAndAccessors(std::size_t vertices, std::size_t indices) {
  const std::size_t sizes[] = {vertices * 12, vertices * 12, vertices * 8, indices * 4};
  std::string views, accessors;
  std::size_t offset = 0;
  for (std::uint32_t i = 0; i < 4 * kMeshes; ++i) {
    const std::string comma = i == 0 ? "" : ",";
    views += comma + "{\"buffer\":0,\"byteOffset\":" + std::to_string(offset) +
             ",\"byteLength\":" + std::to_string(sizes[i % 4]) + "}";
    accessors +=
        comma + "{\"bufferView\":" + std::to_string(i) +
        ",\"count\":" + std::to_string(i % 4 == 3 ? indices : vertices) +
        (i % 4 == 3 ? ",\"componentType\":5125,\"type\":\"SCALAR\"" : ",\"componentType\":5126,\"type\":\"VEC") +
        (i % 4 == 3   ? ""
         : i % 4 == 2 ? "2\""
                      : "3\"") +
        (i % 4 == 0 ? ",\"min\":[0,-1,0],\"max\":[100,1,100]}" : "}");
    offset += sizes[i % 4];
  }
  return "\"bufferViews\":[" + views + "],\"accessors\":[" + accessors +
         "],\"buffers\":[{\"byteLength\":" + std::to_string(offset) + "}]";
}

const std::filesystem::path& bigGlb() {
  static const auto kFile = [] {
    const auto file = std::filesystem::temp_directory_path() / "standpoint-bench.glb";
    const std::string one = terrain();
    const std::size_t vertices = std::size_t{kSide} * kSide, indices = std::size_t{kSide - 1} * (kSide - 1) * 6;
    std::string nodes, meshes;
    for (std::uint32_t i = 0; i < kMeshes; ++i) {
      const std::string comma = i == 0 ? "" : ",", a = std::to_string(4 * i);
      nodes += comma + "{\"mesh\":" + std::to_string(i) + ",\"translation\":[" + std::to_string(100 * i) + ",0,0]}";
      meshes += comma + "{\"primitives\":[{\"attributes\":{\"POSITION\":" + a +
                ",\"NORMAL\":" + std::to_string(4 * i + 1) + ",\"TEXCOORD_0\":" + std::to_string(4 * i + 2) +
                "},\"indices\":" + std::to_string(4 * i + 3) + "}]}";
    }
    std::string json =
        "{\"asset\":{\"version\":\"2.0\"},\"scene\":0,\"scenes\":[{\"nodes\":[0,1,2,3,4,5]}],\"nodes\":[" + nodes +
        "],\"meshes\":[" + meshes + "]," + viewsAndAccessors(vertices, indices) + "}";
    json.resize((json.size() + 3) / 4 * 4, ' ');
    std::ofstream out(file, std::ios::binary);
    const auto word = [&](std::size_t value) {
      const auto v = static_cast<std::uint32_t>(value);
      out.write(reinterpret_cast<const char*>(&v), 4);
    };
    const std::size_t binary = one.size() * kMeshes;
    out << "glTF";
    word(2), word(28 + json.size() + binary), word(json.size());
    out << "JSON" << json;
    word(binary);
    out << std::string("BIN\0", 4);
    for (std::uint32_t i = 0; i < kMeshes; ++i) out << one;
    return file;
  }();
  return kFile;
}

void rate(benchmark::State& state) {
  state.SetBytesProcessed(static_cast<std::int64_t>(state.iterations() * std::filesystem::file_size(bigGlb())));
}

void ours(benchmark::State& state) {
  const auto& file = bigGlb();
  for (auto _ : state) {
    Progress progress;
    const auto model = importFile(file, {}, progress);
    if (!model || triangleCount(model->environment) != std::size_t{kMeshes} * 2 * (kSide - 1) * (kSide - 1))
      return state.SkipWithError("import");
  }
  rate(state);
}
BENCHMARK(ours)->UseRealTime()->Unit(benchmark::kMillisecond)->MinTime(3);

// The floor: the bytes in memory and nothing else.
void onlyRead(benchmark::State& state) {
  const auto& file = bigGlb();
  for (auto _ : state) {
    const auto size = std::filesystem::file_size(file);
    const auto bytes = std::make_unique_for_overwrite<char[]>(size);
    std::ifstream(file, std::ios::binary).read(bytes.get(), static_cast<std::streamsize>(size));
    benchmark::DoNotOptimize(bytes.get());
  }
  rate(state);
}
BENCHMARK(onlyRead)->UseRealTime()->Unit(benchmark::kMillisecond)->MinTime(3);

// tinygltf hands out its buffers; whoever uses it still has to make positions and triangles of them.
void tinyGltf(benchmark::State& state) {
  const auto file = bigGlb().string();
  for (auto _ : state) {
    tinygltf::TinyGLTF loader;
    tinygltf::Model model;
    std::string error, warning;
    if (!loader.LoadBinaryFromFile(&model, &error, &warning, file)) return state.SkipWithError(error.c_str());
  }
  rate(state);
}
BENCHMARK(tinyGltf)->UseRealTime()->Unit(benchmark::kMillisecond)->MinTime(3);

void assimp(benchmark::State& state) {
  const auto file = bigGlb().string();
  for (auto _ : state) {
    Assimp::Importer importer;
    if (importer.ReadFile(file, 0) == nullptr) return state.SkipWithError(importer.GetErrorString());
  }
  rate(state);
}
BENCHMARK(assimp)->UseRealTime()->Unit(benchmark::kMillisecond)->MinTime(3);

}  // namespace
}  // namespace standpoint

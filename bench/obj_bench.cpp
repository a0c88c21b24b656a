// SPDX-License-Identifier: GPL-3.0-or-later
// The whole import of a large OBJ into an Environment beside what tinyobjloader needs to read it, without triangulation
// and with. What counts is the ratio within one run; absolute rates differ threefold between machines.
// bench/make_big_obj.py FOLDER, then STANDPOINT_BIG_OBJ=FOLDER/big.obj build/release/bin/bench_obj
#include <cstdlib>
#include <filesystem>
#include <string>

#include <benchmark/benchmark.h>
#include <tbb/global_control.h>

#define TINYOBJLOADER_IMPLEMENTATION
#include <tiny_obj_loader.h>

#include "importers/importers.h"

namespace standpoint {
namespace {

std::string bigFile(benchmark::State& state) {
  const char* file = std::getenv("STANDPOINT_BIG_OBJ");
  if (file == nullptr || !std::filesystem::exists(file))
    state.SkipWithError("set STANDPOINT_BIG_OBJ to a file of bench/make_big_obj.py");
  return file == nullptr ? "" : file;
}

void countBytes(benchmark::State& state, const std::string& file) {
  std::error_code code;
  state.SetBytesProcessed(static_cast<std::int64_t>(state.iterations()) *
                          static_cast<std::int64_t>(std::filesystem::file_size(file, code)));
}

void standpointImport(benchmark::State& state) {
  const auto file = bigFile(state);
  const tbb::global_control threads(tbb::global_control::max_allowed_parallelism,
                                    static_cast<std::size_t>(state.range(0)));
  for (auto _ : state) {
    Progress progress;
    const auto model = importFile(file, {}, progress);
    if (!model) return state.SkipWithError(model.error().message.c_str());
    benchmark::DoNotOptimize(model->environment.meshes.data());
    state.counters["triangles"] = static_cast<double>(triangleCount(model->environment));
  }
  countBytes(state, file);
}
BENCHMARK(standpointImport)->Arg(1)->Arg(2)->UseRealTime()->Unit(benchmark::kMillisecond)->Iterations(3);

void tinyobjloader(benchmark::State& state) {
  const auto file = bigFile(state);
  const auto folder = std::filesystem::path(file).parent_path().string() + "/";
  for (auto _ : state) {
    tinyobj::attrib_t attributes;
    std::vector<tinyobj::shape_t> shapes;
    std::vector<tinyobj::material_t> materials;
    std::string warnings, errors;
    if (!tinyobj::LoadObj(&attributes, &shapes, &materials, &warnings, &errors, file.c_str(), folder.c_str(),
                          state.range(0) != 0))
      return state.SkipWithError(errors.c_str());
    benchmark::DoNotOptimize(attributes.vertices.data());
  }
  countBytes(state, file);
}
BENCHMARK(tinyobjloader)
    ->ArgName("triangulate")
    ->Arg(0)
    ->Arg(1)
    ->UseRealTime()
    ->Unit(benchmark::kMillisecond)
    ->Iterations(3);

}  // namespace
}  // namespace standpoint

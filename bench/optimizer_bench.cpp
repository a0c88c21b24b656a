// SPDX-License-Identifier: GPL-3.0-or-later
// Our simplification with each of its engines, and CGAL's Lindstrom–Turk and meshoptimizer by themselves, on the same
// meshes, in one run: seconds, their ratio to ours, the error by a tree that is not ours and its ratio, peak memory.
// What counts are the ratios; rates differ threefold between machines. `%` instead of a budget is of the triangles.
//   build/release/bin/bench_optimizer [--only NAME] [PROJECT[:BUDGET[%]] | MESH.obj[:BUDGET[%]] …]
// Each step runs in a process of its own, so that its memory is its own. Ours is optimize() as a whole, measuring
// included.
#include <algorithm>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <functional>
#include <string>
#include <sys/wait.h>
#include <unistd.h>
#include <vector>

#include <tbb/global_control.h>

#include "bench/optimizer_meshes.h"
#include "bench/optimizer_peers.h"
#include "importers/importers.h"
#include "optimizer/optimizer.h"
#include "project/storage/project_files.h"

namespace standpoint::bench {
namespace {

struct Case {
  std::string name;
  std::function<Environment()> make;
  std::size_t budget = 30'000;
  double percent = 0;          // of the triangles, instead of a budget
  bool lindstrom_turk = true;  // it needs a mesh, and hours for the large soup
};

Environment only(Mesh mesh) {
  Environment environment;
  environment.surfaces.resize(1);
  environment.products.resize(1);
  environment.instances.push_back({});
  environment.meshes.push_back(std::make_shared<const Mesh>(std::move(mesh)));
  return environment;
}

// All placed triangles as one mesh, equal positions welded: what a simplifier of meshes is given.
Mesh flattened(const Environment& environment) {
  Mesh soup;
  for (const auto& instance : environment.instances) {
    const Mesh& mesh = *environment.meshes[instance.mesh];
    const auto first = static_cast<std::uint32_t>(soup.positions.size());
    for (const auto& p : mesh.positions)
      soup.positions.emplace_back((instance.world_from_mesh * p.cast<double>()).cast<float>());
    for (const auto& t : mesh.triangles) soup.triangles.push_back({first + t[0], first + t[1], first + t[2]});
  }
  std::vector<std::uint32_t> order(soup.positions.size()), index(soup.positions.size());
  for (std::uint32_t i = 0; i < order.size(); ++i) order[i] = i;
  const auto& p = soup.positions;
  const auto less = [&](std::uint32_t a, std::uint32_t b) {
    return std::lexicographical_compare(p[a].begin(), p[a].end(), p[b].begin(), p[b].end());
  };
  std::sort(order.begin(), order.end(), less);
  std::vector<Eigen::Vector3f> welded;
  for (std::size_t i = 0; i < order.size(); ++i) {
    if (i == 0 || less(order[i - 1], order[i])) welded.push_back(p[order[i]]);
    index[order[i]] = static_cast<std::uint32_t>(welded.size() - 1);
  }
  for (auto& t : soup.triangles)
    for (auto& v : t) v = index[v];
  std::erase_if(soup.triangles, [](const Triangle& t) { return t[0] == t[1] || t[1] == t[2] || t[2] == t[0]; });
  soup.positions = std::move(welded);
  soup.surface_of_triangle.assign(soup.triangles.size(), 0);
  return soup;
}

// Highest memory since the last reset, in MB; what the mesh itself takes is in it.
double peakMegabytes(bool reset) {
  if (reset) std::ofstream("/proc/self/clear_refs") << "5";
  std::ifstream status("/proc/self/status");
  for (std::string line; std::getline(status, line);)
    if (line.starts_with("VmHWM:")) return std::atof(line.c_str() + 6) / 1024;
  return 0;
}

struct Figures {
  double seconds = 0, cpu_seconds = 0, megabytes = 0;
  std::size_t triangles = 0;
  ErrorPercent error;
};

void write(std::FILE* file, const Mesh& mesh, const Figures& figures) {
  const std::uint64_t sizes[2] = {mesh.positions.size(), mesh.triangles.size()};
  std::fwrite(&figures, sizeof figures, 1, file);
  std::fwrite(sizes, sizeof sizes, 1, file);
  std::fwrite(mesh.positions.data(), sizeof mesh.positions[0], sizes[0], file);
  std::fwrite(mesh.triangles.data(), sizeof mesh.triangles[0], sizes[1], file);
  std::fflush(file);
}

bool read(std::FILE* file, Mesh& mesh, Figures& figures) {
  std::uint64_t sizes[2] = {0, 0};
  std::rewind(file);
  if (std::fread(&figures, sizeof figures, 1, file) != 1 || std::fread(sizes, sizeof sizes, 1, file) != 1) return false;
  mesh.positions.resize(sizes[0]);
  mesh.triangles.resize(sizes[1]);
  return std::fread(mesh.positions.data(), sizeof mesh.positions[0], sizes[0], file) == sizes[0] &&
         std::fread(mesh.triangles.data(), sizeof mesh.triangles[0], sizes[1], file) == sizes[1];
}

bool inChild(const std::function<void()>& task) {
  std::fflush(stdout);
  const pid_t child = fork();
  if (child == 0) {
    task();
    _exit(0);
  }
  int status = 0;
  waitpid(child, &status, 0);
  return WIFEXITED(status) && WEXITSTATUS(status) == 0;
}

Figures run(const Case& c, const std::function<Simplified(const Environment&)>& simplify) {
  std::FILE* file = std::tmpfile();
  Figures figures;
  Mesh result;
  const bool made = inChild([&] {
    const Environment environment = c.make();
    peakMegabytes(true);
    const auto simplified = simplify(environment);
    write(file, simplified.mesh,
          {simplified.seconds, simplified.cpu_seconds, peakMegabytes(false), simplified.mesh.triangles.size(), {}});
  });
  if (made && read(file, result, figures))
    inChild([&] {
      figures.error = errorBetween(flattened(c.make()), result);
      std::rewind(file);
      write(file, {}, figures);
    });
  read(file, result, figures);
  std::fclose(file);
  return figures;
}

Simplified ours(const Environment& environment, std::size_t budget, std::size_t threads, const char* engine) {
  const tbb::global_control limit(tbb::global_control::max_allowed_parallelism, threads);
  Progress progress;
  const Stopwatch watch;
  OptimizeOptions options;
  options.budget = budget;
  options.max_deviation_m = 1e6;
  options.engine = engine;
  const auto result = optimize(environment, options, progress);
  auto simplified = watch.stop({});
  if (!result) return {};
  for (const auto& issue : result->report.issues)
    if (issue.source == "engine") std::printf("    (%s)\n", issue.message.c_str());
  std::printf("    (states a mean of %.3f mm and a maximum of %.2f mm)\n", 1000 * result->all.mean_deviation_m,
              1000 * result->all.max_deviation_m);
  std::fflush(stdout);
  simplified.mesh = flattened(result->environment);
  return simplified;
}

void print(const char* who, const Figures& f, const Figures& ours) {
  std::printf(
      "  %-22s %9zu triangles %7.2f s (x%6.2f) %7.2f s of CPU (x%6.2f)  mean %.4f %% (x%5.3f)  max %.4f %% (x%5.3f)  "
      "%6.0f MB\n",
      who, f.triangles, f.seconds, f.seconds / ours.seconds, f.cpu_seconds, f.cpu_seconds / ours.cpu_seconds,
      f.error.mean, f.error.mean / ours.error.mean, f.error.max, f.error.max / ours.error.max, f.megabytes);
  std::fflush(stdout);
}

void compare(Case c) {
  if (c.percent > 0)
    c.budget = static_cast<std::size_t>(c.percent / 100 * static_cast<double>(triangleCount(c.make())));
  std::printf("%s -> %zu\n", c.name.c_str(), c.budget);
  const auto by = [&](const char* engine, std::size_t threads) {
    return run(c, [&](const Environment& e) { return ours(e, c.budget, threads, engine); });
  };
  const auto two = by("own", 2);
  print("own, two threads", two, two);
  print("own, one thread", by("own", 1), two);
  for (const char* engine : engineIds())
    if (std::strcmp(engine, "own") != 0) print(engine, by(engine, 2), two);
  print("meshoptimizer alone", run(c, [&](const Environment& e) { return meshoptimizer(flattened(e), c.budget); }),
        two);
  if (c.lindstrom_turk)
    print("CGAL alone", run(c, [&](const Environment& e) { return lindstromTurk(flattened(e), c.budget); }), two);
}

Case caseOf(const std::string& argument) {
  const auto colon = argument.rfind(':');
  const std::filesystem::path path = argument.substr(0, colon);
  Case c{path.filename().string(), {}};
  if (colon != std::string::npos) {
    const std::string budget = argument.substr(colon + 1);
    if (budget.ends_with('%'))
      c.percent = std::strtod(budget.c_str(), nullptr);
    else
      c.budget = std::strtoull(budget.c_str(), nullptr, 10);
  }
  c.lindstrom_turk = path.extension() == ".obj";
  c.make = [path] {
    Progress progress;
    if (path.extension() != ".obj") {
      auto document = loadProject(path, progress);
      return document ? *document->imported : Environment{};
    }
    auto model = importFile(path, {}, progress);
    return model ? std::move(model->environment) : Environment{};
  };
  return c;
}

int main(int count, char** arguments) {
  std::vector<Case> cases;
  std::string only_one;
  for (int i = 1; i < count; ++i) {
    if (std::strcmp(arguments[i], "--only") == 0 && i + 1 < count)
      only_one = arguments[++i];
    else
      cases.push_back(caseOf(arguments[i]));
  }
  cases.push_back({"scan", [] { return only(scanLike()); }});
  cases.push_back({"facade", [] { return only(facade()); }});
  cases.push_back({"restaurant", restaurant, 30'000, 0, false});
  for (const auto& c : cases)
    if (only_one.empty() || c.name == only_one) compare(c);
  return 0;
}

}  // namespace
}  // namespace standpoint::bench

int main(int count, char** arguments) { return standpoint::bench::main(count, arguments); }

// SPDX-License-Identifier: GPL-3.0-or-later
#include "optimizer/walk/walkable.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <functional>
#include <iterator>
#include <limits>
#include <map>
#include <memory>
#include <tuple>

#include <recastnavigation/Recast.h>

namespace standpoint {

namespace {

constexpr double kMostColumns = 4e6;
constexpr double kMostLevels = 8000;   // Recast keeps heights in 13 bits
constexpr double kLeastOver = 1e-3;    // m, what rounding adds to a step of just the height that is climbed …
constexpr double kLeastSteeper = 0.1;  // degrees, … and to a slope that is just not too steep, as many roofs are

using Heightfield = std::unique_ptr<rcHeightfield, decltype(&rcFreeHeightField)>;
using CompactHeightfield = std::unique_ptr<rcCompactHeightfield, decltype(&rcFreeCompactHeightfield)>;

// Recast is Y-up: (x, y, z) here is (x, z, -y) there.
struct Grid {
  float low[3], high[3];
  float cell = 0, level = 0;
  int width = 0, depth = 0;
};

// Shapes so far from all others that nobody gets from one to the other, and that nothing of them is in the way there.
struct Cluster {
  std::vector<std::uint32_t> shapes;
  Bounds box;
};

std::vector<Cluster> clustersOf(const std::vector<CollisionShape>& shapes, const CollideOptions& options) {
  const Eigen::Vector3d reach(2 * options.agent_radius_m + 0.5, 2 * options.agent_radius_m + 0.5,
                              options.agent_height_m + kStepHeight);
  std::vector<Cluster> done, open;  // by their lower end in x
  std::vector<std::pair<double, std::uint32_t>> order;
  std::vector<Bounds> boxes(shapes.size());
  for (std::uint32_t i = 0; i < shapes.size(); ++i) {
    for (const auto& p : shapes[i].mesh.positions) boxes[i].extend(p.cast<double>());
    if (!boxes[i].empty()) order.emplace_back(boxes[i].min.x(), i);
  }
  std::sort(order.begin(), order.end());
  const auto meet = [&](const Bounds& a, const Bounds& b) {
    return ((a.min - b.max).array() <= reach.array()).all() && ((b.min - a.max).array() <= reach.array()).all();
  };
  for (const auto& [x, i] : order) {
    Cluster grown{{i}, boxes[i]};
    for (bool more = true; more;) {  // a box that grew may meet others
      more = false;
      for (std::size_t k = 0; k < open.size();) {
        if (!meet(open[k].box, grown.box)) {
          ++k;
          continue;
        }
        grown.shapes.insert(grown.shapes.end(), open[k].shapes.begin(), open[k].shapes.end());
        grown.box.extend(open[k].box.min), grown.box.extend(open[k].box.max);
        open.erase(open.begin() + static_cast<std::ptrdiff_t>(k));
        more = true;
      }
    }
    open.push_back(std::move(grown));
    const auto past = std::partition(open.begin(), open.end(),
                                     [&, at = x](const Cluster& c) { return c.box.max.x() + reach.x() >= at; });
    std::move(past, open.end(), std::back_inserter(done));
    open.erase(past, open.end());
  }
  std::move(open.begin(), open.end(), std::back_inserter(done));
  for (auto& cluster : done) std::sort(cluster.shapes.begin(), cluster.shapes.end());
  std::sort(done.begin(), done.end(), [](const Cluster& a, const Cluster& b) { return a.shapes < b.shapes; });
  return done;
}

// So that all grids together have no more columns than are affordable.
double cellFor(const std::vector<Cluster>& clusters, const CollideOptions& options) {
  double area = 0;
  for (const auto& cluster : clusters)
    area += (cluster.box.max.x() - cluster.box.min.x() + 0.5) * (cluster.box.max.y() - cluster.box.min.y() + 0.5);
  return std::max(options.agent_radius_m / 10, std::sqrt(area / kMostColumns));
}

Grid gridOver(const Bounds& box, double cell, const CollideOptions& options) {
  Grid grid;
  const double height = box.max.z() - box.min.z() + 0.5;
  // A step is a whole number of levels, so that it does not matter where between two levels it begins.
  const double finest = std::max(cell / 2, (height + options.agent_height_m) / kMostLevels),
               step = kStepHeight + kLeastOver;
  const double level = finest < step ? step / std::floor(step / finest) : finest;
  grid.cell = static_cast<float>(cell);
  grid.level = static_cast<float>(level);
  const Eigen::Vector3d low(box.min.x(), box.min.z(), -box.max.y()), high(box.max.x(), box.max.z(), -box.min.y());
  for (int k = 0; k < 3; ++k) {
    grid.low[k] = static_cast<float>(low[k] - 0.2);
    grid.high[k] = static_cast<float>(high[k] + 0.2 + (k == 1 ? options.agent_height_m : 0));
  }
  rcCalcGridSize(grid.low, grid.high, grid.cell, &grid.width, &grid.depth);
  return grid;
}

struct Soup {
  std::vector<float> corners;
  std::vector<int> triangles;
  std::vector<unsigned char> areas;
};

Soup soupOf(const Mesh& mesh, bool over, rcContext& context) {
  Soup soup;
  for (const auto& p : mesh.positions) soup.corners.insert(soup.corners.end(), {p.x(), p.z(), -p.y()});
  for (const auto& t : mesh.triangles)
    for (const auto v : t) soup.triangles.push_back(static_cast<int>(v));
  soup.areas.assign(mesh.triangles.size(), RC_NULL_AREA);
  if (over) return soup;
  rcMarkWalkableTriangles(&context, static_cast<float>(kSteepestSlopeDeg + kLeastSteeper), soup.corners.data(),
                          static_cast<int>(mesh.positions.size()), soup.triangles.data(),
                          static_cast<int>(mesh.triangles.size()), soup.areas.data());
  return soup;
}

bool addTriangles(const Soup& soup, rcHeightfield& field, int climb, rcContext& context, const Progress& progress) {
  constexpr std::size_t kAtOnce = 10'000;  // between looks at whether to go on
  for (std::size_t first = 0; first < soup.areas.size() && !progress.cancelled(); first += kAtOnce)
    if (!rcRasterizeTriangles(&context, soup.corners.data(), static_cast<int>(soup.corners.size() / 3),
                              soup.triangles.data() + 3 * first, soup.areas.data() + first,
                              static_cast<int>(std::min(kAtOnce, soup.areas.size() - first)), field, climb))
      return false;
  return true;
}

// Nobody stands inside of a wall: what is between the lowest and the highest voxel of a column is solid.
bool addSolid(const Soup& soup, rcHeightfield& field, const Grid& grid, int climb, rcContext& context,
              const Progress& progress) {
  int from[2] = {std::numeric_limits<int>::max(), std::numeric_limits<int>::max()}, to[2] = {0, 0};
  for (std::size_t i = 0; i < soup.corners.size(); i += 3)
    for (int k = 0; k < 2; ++k) {
      const int at =
          static_cast<int>((soup.corners[i + 2 * static_cast<std::size_t>(k)] - grid.low[2 * k]) / grid.cell);
      from[k] = std::min(from[k], at - 1);
      to[k] = std::max(to[k], at + 2);
    }
  const float low[3] = {grid.low[0] + static_cast<float>(from[0]) * grid.cell, grid.low[1],
                        grid.low[2] + static_cast<float>(from[1]) * grid.cell};
  const float high[3] = {grid.low[0] + static_cast<float>(to[0]) * grid.cell, grid.high[1],
                         grid.low[2] + static_cast<float>(to[1]) * grid.cell};
  const Heightfield own(rcAllocHeightfield(), rcFreeHeightField);
  if (!own || !rcCreateHeightfield(&context, *own, to[0] - from[0], to[1] - from[1], low, high, grid.cell, grid.level))
    return false;
  if (!addTriangles(soup, *own, climb, context, progress)) return false;
  for (int z = 0; z < own->height; ++z)
    for (int x = 0; x < own->width; ++x) {
      const rcSpan* span = own->spans[z * own->width + x];
      const int fx = x + from[0], fz = z + from[1];
      if (span == nullptr || fx < 0 || fz < 0 || fx >= field.width || fz >= field.height) continue;
      const auto bottom = static_cast<unsigned short>(span->smin);
      while (span->next != nullptr) span = span->next;
      if (!rcAddSpan(&context, field, fx, fz, bottom, static_cast<unsigned short>(span->smax),
                     static_cast<unsigned char>(span->area), climb))
        return false;
    }
  return true;
}

constexpr std::uint32_t kNoIsland = std::numeric_limits<std::uint32_t>::max();

// Numbers the islands on from `number`, by span. Those on which the agent has no room are cleared.
std::vector<std::uint32_t> findIslands(rcCompactHeightfield& field, double smallest_spans, std::uint32_t& number) {
  std::vector<std::uint32_t> result(static_cast<std::size_t>(field.spanCount), kNoIsland);
  std::vector<std::array<int, 3>> island;  // x, z, span
  for (int z = 0; z < field.height; ++z)
    for (int x = 0; x < field.width; ++x) {
      const auto& cell = field.cells[z * field.width + x];
      for (int i = static_cast<int>(cell.index); i < static_cast<int>(cell.index + cell.count); ++i) {
        if (result[i] != kNoIsland || field.areas[i] == RC_NULL_AREA) continue;
        island.assign(1, {x, z, i});
        result[i] = number;
        for (std::size_t at = 0; at < island.size(); ++at) {
          const auto [ix, iz, ii] = island[at];
          for (int direction = 0; direction < 4; ++direction) {
            const int layer = rcGetCon(field.spans[ii], direction);
            if (layer == RC_NOT_CONNECTED) continue;
            const int nx = ix + rcGetDirOffsetX(direction), nz = iz + rcGetDirOffsetY(direction);
            const int ni = static_cast<int>(field.cells[nz * field.width + nx].index) + layer;
            if (result[ni] != kNoIsland || field.areas[ni] == RC_NULL_AREA) continue;
            result[ni] = number;
            island.push_back({nx, nz, ni});
          }
        }
        ++number;
        if (static_cast<double>(island.size()) < smallest_spans)
          for (const auto& member : island) field.areas[member[2]] = RC_NULL_AREA;
      }
    }
  return result;
}

struct Rectangle {
  int x0 = 0, x1 = 0, z0 = 0, z1 = 0;
  int level = 0;
  std::uint32_t island = 0;
};

// Runs of cells of equal height along one row.
std::vector<Rectangle> runs(const rcCompactHeightfield& field, const std::vector<std::uint32_t>& islands, int z) {
  std::vector<Rectangle> done, growing;  // one per level under way
  for (int x = 0; x < field.width; ++x) {
    const auto& cell = field.cells[z * field.width + x];
    for (std::uint32_t i = cell.index, end = cell.index + cell.count; i < end; ++i) {
      if (field.areas[i] == RC_NULL_AREA) continue;
      const int level = field.spans[i].y;
      const auto run = std::find_if(growing.begin(), growing.end(), [&](const Rectangle& r) {
        return r.level == level && r.island == islands[i] && r.x1 == x;
      });
      if (run != growing.end())
        ++run->x1;
      else
        growing.push_back({x, x + 1, z, z + 1, level, islands[i]});
    }
    std::copy_if(growing.begin(), growing.end(), std::back_inserter(done),
                 [&](const Rectangle& r) { return r.x1 <= x; });
    std::erase_if(growing, [&](const Rectangle& r) { return r.x1 <= x; });
  }
  done.insert(done.end(), growing.begin(), growing.end());
  return done;
}

// Equal runs of neighbouring rows joined.
std::vector<Rectangle> rectangles(const rcCompactHeightfield& field, const std::vector<std::uint32_t>& islands) {
  using Key = std::tuple<int, int, int, std::uint32_t>;
  std::vector<Rectangle> done;
  std::map<Key, Rectangle> open;
  for (int z = 0; z < field.height; ++z) {
    std::map<Key, Rectangle> next;
    for (auto run : runs(field, islands, z)) {
      const Key key{run.x0, run.x1, run.level, run.island};
      if (const auto before = open.find(key); before != open.end()) {
        run.z0 = before->second.z0;
        open.erase(before);
      }
      next.emplace(key, run);
    }
    for (const auto& [key, rectangle] : open) done.push_back(rectangle);
    open = std::move(next);
  }
  for (const auto& [key, rectangle] : open) done.push_back(rectangle);
  return done;
}

void addMesh(const rcCompactHeightfield& field, const std::vector<std::uint32_t>& islands, Walkable& result) {
  Mesh& mesh = result.mesh;
  for (const auto& r : rectangles(field, islands)) {
    result.area_m2 += static_cast<double>(r.x1 - r.x0) * (r.z1 - r.z0) * field.cs * field.cs;
    result.island_of_triangle.insert(result.island_of_triangle.end(), 2, r.island);
    const auto first = static_cast<std::uint32_t>(mesh.positions.size());
    const float height = field.bmin[1] + static_cast<float>(r.level) * field.ch;
    const auto corner = [&](int x, int z) {
      mesh.positions.emplace_back(field.bmin[0] + static_cast<float>(x) * field.cs,
                                  -(field.bmin[2] + static_cast<float>(z) * field.cs), height);
    };
    corner(r.x0, r.z1), corner(r.x1, r.z1), corner(r.x1, r.z0), corner(r.x0, r.z0);
    mesh.triangles.push_back({first, first + 1, first + 2});
    mesh.triangles.push_back({first, first + 2, first + 3});
  }
  mesh.surface_of_triangle.assign(mesh.triangles.size(), 0);
}

// `done`: the share of all shapes that are in the grids of other clusters.
Result<void> addCluster(const std::vector<CollisionShape>& shapes, const std::vector<bool>& overhead,
                        const Cluster& cluster, double cell, const CollideOptions& options, std::size_t done,
                        std::uint32_t& islands, Walkable& result, Progress& progress) {
  const Grid grid = gridOver(cluster.box, cell, options);
  const auto full = [] {
    return failure(ErrorKind::unusable, "not enough memory for the walkable surface", "collide");
  };
  rcContext context(false);
  const int climb = static_cast<int>(std::floor((kStepHeight + kLeastOver) / grid.level + 1e-3));
  const int height = static_cast<int>(std::ceil(options.agent_height_m / grid.level - 1e-3));
  const Heightfield field(rcAllocHeightfield(), rcFreeHeightField);
  if (!field ||
      !rcCreateHeightfield(&context, *field, grid.width, grid.depth, grid.low, grid.high, grid.cell, grid.level))
    return full();
  for (const auto i : cluster.shapes) {
    TRY(progress.check());
    progress.advance(0.7 * static_cast<double>(done++) / static_cast<double>(shapes.size()));
    const bool over = shapes[i].product < overhead.size() && overhead[shapes[i].product];
    const Soup soup = soupOf(shapes[i].mesh, over, context);
    const bool solid = shapes[i].kind != CollisionShapeKind::mesh;
    if (!(solid ? addSolid(soup, *field, grid, climb, context, progress)
                : addTriangles(soup, *field, climb, context, progress)))
      return full();
  }
  const CompactHeightfield compact(rcAllocCompactHeightfield(), rcFreeCompactHeightfield);
  const int radius = std::min(127, static_cast<int>(std::ceil(options.agent_radius_m / grid.cell - 1e-3)));
  std::vector<std::uint32_t> island_of_span;
  const std::function<bool()> stages[] = {
      [&] { return rcFilterLowHangingWalkableObstacles(&context, climb, *field), true; },
      [&] { return rcFilterLedgeSpans(&context, height, climb, *field), true; },
      [&] { return rcFilterWalkableLowHeightSpans(&context, height, *field), true; },
      [&] { return compact && rcBuildCompactHeightfield(&context, height, climb, *field, *compact); },
      [&] { return rcErodeWalkableArea(&context, radius, *compact); },
      [&] {
        return island_of_span = findIslands(
                   *compact, 4 * options.agent_radius_m * options.agent_radius_m / (grid.cell * grid.cell), islands),
               true;
      }};
  for (const auto& stage : stages) {
    TRY(progress.check());
    if (!stage()) return full();
  }
  addMesh(*compact, island_of_span, result);
  return {};
}

}  // namespace

Result<Walkable> walkableSurface(const std::vector<CollisionShape>& shapes, const std::vector<bool>& overhead,
                                 const CollideOptions& options, Progress& progress) {
  Walkable result;
  const auto clusters = clustersOf(shapes, options);
  if (clusters.empty()) return result;
  result.cell_m = cellFor(clusters, options);
  std::size_t done = 0;
  std::uint32_t islands = 0;
  for (const auto& cluster : clusters) {
    TRY(addCluster(shapes, overhead, cluster, result.cell_m, options, done, islands, result, progress));
    done += cluster.shapes.size();
  }
  return result;
}

}  // namespace standpoint

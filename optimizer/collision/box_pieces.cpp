// SPDX-License-Identifier: GPL-3.0-or-later
#include <algorithm>
#include <array>
#include <cmath>

#include "optimizer/collision/pieces.h"

namespace standpoint {

namespace {

using Eigen::Matrix3d;
using Eigen::Vector3d;

constexpr double kFlat = 0.001;  // m; faces this flat in one axis are square to it, planes this near are one
constexpr std::size_t kMostCells = 100'000;
constexpr std::size_t kMostBoxes = 200;
constexpr std::size_t kFewBlocks = 4;  // that need not become fewer

// The part's own axes (rows): the two largest perpendicular face directions and their cross product.
std::optional<Matrix3d> ownAxes(const Shape& part) {
  const auto directions = faceDirections(part);
  for (std::size_t i = 1; i < directions.size(); ++i) {
    if (std::abs(directions[0].dot(directions[i])) > 1e-3) continue;
    const Vector3d second = (directions[i] - directions[0] * directions[0].dot(directions[i])).normalized();
    Matrix3d axes;
    axes.row(0) = directions[0];
    axes.row(1) = second;
    axes.row(2) = directions[0].cross(second);
    return axes;
  }
  return std::nullopt;
}

// The cells between the planes of the faces, each solid or empty.
struct Cells {
  std::array<std::vector<double>, 3> planes;
  std::array<int, 3> size{};
  std::vector<char> solid;

  std::size_t at(int x, int y, int z) const { return (static_cast<std::size_t>(z) * size[1] + y) * size[0] + x; }
};

int cellBelow(const std::vector<double>& planes, double value) {  // index of the plane at `value`
  const auto it = std::lower_bound(planes.begin(), planes.end(), value - kFlat);
  return static_cast<int>(it - planes.begin());
}

bool covers(const std::array<Vector3d, 3>& t, double y, double z) {
  const auto side = [&](int i, int j) {
    return (t[j].y() - t[i].y()) * (z - t[i].z()) - (t[j].z() - t[i].z()) * (y - t[i].y());
  };
  const double a = side(0, 1), b = side(1, 2), c = side(2, 0);
  return (a > 0 && b > 0 && c > 0) || (a < 0 && b < 0 && c < 0);
}

// A face square to x turns solid into empty, or back, for all cells behind it.
void crossFace(Cells& cells, const std::array<Vector3d, 3>& t) {
  const int x = cellBelow(cells.planes[0], t[0].x());
  if (x >= cells.size[0]) return;
  const auto middle = [&](int axis, int i) { return 0.5 * (cells.planes[axis][i] + cells.planes[axis][i + 1]); };
  const auto range = [&](int axis) {
    const auto [low, high] = std::minmax({t[0][axis], t[1][axis], t[2][axis]});
    return std::pair(cellBelow(cells.planes[axis], low),
                     std::min(cellBelow(cells.planes[axis], high), cells.size[axis]));
  };
  const auto [y0, y1] = range(1);
  const auto [z0, z1] = range(2);
  for (int z = z0; z < z1; ++z)
    for (int y = y0; y < y1; ++y)
      // A diagonal shared by two triangles must not run through the point that is asked for.
      if (covers(t, middle(1, y) + 1e-7 * (1 + y), middle(2, z) + 1.7e-7 * (1 + z)))
        cells.solid[cells.at(x, y, z)] ^= 1;
}

std::optional<Cells> cut(const Shape& part, const Matrix3d& axes) {
  std::vector<Vector3d> points(part.positions.size());
  std::transform(part.positions.begin(), part.positions.end(), points.begin(),
                 [&](const Vector3d& p) { return axes * p; });
  Cells cells;
  std::size_t count = 1;
  for (int axis = 0; axis < 3; ++axis) {
    std::vector<double> values;
    for (const auto& t : part.triangles)
      for (const auto v : t) values.push_back(points[v][axis]);
    cells.planes[axis] = distinct(std::move(values), kFlat);
    cells.size[axis] = static_cast<int>(cells.planes[axis].size()) - 1;
    if (cells.size[axis] < 1) return std::nullopt;
    count *= static_cast<std::size_t>(cells.size[axis]);
    if (count > kMostCells) return std::nullopt;
  }
  cells.solid.assign(count, 0);
  for (const auto& t : part.triangles) {
    const std::array<Vector3d, 3> p{points[t[0]], points[t[1]], points[t[2]]};
    const Vector3d extent = p[0].cwiseMax(p[1]).cwiseMax(p[2]) - p[0].cwiseMin(p[1]).cwiseMin(p[2]);
    if (extent.minCoeff() > kFlat) return std::nullopt;  // oblique
    if (extent.x() <= kFlat) crossFace(cells, p);
  }
  for (int z = 0; z < cells.size[2]; ++z)
    for (int y = 0; y < cells.size[1]; ++y)
      for (int x = 1; x < cells.size[0]; ++x) cells.solid[cells.at(x, y, z)] ^= cells.solid[cells.at(x - 1, y, z)];
  return cells;
}

struct Block {
  std::array<int, 3> low, high;
};

// Grows blocks of solid cells, along the axes in the given order, as far as they go.
std::vector<Block> blocks(const Cells& cells, const std::array<int, 3>& order) {
  auto left = cells.solid;
  std::vector<Block> result;
  const auto all = [&](const Block& b) {
    for (int z = b.low[2]; z < b.high[2]; ++z)
      for (int y = b.low[1]; y < b.high[1]; ++y)
        for (int x = b.low[0]; x < b.high[0]; ++x)
          if (!left[cells.at(x, y, z)]) return false;
    return true;
  };
  std::array<int, 3> at{};
  for (at[order[2]] = 0; at[order[2]] < cells.size[order[2]]; ++at[order[2]])
    for (at[order[1]] = 0; at[order[1]] < cells.size[order[1]]; ++at[order[1]])
      for (at[order[0]] = 0; at[order[0]] < cells.size[order[0]]; ++at[order[0]]) {
        if (!left[cells.at(at[0], at[1], at[2])]) continue;
        Block block{at, {at[0] + 1, at[1] + 1, at[2] + 1}};
        for (const int axis : order)
          while (block.high[axis] < cells.size[axis]) {
            Block next = block;
            next.low[axis] = block.high[axis];
            next.high[axis] = block.high[axis] + 1;
            if (!all(next)) break;
            ++block.high[axis];
          }
        for (int z = block.low[2]; z < block.high[2]; ++z)
          for (int y = block.low[1]; y < block.high[1]; ++y)
            for (int x = block.low[0]; x < block.high[0]; ++x) left[cells.at(x, y, z)] = 0;
        result.push_back(block);
      }
  return result;
}

// The same, but each block grows both ways and over cells that others have already: pillars and strips may cross.
std::vector<Block> coveringBlocks(const Cells& cells) {
  auto left = cells.solid;
  const auto count = [&](const Block& b, const std::vector<char>& of) {
    std::size_t sum = 0;
    for (int z = b.low[2]; z < b.high[2]; ++z)
      for (int y = b.low[1]; y < b.high[1]; ++y)
        for (int x = b.low[0]; x < b.high[0]; ++x) sum += of[cells.at(x, y, z)] != 0;
    return sum;
  };
  const auto isSolid = [&](const Block& b) {
    return count(b, cells.solid) ==
           static_cast<std::size_t>(b.high[0] - b.low[0]) * (b.high[1] - b.low[1]) * (b.high[2] - b.low[2]);
  };
  const auto grown = [&](const std::array<int, 3>& at, const std::array<int, 3>& order) {
    Block block{at, {at[0] + 1, at[1] + 1, at[2] + 1}};
    for (const int axis : order) {
      for (Block next = block; next.high[axis] < cells.size[axis]; block.high[axis] = next.high[axis]) {
        next = block, next.low[axis] = block.high[axis], next.high[axis] = block.high[axis] + 1;
        if (!isSolid(next)) break;
      }
      for (Block next = block; block.low[axis] > 0; block.low[axis] = next.low[axis]) {
        next = block, next.high[axis] = block.low[axis], next.low[axis] = block.low[axis] - 1;
        if (!isSolid(next)) break;
      }
    }
    return block;
  };
  std::vector<Block> result;
  for (int z = 0; z < cells.size[2]; ++z)
    for (int y = 0; y < cells.size[1]; ++y)
      for (int x = 0; x < cells.size[0]; ++x) {
        if (!left[cells.at(x, y, z)]) continue;
        Block best;
        std::size_t most = 0;
        std::array<int, 3> order{0, 1, 2};
        do {
          const auto block = grown({x, y, z}, order);
          if (const auto gain = count(block, left); gain > most) best = block, most = gain;
        } while (std::next_permutation(order.begin(), order.end()));
        for (int k = best.low[2]; k < best.high[2]; ++k)
          for (int j = best.low[1]; j < best.high[1]; ++j)
            for (int i = best.low[0]; i < best.high[0]; ++i) left[cells.at(i, j, k)] = 0;
        result.push_back(best);
        if (result.size() > kMostBoxes) return result;
      }
  return result;
}

double insideVolume(const Cells& cells) {
  double sum = 0;
  const auto length = [&](int axis, int i) { return cells.planes[axis][i + 1] - cells.planes[axis][i]; };
  for (int z = 0; z < cells.size[2]; ++z)
    for (int y = 0; y < cells.size[1]; ++y)
      for (int x = 0; x < cells.size[0]; ++x)
        if (cells.solid[cells.at(x, y, z)]) sum += length(0, x) * length(1, y) * length(2, z);
  return sum;
}

Piece boxOf(const Cells& cells, const Block& block, const Matrix3d& axes) {
  std::vector<Vector3d> bottom, top;
  constexpr int kCorners[4][2] = {{0, 0}, {1, 0}, {1, 1}, {0, 1}};
  for (const auto& corner : kCorners) {
    const double x = cells.planes[0][corner[0] ? block.high[0] : block.low[0]];
    const double y = cells.planes[1][corner[1] ? block.high[1] : block.low[1]];
    bottom.push_back(axes.transpose() * Vector3d(x, y, cells.planes[2][block.low[2]]));
    top.push_back(axes.transpose() * Vector3d(x, y, cells.planes[2][block.high[2]]));
  }
  return prism(bottom, top, CollisionShapeKind::box);
}

}  // namespace

std::vector<Piece> boxPieces(const Shape& part, double volume_m3) {
  const auto axes = ownAxes(part);
  if (!axes) return {};
  const auto cells = cut(part, *axes);
  if (!cells || std::abs(insideVolume(*cells) - std::abs(volume_m3)) > 0.01 * std::abs(volume_m3)) return {};
  std::vector<Block> best;
  std::array<int, 3> order{0, 1, 2};
  do {
    auto candidate = blocks(*cells, order);
    if (best.empty() || candidate.size() < best.size()) best = std::move(candidate);
  } while (std::next_permutation(order.begin(), order.end()));
  if (best.size() > kFewBlocks)
    if (auto covering = coveringBlocks(*cells); covering.size() < best.size()) best = std::move(covering);
  if (best.size() > kMostBoxes) return {};
  std::vector<Piece> result;
  for (const auto& block : best) result.push_back(boxOf(*cells, block, *axes));
  return result;
}

}  // namespace standpoint

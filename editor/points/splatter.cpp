// SPDX-License-Identifier: GPL-3.0-or-later
#include "editor/points/splatter.h"

#include <algorithm>
#include <array>
#include <atomic>
#include <bit>
#include <cmath>

#include <tbb/parallel_for.h>
#include <tbb/task_arena.h>

namespace standpoint {

namespace {

constexpr std::uint64_t kNothing = ~std::uint64_t{0};
constexpr std::size_t kBatch = 512;       // of points: what is computed of them stays in the nearest cache
constexpr std::size_t kSlice = 64 * 512;  // what a thread takes at once
constexpr int kMostThreads = 8;           // each has a picture of its own, which must be put together

// GCC compiles these for both and takes what the processor has. Without fused operations both give the same bits.
#if defined(__x86_64__) && defined(__GNUC__) && !defined(__clang__)
#define STANDPOINT_LANES __attribute__((target_clones("avx2", "default")))
#else
#define STANDPOINT_LANES
#endif

struct Target {
  std::uint64_t* nearest;
  int width, height;
};

struct Projected {
  std::array<std::int32_t, kBatch> column, row;  // of its lower left pixel; a row of less than 0: not seen
  std::array<std::uint32_t, kBatch> depth;
};

struct ProjectedBy {
  std::array<float, 16> m;
  float half_width, half_height, offset;  // the latter: from a point to the corner of its square, pixels
};

STANDPOINT_LANES void project(const float* __restrict x, const float* __restrict y, const float* __restrict z,
                              std::size_t count, const ProjectedBy& by, Projected& out) {
  const auto& m = by.m;
  const float hw = by.half_width, hh = by.half_height, right = 2 * hw, top = 2 * hh;
  std::int32_t* __restrict column = out.column.data();
  std::int32_t* __restrict row = out.row.data();
  std::uint32_t* __restrict depth = out.depth.data();
  for (std::size_t i = 0; i < count; ++i) {
    const float w = m[12] * x[i] + m[13] * y[i] + m[14] * z[i] + m[15];
    const float over = 1 / w;
    const float px = ((m[0] * x[i] + m[1] * y[i] + m[2] * z[i] + m[3]) * over + 1) * hw;
    const float py = ((m[4] * x[i] + m[5] * y[i] + m[6] * z[i] + m[7]) * over + 1) * hh;
    const float d = (m[8] * x[i] + m[9] * y[i] + m[10] * z[i] + m[11]) * over * 0.5F + 0.5F;
    // What is not a number compares as false, so it is not seen.
    const bool seen = (w > 1e-6F) & (px >= 0) & (px < right) & (py >= 0) & (py < top) & (d >= 0) & (d < 1);
    const float c = px + by.offset, r = py + by.offset;
    column[i] = seen ? static_cast<std::int32_t>(c > 0 ? c : 0) : 0;
    row[i] = seen ? static_cast<std::int32_t>(r > 0 ? r : 0) : -1;
    depth[i] = std::bit_cast<std::uint32_t>(d);
  }
}

template <int kSize>
void scatter(const Projected& p, const std::uint32_t* colours, std::size_t count, const Target& to, int size_px) {
  constexpr std::size_t kAhead = 12;  // the picture is larger than the caches that answer at once
  const int size = kSize > 0 ? kSize : size_px;
  for (std::size_t i = 0; i < count; ++i) {
    if (i + kAhead < count && p.row[i + kAhead] >= 0)
      __builtin_prefetch(to.nearest + static_cast<std::ptrdiff_t>(p.row[i + kAhead]) * to.width + p.column[i + kAhead],
                         1);
    if (p.row[i] < 0) continue;
    const std::uint64_t key = (std::uint64_t{p.depth[i]} << 32) | colours[i];
    std::uint64_t* line = to.nearest + static_cast<std::ptrdiff_t>(p.row[i]) * to.width + p.column[i];
    const int columns = std::min(size, to.width - p.column[i]), rows = std::min(size, to.height - p.row[i]);
    for (int r = 0; r < rows; ++r, line += to.width)
      for (int c = 0; c < columns; ++c)
        if (key < line[c]) line[c] = key;
  }
}

void hideBeyond(const std::vector<Eigen::Vector4d>& sides, const PackedPoints& points, std::size_t first,
                std::size_t count, Projected& p) {
  for (const auto& side : sides) {
    const Eigen::Vector4f s = side.cast<float>();
    for (std::size_t i = 0; i < count; ++i) {
      const std::size_t k = first + i;
      if (!(s.x() * points.x_m[k] + s.y() * points.y_m[k] + s.z() * points.z_m[k] + s.w() >= 0)) p.row[i] = -1;
    }
  }
}

void drawSlice(const PointRun& run, std::size_t first, std::size_t last, const Target& to) {
  ProjectedBy by{};
  for (int i = 0; i < 16; ++i)
    by.m[static_cast<std::size_t>(i)] = static_cast<float>(run.clip_from_points(i / 4, i % 4));
  by.half_width = 0.5F * static_cast<float>(to.width);
  by.half_height = 0.5F * static_cast<float>(to.height);
  by.offset = -0.5F * static_cast<float>(run.size_px - 1);
  const auto& points = *run.points;
  Projected projected;
  for (std::size_t at = first; at < last; at += kBatch) {
    const std::size_t count = std::min(kBatch, last - at);
    project(points.x_m.data() + at, points.y_m.data() + at, points.z_m.data() + at, count, by, projected);
    if (!run.kept_sides.empty()) hideBeyond(run.kept_sides, points, at, count, projected);
    const std::uint32_t* colours = points.colours.data() + at;
    switch (run.size_px) {
      case 1: scatter<1>(projected, colours, count, to, 1); break;
      case 2: scatter<2>(projected, colours, count, to, 2); break;
      default: scatter<0>(projected, colours, count, to, run.size_px); break;
    }
  }
}

struct Slice {
  const PointRun* run;
  std::size_t first, last;
};

}  // namespace

void Splatter::begin(int width, int height) {
  width_ = std::max(width, 1);
  height_ = std::max(height, 1);
  const auto threads = static_cast<std::size_t>(std::clamp(tbb::this_task_arena::max_concurrency(), 1, kMostThreads));
  nearest_.resize(threads);
  tbb::parallel_for(std::size_t{0}, threads, [&](std::size_t t) {
    nearest_[t].assign(static_cast<std::size_t>(width_) * static_cast<std::size_t>(height_), kNothing);
  });
  changed_ = true;
}

void Splatter::draw(std::span<const PointRun> runs) {
  std::vector<Slice> slices;
  for (const auto& run : runs)
    for (std::size_t at = run.first; at < run.first + run.count; at += kSlice)
      slices.push_back({&run, at, std::min(at + kSlice, run.first + run.count)});
  if (slices.empty()) return;
  changed_ = true;
  std::atomic<std::size_t> next{0};
  tbb::parallel_for(std::size_t{0}, nearest_.size(), [&](std::size_t t) {
    const Target to{nearest_[t].data(), width_, height_};
    for (std::size_t i = next.fetch_add(1); i < slices.size(); i = next.fetch_add(1))
      drawSlice(*slices[i].run, slices[i].first, slices[i].last, to);
  });
}

const PointPicture& Splatter::picture() {
  if (!std::exchange(changed_, false)) return picture_;
  picture_.width = width_;
  picture_.height = height_;
  const std::size_t pixels = nearest_.empty() ? 0 : nearest_.front().size();
  picture_.colours.resize(pixels);
  picture_.depths.resize(pixels);
  tbb::parallel_for(tbb::blocked_range<std::size_t>(0, pixels, 1 << 16), [&](const auto& part) {
    for (std::size_t i = part.begin(); i < part.end(); ++i) {
      std::uint64_t key = nearest_.front()[i];
      for (std::size_t t = 1; t < nearest_.size(); ++t) key = std::min(key, nearest_[t][i]);
      picture_.colours[i] = key == kNothing ? 0 : static_cast<std::uint32_t>(key);
      picture_.depths[i] = key == kNothing ? 1 : std::bit_cast<float>(static_cast<std::uint32_t>(key >> 32));
    }
  });
  return picture_;
}

namespace {

// How much darker a row of the picture gets: how far its pixels lie behind their four neighbours, as a part of their
// distance, so that the same step is as dark from afar. `above` and `below` are rows of distances, too.
STANDPOINT_LANES void shadeRow(const float* __restrict below, const float* __restrict row,
                               const float* __restrict above, std::uint32_t* __restrict colours, int width,
                               float over) {
  constexpr float kStrength = 6, kMost = 0.2F;
  for (int x = 0; x < width; ++x) {
    const float here = row[x], scale = over > 0 ? over : 1 / here;
    const auto behind = [&](float neighbour) {
      const float step = (here - neighbour) * scale;
      return step > 0 ? (step < kMost ? step : kMost) : 0.0F;
    };
    const float sum = behind(row[x - 1]) + behind(row[x + 1]) + behind(below[x]) + behind(above[x]);
    const auto kept = static_cast<std::uint32_t>(static_cast<std::int32_t>(256 / (1 + kStrength * sum)));
    const std::uint32_t c = colours[x];
    colours[x] = (c & 0xff000000U) | (((c >> 16 & 255U) * kept >> 8) << 16) | (((c >> 8 & 255U) * kept >> 8) << 8) |
                 ((c & 255U) * kept >> 8);
  }
}

}  // namespace

void shadeByDepth(PointPicture& picture, const DepthRange& range) {
  const int width = picture.width, height = picture.height;
  const auto near = static_cast<float>(range.near_m), far = static_cast<float>(range.far_m);
  // With a rim of what lies nowhere near, so that no pixel lacks a neighbour.
  const auto stride = static_cast<std::size_t>(width) + 2;
  std::vector<float> away(stride * (static_cast<std::size_t>(height) + 2), 1e9F);
  const auto rowOf = [&](int y) { return away.data() + static_cast<std::size_t>(y + 1) * stride + 1; };
  tbb::parallel_for(0, height, [&](int y) {
    const float* depth = picture.depths.data() + static_cast<std::size_t>(y) * static_cast<std::size_t>(width);
    float* row = rowOf(y);
    for (int x = 0; x < width; ++x) {
      const float d = depth[x];
      const float metres = range.parallel ? near + d * (far - near) : near * far / (far - d * (far - near));
      row[x] = d < 1 ? metres : 1e9F;
    }
  });
  // Seen in parallel there is no distance: the depth of what is shown stands for it.
  const float over = range.parallel ? 10 / (far - near) : 0;
  tbb::parallel_for(0, height, [&](int y) {
    shadeRow(rowOf(y - 1), rowOf(y), rowOf(y + 1),
             picture.colours.data() + static_cast<std::size_t>(y) * static_cast<std::size_t>(width), width, over);
  });
}

}  // namespace standpoint

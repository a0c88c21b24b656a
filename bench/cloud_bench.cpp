// SPDX-License-Identifier: GPL-3.0-or-later
// Points per second of processor time (of the process, system calls included) of the formats, written and read, beside
// the writing of as many bytes by fwrite and, for text, beside fprintf and fscanf. What counts are the ratios within
// one run.
//   build/release/bin/bench_clouds [FOLDER [FORMAT]]
#include <cmath>
#include <cstdio>
#include <ctime>
#include <filesystem>
#include <functional>
#include <string>
#include <vector>

#include "core/random.h"
#include "pointclouds/e57/e57.h"
#include "pointclouds/formats.h"

namespace standpoint {
namespace {

namespace fs = std::filesystem;
constexpr std::uint32_t kColumns = 5000, kRows = 2000;
constexpr double kPoints = 1e7;
constexpr int kRuns = 3;

ScanHeader header() {
  ScanHeader h;
  h.name = "bench";
  h.guid = "{00000000-0000-8000-8000-000000000002}";
  h.rows = kRows;
  h.columns = kColumns;
  h.has_colour = true;
  h.file_from_scanner.translation = {512345.25, 5600123.5, 120};
  h.acquisition_start_gps_s = 1.4e9;
  return h;
}

// Fifty columns that are written a hundred times: the writer is measured, not the making of points.
std::vector<PointBlock> columns() {
  std::vector<PointBlock> blocks(50);
  for (std::uint32_t c = 0; c < blocks.size(); ++c)
    for (std::uint32_t r = 0; r < kRows; ++r) {
      const auto random = philox({3, 0}, c, r, 0);
      const double azimuth = -6.28 * c / 50, elevation = -1 + 2.0 * r / kRows, range = 2 + 10 * uniform(random[0]);
      PointBlock& b = blocks[c];
      b.x_m.push_back(static_cast<float>(range * std::cos(elevation) * std::cos(azimuth)));
      b.y_m.push_back(static_cast<float>(range * std::cos(elevation) * std::sin(azimuth)));
      b.z_m.push_back(static_cast<float>(range * std::sin(elevation)));
      b.intensity.push_back(static_cast<float>(uniform(random[1])));
      b.row.push_back(r);
      b.column.push_back(c);
      b.red.push_back(static_cast<std::uint8_t>(random[2])),
          b.green.push_back(static_cast<std::uint8_t>(random[2] >> 8));
      b.blue.push_back(static_cast<std::uint8_t>(random[2] >> 16));
    }
  return blocks;
}

double seconds(const std::function<bool()>& work) {
  double best = 1e9;
  for (int run = 0; run < kRuns; ++run) {
    const std::clock_t start = std::clock();
    if (!work()) std::fprintf(stderr, "failed\n"), std::exit(1);
    best = std::min(best, static_cast<double>(std::clock() - start) / CLOCKS_PER_SEC);
  }
  return best;
}

bool writeAll(std::vector<PointBlock>& blocks, CloudWriter& writer) {
  if (!writer.begin(header())) return false;
  for (std::uint32_t c = 0; c < kColumns; ++c) {
    PointBlock& block = blocks[c % blocks.size()];
    std::fill(block.column.begin(), block.column.end(), c);
    if (!writer.write(block)) return false;
  }
  return writer.end() && writer.close();
}

class Nothing final : public PointSink {
 public:
  Result<void> begin(const ScanHeader&) override { return {}; }
  Result<void> write(const PointBlock& block) override { return points += block.size(), Result<void>{}; }
  Result<void> end() override { return {}; }
  Result<void> close() override { return {}; }
  std::uint64_t points = 0;
};

double writeBytes(const fs::path& file, std::uintmax_t bytes) {
  const std::vector<char> piece(1 << 20, 'x');
  return seconds([&] {
    std::FILE* const out = std::fopen(file.c_str(), "wb");
    for (std::uintmax_t left = bytes; left > 0;) {
      const std::size_t n = std::min<std::uintmax_t>(left, piece.size());
      if (std::fwrite(piece.data(), 1, n, out) != n) return false;
      left -= n;
    }
    return std::fclose(out) == 0;
  });
}

double printPtx(const std::vector<PointBlock>& blocks, const fs::path& file) {
  return seconds([&] {
    std::FILE* const out = std::fopen(file.c_str(), "wb");
    for (std::uint32_t c = 0; c < kColumns; ++c) {
      const PointBlock& b = blocks[c % blocks.size()];
      for (std::size_t i = 0; i < b.size(); ++i)
        std::fprintf(out, "%.6f %.6f %.6f %.6f %d %d %d\n", static_cast<double>(b.x_m[i]),
                     static_cast<double>(b.y_m[i]), static_cast<double>(b.z_m[i]), static_cast<double>(b.intensity[i]),
                     b.red[i], b.green[i], b.blue[i]);
    }
    return std::fclose(out) == 0;
  });
}

double scanText(const fs::path& file) {
  return seconds([&] {
    std::FILE* const in = std::fopen(file.c_str(), "rb");
    double v[4], sum = 0;
    int colour[3], points = 0;
    while (std::fscanf(in, "%lf %lf %lf %lf %d %d %d", v, v + 1, v + 2, v + 3, colour, colour + 1, colour + 2) == 7)
      sum += v[0], ++points;
    return std::fclose(in) == 0 && points == static_cast<int>(kPoints) && std::isfinite(sum);
  });
}

void measure(const char* name, CloudFormat::Writer writer, const fs::path& file, std::vector<PointBlock>& blocks) {
  const double written = seconds([&] { return writeAll(blocks, **writer(file)); });
  const auto bytes = fs::file_size(file);
  const double disk = writeBytes(file.string() + ".raw", bytes);
  const double read = seconds([&] {
    Nothing sink;
    Progress progress;
    return cloudFormatFor(file)->read(file, sink, progress).has_value() &&
           sink.points == static_cast<std::uint64_t>(kPoints);
  });
  std::printf(
      "%-14s write %6.2f M/s  read %6.2f M/s  %5.1f B/pt  fwrite of as many bytes %6.2f M/s (we need %.2f of its "
      "time)\n",
      name, kPoints / written / 1e6, kPoints / read / 1e6, static_cast<double>(bytes) / kPoints, kPoints / disk / 1e6,
      written / disk);
  fs::remove(file);
  fs::remove(file.string() + ".raw");
}

}  // namespace
}  // namespace standpoint

int main(int argc, char** argv) {
  using namespace standpoint;
  const fs::path folder = argc > 1 ? fs::path(argv[1]) : fs::temp_directory_path();
  auto blocks = columns();
  for (const CloudFormat& format : cloudFormats()) {
    if (!format.writer || (argc > 2 && format.name != std::string(argv[2]))) continue;
    measure(format.name, format.writer, folder / (std::string("bench") + format.extension), blocks);
    for (const CloudVariant& v : format.variants)
      measure((std::string(format.name) + " " + v.name).c_str(), v.writer,
              folder / (std::string("bench") + format.extension), blocks);
  }
  std::printf("PTX by fprintf %6.2f M/s\n", kPoints / printPtx(blocks, folder / "bench.txt") / 1e6);
  std::printf("the same text by fscanf %6.2f M/s\n", kPoints / scanText(folder / "bench.txt") / 1e6);
  fs::remove(folder / "bench.txt");
}

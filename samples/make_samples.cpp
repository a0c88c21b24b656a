// SPDX-License-Identifier: GPL-3.0-or-later
// standpoint-samples OUTDIR: writes the samples, the same bytes every time.
#include <cstdio>
#include <filesystem>
#include <fstream>

#include "samples/models.h"

namespace {

bool write(const std::filesystem::path& file, const std::string& bytes) {
  std::ofstream out(file, std::ios::binary);
  out << bytes;
  out.close();
  if (!out) std::fprintf(stderr, "standpoint-samples: cannot write %s\n", file.string().c_str());
  return !out.fail();
}

}  // namespace

int main(int argc, char** argv) {
  if (argc != 2) {
    std::fprintf(stderr, "usage: standpoint-samples OUTDIR\n");
    return 2;
  }
  const std::filesystem::path folder = argv[1];
  std::error_code code;
  std::filesystem::create_directories(folder, code);
  using namespace standpoint::samples;
  const bool ok = write(folder / "house.ifc", houseIfc()) && write(folder / "street.ifc", streetIfc()) &&
                  write(folder / "corridor.ifc", corridorIfc()) && write(folder / "turbine.ifc", turbineIfc()) &&
                  write(folder / "ornament.glb", ornamentGlb());
  return ok ? 0 : 4;
}

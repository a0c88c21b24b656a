// SPDX-License-Identifier: GPL-3.0-or-later
#include "tests/fuzz/fuzz_file.h"

namespace standpoint {
extern const Importer kGltfImporter;
}

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  return standpoint::fuzz::import(standpoint::kGltfImporter, data, size);
}

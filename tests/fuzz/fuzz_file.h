// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstddef>
#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <string>
#include <unistd.h>

#include "importers/importers.h"

namespace standpoint::fuzz {

// The bytes as a file in memory, in a folder of the process that is gone when it ends, since readers take paths.
inline std::filesystem::path fileOf(const std::uint8_t* data, std::size_t size, const char* extension) {
  static const struct Folder {
    std::filesystem::path path = "/dev/shm/standpoint-fuzz-" + std::to_string(getpid());
    Folder() { std::filesystem::create_directory(path); }
    ~Folder() {
      std::error_code ignored;
      std::filesystem::remove_all(path, ignored);
    }
  } folder;
  const auto path = folder.path / ("case" + std::string(extension));
  std::ofstream(path, std::ios::binary).write(reinterpret_cast<const char*>(data), static_cast<std::streamsize>(size));
  return path;
}

// An importer may refuse the bytes, or give a whole environment; anything else is a fault.
inline int import(const Importer& importer, const std::uint8_t* data, std::size_t size) {
  Progress progress;
  const auto model = importer.read(fileOf(data, size, importer.extensions.front()), {}, progress);
  const std::string wrong = model                          ? validate(model->environment)
                            : model.error().source.empty() ? "an error names no place"
                                                           : "";
  if (wrong.empty()) return 0;
  std::fprintf(stderr, "%s\n", wrong.c_str());
  std::abort();
}

}  // namespace standpoint::fuzz

// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdlib>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <string>
#include <vector>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "importers/importers.h"

namespace standpoint::test {

// A folder of the running test alone, empty at first.
inline std::filesystem::path scratch() {
  const auto* info = ::testing::UnitTest::GetInstance()->current_test_info();
  const auto folder =
      std::filesystem::path(BINARY_DIR) / "scratch" / (std::string(info->test_suite_name()) + "." + info->name());
  std::filesystem::remove_all(folder);
  std::filesystem::create_directories(folder);
  return folder;
}

inline std::filesystem::path write(const std::filesystem::path& file, const std::string& bytes) {
  std::ofstream(file, std::ios::binary) << bytes;
  return file;
}

inline std::string readBytes(const std::filesystem::path& file) {
  std::ifstream stream(file, std::ios::binary);
  return {std::istreambuf_iterator<char>(stream), {}};
}

inline Result<ImportedModel> import(const std::filesystem::path& file, const ImportOptions& options = {}) {
  Progress progress;
  return importFile(file, options, progress);
}

inline std::string refusal(const std::filesystem::path& file) {
  const auto model = import(file);
  return model ? "accepted" : describe(model.error());
}

// The real input that lies beside the project on the developers' machines.
inline std::filesystem::path corpus() {
  const char* override_folder = std::getenv("STANDPOINT_SHARED");
  return std::filesystem::path(override_folder != nullptr ? override_folder : SOURCE_DIR "/../shared") / "corpus";
}

template <class T>
std::string bytesOf(const std::vector<T>& values) {
  return {reinterpret_cast<const char*>(values.data()), values.size() * sizeof(T)};
}

// A GLB of a JSON text and a binary chunk, written from the specification's table of the container.
inline std::string glb(std::string json, std::string binary) {
  json.resize((json.size() + 3) / 4 * 4, ' ');
  binary.resize((binary.size() + 3) / 4 * 4, '\0');
  const auto word = [](std::size_t v) { return std::string{char(v), char(v >> 8), char(v >> 16), char(v >> 24)}; };
  return "glTF" + word(2) + word(28 + json.size() + binary.size()) + word(json.size()) + "JSON" + json +
         word(binary.size()) + std::string("BIN\0", 4) + binary;
}

}  // namespace standpoint::test

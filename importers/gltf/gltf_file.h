// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdint>
#include <filesystem>
#include <map>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include <Eigen/Core>
#include <nlohmann/json.hpp>

#include "core/result.h"

namespace standpoint {

// A glTF 2.0 file, .gltf or .glb, with every index, offset and size checked where it is used, so that a wrong or
// hostile file ends in a message that names its place. The first fault is kept and every later answer is empty: callers
// test `failed()` where they would otherwise loop, and once at the end.
//
// Not tinygltf: version 2.7 as packaged follows unchecked indices in Draco primitives (a segmentation fault for one
// wrong number), refuses EXT_meshopt_compression and names no place in its messages.
class GltfFile {
 public:
  explicit GltfFile(std::filesystem::path path) : path_(std::move(path)) {}

  void load();
  const nlohmann::json& json() const { return json_; }

  bool failed() const { return error_.has_value(); }
  const Error& error() const { return *error_; }
  void fail(const std::string& place, std::string message, ErrorKind kind = ErrorKind::unusable);
  void fail(Error error);  // whose source is a place

  // Members of an object, each with the place of the object for the message. A missing one gives the fallback.
  std::size_t natural(const nlohmann::json& object, const char* key, std::size_t fallback, const std::string& place);
  std::optional<std::size_t> index(const nlohmann::json& object, const char* key, const std::string& place);
  std::vector<double> numbers(const nlohmann::json& object, const char* key, std::size_t count,
                              const std::string& place);
  std::string text(const nlohmann::json& object, const char* key) const;

  std::size_t count(const char* array) const;
  // "/nodes/7", or a fault and an empty object when there is none.
  const nlohmann::json& element(const char* array, std::size_t index, const std::string& asked_by);

  // Accessors with sparse values, normalisation and meshopt compression applied.
  std::size_t countOf(std::size_t accessor, const std::string& asked_by);
  std::size_t componentsOf(std::size_t accessor, const std::string& asked_by);
  std::vector<Eigen::Vector3f> vectors3(std::size_t accessor, const std::string& asked_by);
  std::vector<float> floats(std::size_t accessor, std::size_t components, const std::string& asked_by);
  std::vector<std::uint32_t> indices(std::size_t accessor, const std::string& asked_by);
  std::span<const std::uint8_t> view(std::size_t buffer_view, const std::string& asked_by);

  // What a uri names: data, or a file in the model's folder; at most as many bytes as asked for.
  Result<std::vector<std::uint8_t>> resource(const std::string& uri, const std::string& place,
                                             std::size_t at_most = std::size_t{1} << 30U);

  // Counts what decoding makes of the file: a few kilobytes must not become a terabyte.
  bool spend(std::size_t bytes, const std::string& place);

 private:
  struct Packed {
    std::size_t component_type = 0, components = 0, count = 0;
    bool normalized = false;
    std::span<const std::uint8_t> bytes;  // tightly packed: in the buffer where they are so there …
    std::vector<std::uint8_t> own;        // … else here
  };
  // Big files are read into memory that nobody has set to zero before.
  struct Block {
    std::unique_ptr<std::uint8_t[]> data;
    std::size_t size = 0;
    std::span<const std::uint8_t> bytes() const { return {data.get(), size}; }
  };

  static Result<Block> readAll(const std::filesystem::path& file, const std::string& place, std::size_t at_most);
  Result<Block> blockOf(const std::string& uri, const std::string& place, std::size_t at_most);
  void parse(std::span<const std::uint8_t> bytes);
  void splitBinary(std::span<const std::uint8_t> bytes);
  void loadBuffer(std::size_t index, std::span<const std::uint8_t> binary_chunk);
  std::span<const std::uint8_t> slice(const nlohmann::json& object, const std::string& place);
  void decodeMeshopt(std::size_t buffer_view, const nlohmann::json& extension, const std::string& place);
  Packed packed(std::size_t accessor, const std::string& asked_by);
  void takeDense(const nlohmann::json& json, const std::string& place, std::size_t element_size, Packed& out);
  void applySparse(const nlohmann::json& sparse, const std::string& place, std::size_t element_size, Packed& out);

  std::filesystem::path path_;
  nlohmann::json json_;
  std::vector<Block> blocks_;                           // the file, and what its buffers name
  std::vector<std::span<const std::uint8_t>> buffers_;  // in the blocks
  std::map<std::size_t, std::vector<std::uint8_t>> decoded_views_;
  std::size_t spent_ = 0;
  std::size_t allowance_ = 0;
  std::optional<Error> error_;
};

// A member of `object`, or null. Never throws.
const nlohmann::json& memberOf(const nlohmann::json& object, const char* key);

// "a%20b" → "a b"
std::string percentDecoded(std::string_view text);

}  // namespace standpoint

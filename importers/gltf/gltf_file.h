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

#include "core/result.h"
#include "importers/gltf/gltf_model.h"

namespace standpoint {

// A glTF 2.0 file, .gltf or .glb, with every index, offset and size checked where it is used, so that a wrong or
// hostile file ends in a message that names its place. The first fault is kept and every later answer is empty: callers
// test `failed()` where they would otherwise loop, and once at the end.
//
// tinygltf reads the JSON into its model. The JSON is parsed here once before, for the place of what is wrong with it,
// and put into a shape that tinygltf 2.7 reads whole (GltfShape). The buffers stay where they were read: tinygltf would
// copy them, and knows neither their limits nor compressed ones.
class GltfFile {
 public:
  explicit GltfFile(std::filesystem::path path) : path_(std::move(path)) {}

  void load();
  const tinygltf::Model& model() const { return model_; }
  const nlohmann::json& extensions() const { return extensions_; }  // of the file as a whole; null if it has none
  std::size_t animations() const { return animations_; }            // of which nothing is read, as of cameras
  std::size_t cameras() const { return cameras_; }
  std::size_t bytesLeft() const { return bytes_left_; }  // of a GLB, after those that its header states: not read

  bool failed() const { return error_.has_value(); }
  Result<void> whole() const { return error_ ? failure(*error_) : Result<void>(); }
  void fail(const std::string& place, std::string message, ErrorKind kind = ErrorKind::unusable);
  void fail(Error error);  // whose source is a place

  // Members of an object, each with the place of the object for the message. A missing one gives the fallback.
  std::size_t natural(const nlohmann::json& object, const char* key, std::size_t fallback, const std::string& place);
  std::optional<std::size_t> index(const nlohmann::json& object, const char* key, const std::string& place);
  std::vector<double> numbers(const nlohmann::json& object, const char* key, std::size_t count,
                              const std::string& place);
  std::string text(const nlohmann::json& object, const char* key) const;

  // Of one of the model's lists: its element, or a fault and an empty one where "/nodes/7" does not exist.
  template <class T>
  const T& element(const std::vector<T>& list, const char* name, std::size_t index, const std::string& asked_by) {
    static const T kNothing;
    if (index < list.size()) return list[index];
    fail(asked_by, "refers to /" + std::string(name) + "/" + std::to_string(index) + ", which does not exist");
    return kNothing;
  }

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
    int component_type = 0;
    std::size_t components = 0, count = 0;
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
  void loadBuffers(std::span<const std::uint8_t> binary_chunk);
  void loadBuffer(const nlohmann::json& json, const std::string& place, std::span<const std::uint8_t> binary_chunk);
  void readModel(nlohmann::json& json);
  std::span<const std::uint8_t> slice(std::optional<std::size_t> buffer, std::size_t offset, std::size_t length,
                                      const std::string& place);
  void decodeMeshopt(std::size_t buffer_view, const nlohmann::json& extension, const std::string& place);
  Packed packed(std::size_t accessor, const std::string& asked_by);
  void takeDense(const tinygltf::Accessor& accessor, const std::string& place, std::size_t element_size, Packed& out);
  void applySparse(const tinygltf::Accessor& accessor, const std::string& place, std::size_t element_size, Packed& out);

  std::filesystem::path path_;
  tinygltf::Model model_;
  nlohmann::json extensions_, buffers_json_;
  std::size_t animations_ = 0, cameras_ = 0, bytes_left_ = 0;
  std::vector<Block> blocks_;                           // the file, and what its buffers name
  std::vector<std::span<const std::uint8_t>> buffers_;  // in the blocks
  std::map<std::size_t, std::vector<std::uint8_t>> decoded_views_;
  std::size_t spent_ = 0;
  std::size_t allowance_ = 0;
  std::optional<Error> error_;
};

// tinygltf's −1 is no index.
inline std::optional<std::size_t> gltfIndex(int index) {
  return index < 0 ? std::nullopt : std::optional(static_cast<std::size_t>(index));
}

// "a%20b" → "a b"
std::string percentDecoded(std::string_view text);

}  // namespace standpoint

// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <functional>
#include <vector>

#include "importers/gltf/gltf_file.h"

namespace standpoint {

// The JSON of a file before tinygltf reads it. tinygltf 2.7 drops a primitive whose attributes it does not like and
// everything behind a child that is no index, wraps numbers beyond 32 bits, and refuses the whole file, without a
// place, for an image, an accessor or a camera that nobody needs. So each member that it reads is checked here, with
// its place, and what it would refuse is kept out of its sight and put back into its model.
class GltfShape {
 public:
  GltfShape(GltfFile& file, nlohmann::json& json) : file_(file), json_(json) {}

  // Faults go to the file.
  void check();
  void putBack(tinygltf::Model& model) const;

 private:
  using Json = nlohmann::json;

  bool affordable();
  void array(const char* name);
  void natural(Json& object, const char* key, const std::string& place, std::size_t most);
  void index(Json& object, const char* key, const std::string& place);
  void indices(Json& object, const char* key, const std::string& place);
  void allIndices(Json& object, const std::string& place);
  void numbers(Json& object, const char* key, std::size_t count, const std::string& place);
  void weights(Json& object);
  void accessor(Json& accessor, const std::string& place);
  void sparse(Json& sparse, const std::string& place);
  void bufferView(Json& view, std::size_t number, const std::string& place);
  void image(Json& image, std::size_t number, const std::string& place);
  void material(Json& material, const std::string& place);
  void mesh(Json& mesh, std::size_t number, const std::string& place);
  void primitive(Json& primitive, const std::string& place);
  void hideIndices(std::size_t mesh, std::size_t number, Json& primitive);
  void node(Json& node, const std::string& place);

  GltfFile& file_;
  Json& json_;
  std::vector<std::function<void(tinygltf::Model&)>> hidden_;
};

}  // namespace standpoint

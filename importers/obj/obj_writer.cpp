// SPDX-License-Identifier: GPL-3.0-or-later
#include "importers/obj/obj_writer.h"

#include <charconv>

#include "core/part_file.h"

namespace standpoint {

namespace {

// Shortest text that reads back as the same double.
void append(std::string& text, double value) {
  char buffer[32];
  const auto end = std::to_chars(buffer, buffer + sizeof buffer, value).ptr;
  text.append(buffer, end);
}

// A name is the rest of its line; a line's end or a comment sign within it would break the file.
std::string asName(std::string name, const std::string& fallback) {
  for (auto& c : name)
    if (static_cast<unsigned char>(c) < ' ' || c == '#' || c == '\\') c = '_';
  return name.empty() ? fallback : name;
}

std::string materialName(const Environment& environment, std::uint32_t surface) {
  const std::string number = std::to_string(surface);
  const auto& name = environment.surfaces[surface].name;
  for (std::uint32_t i = 0; i < surface; ++i)
    if (environment.surfaces[i].name == name) return asName(name, "surface") + "." + number;  // names are keys in MTL
  return asName(name, "surface." + number);
}

std::string materialsText(const Environment& environment, const std::vector<std::string>& names) {
  std::string text;
  for (std::size_t i = 0; i < names.size(); ++i) {
    const auto& s = environment.surfaces[i];
    text += "newmtl " + names[i] + "\nKd";
    for (const float c : {s.colour.r, s.colour.g, s.colour.b}) append(text += ' ', c);
    append(text += "\nd ", s.colour.a);
    if (s.metallic) append(text += "\nPm ", *s.metallic);
    if (s.roughness) append(text += "\nPr ", *s.roughness);
    text += "\n\n";
  }
  return text;
}

void appendInstance(const Environment& environment, const Instance& instance, const Eigen::Vector3d& shift,
                    const std::vector<std::string>& names, std::size_t first_vertex, std::string& text) {
  const Mesh& mesh = *environment.meshes[instance.mesh];
  for (const auto& p : mesh.positions) {
    const Eigen::Vector3d world = instance.world_from_mesh * p.cast<double>() + shift;
    text += 'v';
    for (int i = 0; i < 3; ++i) append(text += ' ', world[i]);
    text += '\n';
  }
  const bool mirrored = instance.world_from_mesh.linear().determinant() < 0;
  for (std::size_t i = 0; i < mesh.triangles.size(); ++i) {
    const auto surface = mesh.surface_of_triangle[i];
    if (i == 0 || mesh.surface_of_triangle[i - 1] != surface) text += "usemtl " + names[surface] + '\n';
    auto t = mesh.triangles[i];
    if (mirrored) std::swap(t[1], t[2]);
    text += 'f';
    for (const auto corner : t) text += ' ' + std::to_string(first_vertex + corner);
    text += '\n';
  }
}

}  // namespace

Result<void> writeEnvironmentObj(const Environment& environment, const Georeference& georeference,
                                 const std::filesystem::path& file, Progress& progress,
                                 const std::optional<std::string>& materials) {
  progress.stage("Writing OBJ");
  if (auto wrong = validate(environment); !wrong.empty()) return failure(ErrorKind::internal, wrong, file.string());
  auto mtl = file;
  mtl.replace_extension(".mtl");
  std::vector<std::string> names;
  for (std::uint32_t i = 0; i < environment.surfaces.size(); ++i) names.push_back(materialName(environment, i));
  TRY_ASSIGN(auto beside, PartFile::create(mtl));
  TRY(beside.append(materials ? *materials : materialsText(environment, names)));
  TRY_ASSIGN(auto out, PartFile::create(file));
  TRY(out.append("# metres, Z up (import with --up z)\nmtllib " + mtl.filename().string() + '\n'));
  std::size_t first_vertex = 1;
  for (std::size_t i = 0; i < environment.instances.size(); ++i) {
    const auto& instance = environment.instances[i];
    std::string text;
    if (i == 0 || environment.instances[i - 1].product != instance.product)
      text = "o " + asName(environment.products[instance.product].name, "product") + "." +
             std::to_string(instance.product) + '\n';
    appendInstance(environment, instance, georeference.shift_m, names, first_vertex, text);
    first_vertex += environment.meshes[instance.mesh]->positions.size();
    TRY(out.append(text));
    TRY(progress.check());
    progress.advance(static_cast<double>(i + 1) / static_cast<double>(environment.instances.size()));
  }
  TRY(beside.commit());
  return out.commit();
}

}  // namespace standpoint

// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdint>
#include <filesystem>
#include <memory>
#include <mutex>
#include <string>
#include <vector>

#include "project/storage/session.h"
#include "project/survey/scan_preparation.h"

namespace standpoint {

// A project of a script: its document and the ray scene of its scans stay in memory from verb to verb. Thread-safe;
// verbs of one project wait for each other.
class OpenProject {
 public:
  explicit OpenProject(std::filesystem::path folder) : folder_(std::move(folder)) {}

  const std::filesystem::path& folder() const { return folder_; }
  // As runOnDisk, of a verb that takes a project.
  Result<Outcome> run(const Verb& verb, nlohmann::json options, Progress& progress);
  Result<Document> document(Progress& progress);

 private:
  Result<Outcome> scan(const Document& document, const ScanVerbOptions& options, Progress& progress);

  std::filesystem::path folder_;
  std::mutex mutex_;
  KeptProject kept_;
  std::shared_ptr<const ScanPreparation> preparation_;
};

// The triangles of what is scanned, each product where it stands.
struct PlacedMesh {
  std::shared_ptr<const Environment> environment;
  std::vector<double> vertices;        // x, y, z of each, in the model's file frame, metres
  std::vector<std::uint32_t> faces;    // three vertices each, counter-clockwise seen from outside
  std::vector<std::uint32_t> product;  // of each face: index into environment->products
  std::vector<std::int32_t> material;  // of each face: index into materials; -1: none is assigned
  std::vector<std::string> materials;  // ids
};
PlacedMesh placedMesh(const Document& document);

}  // namespace standpoint

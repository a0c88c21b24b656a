// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdint>
#include <filesystem>
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include <Eigen/Core>

#include "editor/model/log.h"
#include "project/task.h"
#include "project/verb.h"

namespace standpoint {

// What the user says where the file is silent or wrong; empty = as the file says.
struct ImportOverrides {
  std::string unit, up;        // "mm", "z"
  std::string shift = "auto";  // auto, none, E,N,H
  std::string crs;             // EPSG:n
  bool types = false;          // IFC: types that no product shows become products
  bool operator==(const ImportOverrides&) const = default;
};
nlohmann::json importOptions(const std::vector<std::filesystem::path>& files, const ImportOverrides& overrides);

struct ClassCount {
  std::string ifc_class;
  std::size_t products = 0;
  std::uint64_t triangles = 0;
};

// What the preview says of a model that was read, but not taken in.
struct ImportFacts {
  std::vector<ClassCount> classes;        // most triangles first
  std::size_t products = 0;               // with those that have no geometry
  std::uint64_t triangles = 0;            // of the scene, as the model has them when it is taken in
  std::uint64_t triangles_of_spaces = 0;  // of what is not in the scene: spaces, annotations
  Bounds bounds_file_m;
  Eigen::Vector3d size_m = Eigen::Vector3d::Zero();
  std::size_t notes = 0, warnings = 0, losses = 0;
  std::string doubt;  // why the size looks wrong, and what to do; empty when it does not
};
ImportFacts factsOf(const Document& document, const Report& report);
// "12.40 × 8.10 × 6.35 m"
std::string sizeText(const Eigen::Vector3d& size_m);

// Models that are being looked at before they are taken in: one run of the import verb, whose result is a value that
// becomes the document when it is accepted, without another run.
class ImportPreview {
 public:
  enum class Stage { closed, reading, ready, failed };
  ~ImportPreview();

  // Starts reading. `verb` is import.
  void open(std::vector<std::filesystem::path> files, const Verb& verb, std::function<void()> wake);
  // As open(), with a result that is there already.
  void show(std::vector<std::filesystem::path> files, Outcome outcome);
  // Reads again when the overrides were changed; what was read before stays until then.
  void readAgain();
  void close();  // cancels what still reads, without waiting for it
  bool poll();   // once a frame; true when something came in
  void wait();
  Outcome take();  // only when ready; closes

  Stage stage() const { return stage_; }
  std::uint64_t closed() const { return closed_; }  // how often: what belongs to one preview ends with it
  bool isOpen() const { return stage_ != Stage::closed; }
  bool reading() const { return task_ != nullptr; }  // also when an earlier result is still shown
  bool changed() const { return !(overrides == read_with_); }
  const std::vector<std::filesystem::path>& files() const { return files_; }
  bool hasIfc() const;
  std::string fileNames() const;
  Task<Outcome>* task() const { return task_.get(); }
  const Outcome* outcome() const { return outcome_ ? &*outcome_ : nullptr; }
  const ImportFacts& facts() const { return facts_; }
  const std::vector<LogEntry>& issues() const { return issues_; }
  // Of the last reading, with an empty message when it went well. When only other overrides failed, what was read
  // before stays, and with it the overrides of then.
  const Error& error() const { return error_; }
  // Size with the first overrides, to be compared with what it is now; nothing while they are the first.
  const std::optional<Eigen::Vector3d>& firstSize_m() const { return first_size_m_; }

  ImportOverrides overrides;  // as the user edits them

 private:
  void start();
  Stage stage_ = Stage::closed;
  std::vector<std::filesystem::path> files_;
  const Verb* verb_ = nullptr;
  std::function<void()> wake_;
  std::unique_ptr<Task<Outcome>> task_;
  std::vector<std::unique_ptr<Task<Outcome>>> leaving_;  // cancelled, not yet done
  std::optional<Outcome> outcome_;
  ImportOverrides read_with_, outcome_with_;
  ImportFacts facts_;
  std::vector<LogEntry> issues_;
  Error error_;
  std::optional<Eigen::Vector3d> first_size_m_;
  Eigen::Vector3d size_at_first_m_ = Eigen::Vector3d::Zero();
  bool has_first_ = false;
  std::uint64_t closed_ = 0;
};

}  // namespace standpoint

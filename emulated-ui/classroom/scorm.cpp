// SPDX-License-Identifier: GPL-3.0-or-later
#include "emulated-ui/classroom/scorm.h"

#include <array>
#include <memory>
#include <vector>
#include <zip.h>

#include <fmt/format.h>

#include "core/data_folder.h"
#include "core/html_text.h"
#include "core/json_file.h"

namespace standpoint {

namespace {

using nlohmann::json;

struct PackedFile {
  std::string name, bytes;
};

constexpr std::array kPageFiles = {"index.html", "sco.js", "nacl-fast.min.js"};
constexpr std::uintmax_t kLargestPageFile = 1U << 20U;
constexpr std::time_t kTimeOfFiles = 1'600'000'000;  // the same bytes at any time

// No masteryscore: at its LMSFinish a system would pass or fail by the score alone, against a criterion that is
// required to pass. Without it the status that the page sets stays.
std::string manifest(const Assignment& a, const Exercise& exercise, const std::vector<PackedFile>& files) {
  const auto id = "standpoint." + a.id();
  const auto title = htmlText(a.id() + " " + exercise.title.in("en"));
  std::string listed;
  for (const auto& file : files) listed += fmt::format("      <file href=\"{}\"/>\n", file.name);
  return fmt::format(
      "<?xml version=\"1.0\" encoding=\"UTF-8\"?>\n"
      "<manifest identifier=\"{0}\" version=\"1.0\" xmlns=\"http://www.imsproject.org/xsd/imscp_rootv1p1p2\"\n"
      "  xmlns:adlcp=\"http://www.adlnet.org/xsd/adlcp_rootv1p2\">\n"
      "  <metadata>\n    <schema>ADL SCORM</schema>\n    <schemaversion>1.2</schemaversion>\n  </metadata>\n"
      "  <organizations default=\"exercise\">\n    <organization identifier=\"exercise\">\n      <title>{1}</title>\n"
      "      <item identifier=\"item\" identifierref=\"page\">\n        <title>{1}</title>\n      </item>\n"
      "    </organization>\n  </organizations>\n"
      "  <resources>\n    <resource identifier=\"page\" type=\"webcontent\" adlcp:scormtype=\"sco\" "
      "href=\"index.html\">\n{2}    </resource>\n  </resources>\n</manifest>\n",
      htmlText(id), title, listed);
}

// What the page checks a file against. Ids and user names are in it as hashes only.
std::string assignmentScript(const Assignment& a, const Exercise& exercise, const ClassList& list, bool graded) {
  json people = json::object();
  for (const auto& student : list.students) {
    const auto hash = studentHash(a.salt, student.id);
    const auto* variant = a.variantOf(student.id);
    if (variant == nullptr) continue;
    people[studentHash(a.salt, student.username)] = {{"student", hash}, {"seed", seedText(variant->seed)}};
  }
  const json data = {{"graded", graded},
                     {"hash", a.hash},
                     {"key", a.seal.key},
                     {"exercise", a.id()},
                     {"salt", a.salt},
                     {"deadline", a.deadline},
                     {"title", exercise.title.texts},
                     {"people", people}};
  return "var ASSIGNMENT = " + data.dump() + ";\n";
}

tl::unexpected<Error> zipFault(zip_error_t* error) {
  auto fault = failure(ErrorKind::internal, std::string("cannot make the package: ") + zip_error_strerror(error));
  zip_error_fini(error);
  return fault;
}

Result<std::string> zipped(const std::vector<PackedFile>& files) {
  zip_error_t error;
  zip_error_init(&error);
  zip_source_t* whole = zip_source_buffer_create(nullptr, 0, 0, &error);
  if (whole == nullptr) return zipFault(&error);
  zip_source_keep(whole);  // beyond the closing of the archive
  const std::unique_ptr<zip_source_t, void (*)(zip_source_t*)> kept(whole, zip_source_free);
  zip_t* archive = zip_open_from_source(whole, ZIP_TRUNCATE, &error);
  if (archive == nullptr) return zipFault(&error);
  for (const auto& file : files) {
    zip_source_t* source = zip_source_buffer(archive, file.bytes.data(), file.bytes.size(), 0);
    const auto index = source == nullptr ? -1 : zip_file_add(archive, file.name.c_str(), source, ZIP_FL_ENC_UTF_8);
    if (index < 0 || zip_file_set_mtime(archive, static_cast<zip_uint64_t>(index), kTimeOfFiles, 0) != 0) {
      auto fault = failure(ErrorKind::internal, std::string("cannot make the package: ") + zip_strerror(archive));
      if (index < 0 && source != nullptr) zip_source_free(source);
      zip_discard(archive);
      return fault;
    }
  }
  if (zip_close(archive) != 0) {
    auto fault = failure(ErrorKind::internal, std::string("cannot make the package: ") + zip_strerror(archive));
    zip_discard(archive);
    return fault;
  }
  zip_stat_t about;
  if (zip_source_stat(whole, &about) != 0 || zip_source_open(whole) != 0) return zipFault(zip_source_error(whole));
  std::string bytes(about.size, '\0');
  const auto read = zip_source_read(whole, bytes.data(), bytes.size());
  zip_source_close(whole);
  if (read != static_cast<zip_int64_t>(bytes.size())) return zipFault(zip_source_error(whole));
  return bytes;
}

}  // namespace

Result<std::string> scormPackage(const Assignment& assignment, const ClassList& list, bool graded) {
  TRY_ASSIGN(const auto exercise, assignment.exerciseWith(assignment.variants.front()));
  std::vector<PackedFile> files;
  for (const char* name : kPageFiles) {
    TRY_ASSIGN(auto bytes, readWholeFile(dataFolder() / "emulated-ui" / "classroom" / "sco" / name, kLargestPageFile));
    files.push_back({name, std::move(bytes)});
  }
  files.push_back({"assignment.js", assignmentScript(assignment, exercise, list, graded)});
  files.insert(files.begin(), {"imsmanifest.xml", manifest(assignment, exercise, files)});
  return zipped(files);
}

}  // namespace standpoint

// SPDX-License-Identifier: GPL-3.0-or-later
#include "emulated-ui/classroom/collect.h"

#include <algorithm>
#include <set>

#include <fmt/format.h>

#include "core/json_file.h"

namespace standpoint {

namespace {

namespace fs = std::filesystem;
using Verdict = Verification::Verdict;

constexpr std::size_t kMostFiles = 20000;

Result<std::vector<fs::path>> filesBelow(const fs::path& folder) {
  std::error_code error;
  if (!fs::is_directory(folder, error))
    return failure(ErrorKind::file_system, "is no folder; specify the folder with the results", folder.string());
  std::vector<fs::path> files;
  for (fs::recursive_directory_iterator entry(folder, fs::directory_options::skip_permission_denied, error), end;
       !error && entry != end; entry.increment(error)) {
    std::error_code ignored;
    if (entry->is_regular_file(ignored)) files.push_back(entry->path());
    if (files.size() > kMostFiles)
      return failure(ErrorKind::unusable,
                     fmt::format("holds more than {} files; choose the folder of this exercise", kMostFiles),
                     folder.string());
  }
  if (error) return failure(ErrorKind::file_system, "cannot be read: " + error.message(), folder.string());
  std::sort(files.begin(), files.end());
  return files;
}

// What any other program has put there is no fault; a result that cannot be read is.
std::optional<SignedResult> resultIn(const fs::path& file, const std::string& name, Report& report) {
  if (file.extension() != ".json") {
    report.note(name, "is no result; left alone");
    return std::nullopt;
  }
  auto result = readResult(file);
  if (result) return *std::move(result);
  const auto text = readWholeFile(file, kLargestJsonFile);
  if (text && text->find(kResultKind) != std::string::npos)
    report.warn(name, "cannot be read as a result: " + describe(result.error()));
  else
    report.note(name, "is no signed result; left alone");
  return std::nullopt;
}

void chooseCounted(std::vector<CollectedResult>& results) {
  std::map<std::string, std::vector<CollectedResult*>> verified;  // by student, in the order of time
  for (auto& r : results)
    if (r.verification.verified()) verified[r.result.student].push_back(&r);
  for (auto& [student, all] : verified) {
    all.front()->first = true;
    // The newest in time; else the newest.
    auto* best = all.back();
    for (auto* one : all)
      if (!one->late) best = one;
    best->counts = true;
  }
}

void sumUp(CollectedClass& c) {
  std::vector<const Marks*> first;
  std::map<std::string, std::size_t> mistakes;
  std::map<std::string, std::set<std::string>> students_of_key;
  for (const auto& r : c.results) {
    if (r.result.seal.intact()) students_of_key[r.result.seal.key].insert(r.result.student);
    if (r.first) first.push_back(&*r.verification.marks);
    if (!r.counts) continue;
    for (const auto& mistake : mistakesOf(*r.verification.marks)) ++mistakes[mistake];
    auto& [mean, count] = c.variant_means[r.result.seed];
    mean = (mean * static_cast<double>(count) + r.verification.marks->score) / static_cast<double>(count + 1);
    ++count;
  }
  c.statistics = statisticsOf(first);
  c.mistakes.assign(mistakes.begin(), mistakes.end());
  std::stable_sort(c.mistakes.begin(), c.mistakes.end(), [](auto& a, auto& b) { return a.second > b.second; });
  for (const auto& [key, students] : students_of_key)
    for (const auto& one : students)
      for (const auto& other : students)
        if (one != other) c.same_key[one].push_back(other);
}

}  // namespace

const CollectedResult* CollectedClass::of(const std::string& student) const {
  for (const auto& r : results)
    if (r.counts && r.result.student == student) return &r;
  return nullptr;
}

Result<CollectedClass> collectResults(const fs::path& folder, Assignment assignment, ClassList list,
                                      const std::string& language, Report& report, Progress& progress) {
  TRY_ASSIGN(const auto files, filesBelow(folder));
  CollectedClass c{std::move(assignment), std::move(list), {}, {}, {}, {}, {}};
  for (std::size_t i = 0; i < files.size(); ++i) {
    const auto name = fs::relative(files[i], folder).generic_string();
    const auto all = static_cast<double>(files.size());
    progress.stage("Verifying " + name, static_cast<double>(i) / all, static_cast<double>(i + 1) / all);
    TRY(progress.check());
    auto result = resultIn(files[i], name, report);
    if (!result) continue;
    TRY_ASSIGN(auto verification, verifyResult(*result, c.assignment, language, progress));
    if (verification.verdict != Verdict::unknown_student && c.list.find(result->student) == nullptr)
      verification = {
          Verdict::unknown_student, fmt::format("the class list has no student '{}'", result->student), {}, {}};
    if (!verification.verified()) report.lose(name, fmt::format("{}: {}", result->student, verification.why));
    const bool late = !c.assignment.deadline.empty() && result->finished > c.assignment.deadline;
    c.results.push_back({name, *std::move(result), std::move(verification), late, false, false});
  }
  const auto place = [&](const CollectedResult& r) {
    const auto* student = c.list.find(r.result.student);
    return student == nullptr ? c.list.students.size() : static_cast<std::size_t>(student - c.list.students.data());
  };
  std::stable_sort(c.results.begin(), c.results.end(), [&](const auto& a, const auto& b) {
    return std::pair(place(a), a.result.finished) < std::pair(place(b), b.result.finished);
  });
  chooseCounted(c.results);
  sumUp(c);
  return c;
}

std::string verifiedText(const CollectedResult& r) {
  if (r.verification.verified()) return r.late ? "yes, late" : "yes";
  return "no: " + r.verification.why;
}

}  // namespace standpoint

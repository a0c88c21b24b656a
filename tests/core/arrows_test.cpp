// SPDX-License-Identifier: GPL-3.0-or-later
// The picture in docs/architecture.md, as a test: every include between folders goes the way the arrows point.
#include <filesystem>
#include <fstream>
#include <map>
#include <regex>
#include <set>
#include <string>

#include <gtest/gtest.h>

namespace {

namespace fs = std::filesystem;
using Folders = std::set<std::string>;

const Folders kSiblings = {"importers", "materials", "optimizer", "scanners", "pointclouds"};

Folders with(Folders a, const Folders& b) {
  a.insert(b.begin(), b.end());
  return a;
}

const std::map<std::string, Folders>& allowed() {
  static const Folders siblings = with({"core"}, kSiblings);
  static const Folders below_doors = with(siblings, {"survey", "project"});
  static const std::map<std::string, Folders> table = {
      {"core", {}},
      {"importers", {"core"}},
      {"materials", {"core"}},
      {"optimizer", {"core"}},
      {"scanners", {"core"}},
      {"pointclouds", {"core"}},
      {"survey", siblings},
      {"project", with(siblings, {"survey"})},
      {"emulated-ui", below_doors},
      {"editor", with(below_doors, {"emulated-ui"})},
      {"cli", with(below_doors, {"emulated-ui"})},
      {"python", with(below_doors, {"emulated-ui"})},
  };
  return table;
}

template <class Visit>
void eachInclude(const fs::path& folder, const std::regex& pattern, Visit visit) {
  for (const auto& entry : fs::recursive_directory_iterator(folder)) {
    const auto extension = entry.path().extension();
    if (extension != ".h" && extension != ".cpp") continue;
    std::ifstream in(entry.path());
    std::smatch match;
    for (std::string line; std::getline(in, line);)
      if (std::regex_search(line, match, pattern)) visit(entry.path(), match[1].str());
  }
}

TEST(Arrows, EveryIncludeBetweenFoldersIsInThePicture) {
  const std::regex own(R"re(^\s*#\s*include\s*"([^"/]+)/)re");
  int seen = 0;
  for (const auto& [folder, may_see] : allowed())
    eachInclude(fs::path(SOURCE_DIR) / folder, own,
                [&, &folder = folder, &may_see = may_see](const fs::path& file, const std::string& to) {
                  if (!allowed().contains(to)) return;
                  ++seen;
                  EXPECT_TRUE(to == folder || may_see.contains(to)) << file << " includes " << to;
                });
  EXPECT_GT(seen, 20);
}

TEST(Arrows, GraphicsLibrariesAreSeenOnlyWhereTheDesignSaysSo) {
  const std::regex vtk(R"re(^\s*#\s*include\s*<((?:vtk|GL/|EGL/)[^>]*)>)re");
  const std::regex imgui(R"re(^\s*#\s*include\s*[<"]((?:imgui|backends/imgui)[^>"]*)[>"])re");
  for (const auto& [folder, unused] : allowed()) {
    eachInclude(fs::path(SOURCE_DIR) / folder, vtk, [&](const fs::path& file, const std::string& header) {
      EXPECT_NE(file.string().find("/editor/viewport/"), std::string::npos) << file << " includes " << header;
    });
    eachInclude(fs::path(SOURCE_DIR) / folder, imgui,
                [&, &folder = folder](const fs::path& file, const std::string& header) {
                  EXPECT_TRUE(folder == "editor" || folder == "emulated-ui") << file << " includes " << header;
                });
  }
}

// At every depth: rooms that include each other, directly or in a circle, are one room with a wall drawn through it.
TEST(Arrows, NoFoldersIncludeEachOtherNotEvenInACircle) {
  const std::regex own(R"re(^\s*#\s*include\s*"([^"]+)/[^"/]+")re");
  std::map<std::string, Folders> arrows;
  for (const auto& [folder, unused] : allowed())
    eachInclude(fs::path(SOURCE_DIR) / folder, own, [&](const fs::path& file, const std::string& to) {
      const std::string from = fs::relative(file.parent_path(), SOURCE_DIR).generic_string();
      if (to != from) arrows[from].insert(to);
    });
  EXPECT_GT(arrows.size(), 20U);
  for (bool shrunk = true; shrunk;) {  // what leads nowhere cannot be in a circle
    shrunk = false;
    for (auto it = arrows.begin(); it != arrows.end();) {
      std::erase_if(it->second, [&](const std::string& to) { return !arrows.contains(to); });
      shrunk |= it->second.empty();
      it = it->second.empty() ? arrows.erase(it) : std::next(it);
    }
  }
  for (const auto& [from, to] : arrows)
    for (const auto& folder : to) ADD_FAILURE() << from << " includes " << folder << ", which leads back to it";
}

}  // namespace

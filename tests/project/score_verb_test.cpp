// SPDX-License-Identifier: GPL-3.0-or-later
#include <array>
#include <cstdio>
#include <fstream>
#include <memory>
#include <optional>
#include <random>

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <stb/stb_image.h>

#include "pointclouds/datasets/label_array.h"
#include "pointclouds/scores/error_places.h"
#include "project/storage/project_files.h"
#include "tests/project/support.h"

namespace standpoint {
namespace {

using nlohmann::json;
using testing::HasSubstr;
namespace fs = std::filesystem;

std::string textIn(const fs::path& file) {
  std::ifstream in(file, std::ios::binary);
  return {std::istreambuf_iterator<char>(in), {}};
}

std::string arrayOf(const std::vector<std::uint16_t>& ids) {
  auto array = numpyHead("<u2", ids.size(), 1);
  for (const auto id : ids) array.append(reinterpret_cast<const char*>(&id), sizeof id);
  return array;
}

std::vector<std::uint16_t> idsIn(const fs::path& file) {
  Progress progress;
  const auto labels = readPointLabels(file, progress);
  EXPECT_TRUE(labels) << file;
  return labels ? std::vector<std::uint16_t>(labels->ids.begin(), labels->ids.end()) : std::vector<std::uint16_t>();
}

class Score : public testing::Test {
 protected:
  // none 0 (ignored), wall 1, floor 2, door 7, lamp 9.
  void SetUp() override {
    map =
        folder.write("own.json", R"({"name": "own", "classes": {"none": 0, "wall": 1, "floor": 2, "door": 7, "lamp": 9},
      "ignore": ["none"], "unknown": "none", "noise": "none", "ifc": {"IfcWall": "wall", "IfcSlab": "floor"}})");
  }
  Result<Outcome> score(const fs::path& truth, const fs::path& predicted, json more = json::object()) const {
    more["truth"] = truth.string();
    more["predicted"] = predicted.string();
    if (!more.contains("classes")) more["classes"] = map.string();
    if (more["classes"] == "") more.erase("classes");
    return run("score", {}, more);
  }
  // A set of one scan for training and one for a test.
  fs::path smallSet(const json& classes) const {
    Progress progress;
    for (const char* name : {"house", "tower"}) EXPECT_TRUE(saveProject(twoStoreyDocument(), folder / name, progress));
    const json recipe = {
        {"format", "standpoint-dataset"},
        {"recipe_version", 1},
        {"name", "demo"},
        {"license", "CC0-1.0"},
        {"creator", "somebody"},
        {"date", "2026-01-31"},
        {"environments", {{{"id", "house"}, {"project", "house"}}, {{"id", "tower"}, {"project", "tower"}}}},
        {"stations", {{{"strategy", "grid"}, {"spacing_m", 2}, {"count", 1}}}},
        {"instruments",
         {{{"id", "focus"},
           {"instrument", "faro-focus-s350"},
           {"set", {"resolution=1/32", "quality=4x", "horizontal_to=90"}}}}},
        {"splits", {{"train", {"house"}}, {"test", {"tower"}}}},
        {"classes", classes}};
    const auto made = run("dataset", {},
                          {{"action", "run"},
                           {"of", folder.write("recipe.json", recipe.dump()).string()},
                           {"output", (folder / "set").string()}});
    EXPECT_TRUE(made) << describe(made.error());
    return folder / "set";
  }
  TemporaryFolder folder;
  fs::path map;
};

const std::string kScan = "grid-1/focus_clear_assigned_none_1_noisy";

// By hand: walls 3 of 4 found, a door taken for a wall, one floor given up, one point without a truth; no lamps.
TEST_F(Score, IsThatOfAHandComputedExample) {
  const auto truth = folder.write("truth.npy", arrayOf({1, 1, 1, 1, 2, 2, 7, 0}));
  const auto predicted = folder.write("predicted.txt", "1\n1\n1\n2\n2\n0\n1\n1\n");
  const auto scored = score(truth, predicted);
  ASSERT_TRUE(scored) << describe(scored.error());
  const auto& a = scored->answer;
  EXPECT_EQ(a["map"], "own");
  EXPECT_EQ(a["points"], 7);
  EXPECT_EQ(a["ignored"], 1);
  EXPECT_EQ(a["given_up"], 1);
  EXPECT_EQ(a["confusion"], json({{3, 1, 0, 0, 0}, {0, 1, 0, 0, 1}, {1, 0, 0, 0, 0}, {0, 0, 0, 0, 0}}));
  EXPECT_DOUBLE_EQ(a["accuracy"], 4.0 / 7);
  EXPECT_DOUBLE_EQ(a["mean_iou"], (3.0 / 5 + 1.0 / 3 + 0) / 3);
  EXPECT_EQ(a["classes_in_mean"], 3) << "lamps are in neither";
  EXPECT_DOUBLE_EQ(a["mean_recall"], (3.0 / 4 + 1.0 / 2 + 0) / 3);
  const auto& wall = a["classes"][0];
  EXPECT_EQ(wall["class"], "wall");
  EXPECT_DOUBLE_EQ(wall["iou"], 3.0 / 5);
  EXPECT_DOUBLE_EQ(wall["precision"], 3.0 / 4);
  EXPECT_DOUBLE_EQ(wall["recall"], 3.0 / 4);
  EXPECT_TRUE(a["classes"][2]["precision"].is_null()) << "nothing was predicted to be a door";
  EXPECT_TRUE(a["classes"][3]["iou"].is_null());
  EXPECT_THAT(scored->description, HasSubstr("mean IoU 31.11 % of 3 classes, accuracy 57.14 %"));
}

TEST_F(Score, IsWrittenAsAPageATableAndFigures) {
  const auto truth = folder.write("truth.npy", arrayOf({1, 1, 1, 2})),
             predicted = folder.write("p.labels", "1\n1\n2\n0\n");
  for (const char* name : {"o.html", "o.csv", "o.json"}) {
    const auto scored = score(truth, predicted, {{"output", (folder / name).string()}});
    ASSERT_TRUE(scored) << describe(scored.error());
    if (name == std::string("o.json")) {
      EXPECT_EQ(json::parse(textIn(folder / name)), scored->answer);
    }
  }
  EXPECT_EQ(
      textIn(folder / "o.csv"),
      "class,id,truth,predicted,both,iou,precision,recall,\"as wall\",\"as floor\",\"as door\",\"as lamp\",as ignored\n"
      "\"wall\",1,3,2,2,0.6666666666666666,1,0.6666666666666666,2,1,0,0,0\n"
      "\"floor\",2,1,1,0,0,0,0,0,0,0,0,1\n"
      "\"door\",7,0,0,0,,,,0,0,0,0,0\n"
      "\"lamp\",9,0,0,0,,,,0,0,0,0,0\n");
  const auto page = textIn(folder / "o.html");
  EXPECT_THAT(page, HasSubstr("Mean IoU 33.33 % of 2 classes, accuracy 50.00 %, mean recall 33.33 %"));
  EXPECT_THAT(page, HasSubstr("<tr><td>1 wall<td class=\"n\" title=\"2\""));
  EXPECT_THAT(page, HasSubstr("66.7"));
  EXPECT_THAT(page, testing::Not(HasSubstr("<td>9 lamp"))) << "in neither: not in the matrix";
  const auto other = score(truth, predicted, {{"output", "o.pdf"}});
  ASSERT_FALSE(other);
  EXPECT_EQ(other.error().kind, ErrorKind::usage);
}

TEST_F(Score, RefusesLabelsByFileAndPlace) {
  const auto truth = folder.write("truth.npy", arrayOf({1, 0, 2}));
  const auto refused = [&](const fs::path& t, const fs::path& p) {
    const auto scored = score(t, p);
    EXPECT_FALSE(scored) << p;
    return scored ? std::string() : describe(scored.error());
  };
  EXPECT_THAT(refused(truth, folder.write("few.txt", "1\n2\n")),
              HasSubstr("few.txt: has labels of 2 points, and the truth"));
  EXPECT_THAT(refused(truth, folder.write("odd.npy", arrayOf({1, 5, 2}))),
              HasSubstr("odd.npy index 1: the label 5 is none of the classes of own"))
      << "also beside an ignored truth";
  EXPECT_THAT(refused(truth, folder.write("odd.txt", "1\n0\n-1\n")),
              HasSubstr("odd.txt line 3: the label is no number"));
  EXPECT_THAT(refused(folder.write("wrong.npy", arrayOf({1, 3, 2})), truth),
              HasSubstr("wrong.npy index 1: the label 3"));
  EXPECT_THAT(refused(truth, folder / "nowhere.npy"), HasSubstr("nowhere.npy"));
  EXPECT_THAT(refused(folder / "nowhere.npy", truth), HasSubstr("file not found"));
  EXPECT_THAT(refused(folder.write("none.npy", arrayOf({0, 0, 0})), truth), HasSubstr("no point has a class"));
  EXPECT_THAT(refused(folder.write("word.txt", "1\nwall\n"), truth), HasSubstr("word.txt line 2"));
}

TEST_F(Score, RefusesOptionsThatDoNotFit) {
  const auto labels = folder.write("truth.npy", arrayOf({1, 2}));
  const auto refused = [&](const fs::path& t, const json& more) {
    const auto scored = score(t, labels, more);
    EXPECT_FALSE(scored);
    return scored ? std::string() : describe(scored.error());
  };
  EXPECT_THAT(refused(labels, {{"classes", ""}}), HasSubstr("--classes: specify the classes"));
  EXPECT_THAT(refused(labels, {{"classes", "nobodys"}}), HasSubstr("unknown classes 'nobodys'"));
  EXPECT_THAT(refused(labels, {{"split", "test"}}), HasSubstr("--split: belongs to the folder of a set"));
  EXPECT_THAT(refused(folder.path(), {}), HasSubstr("the folder is no set"));
  const auto twins = folder.write("twins.json", R"({"name": "twins", "classes": {"a": 1, "b": 1}, "unknown": "a",
      "noise": "a", "ifc": {}})");
  EXPECT_THAT(refused(labels, {{"classes", twins.string()}}), HasSubstr("have the same id"));
}

TEST_F(Score, TakesTheTruthOfASimulatedCloudPointByPoint) {
  const auto set = smallSet({"s3dis"});
  const auto cloud = set / "scans/house" / (kScan + ".e57"), labels = set / "labels/house" / (kScan + ".s3dis.npy");
  const auto scored = score(cloud, labels, {{"classes", "s3dis"}});
  ASSERT_TRUE(scored) << describe(scored.error());
  EXPECT_GT(scored->answer["points"], 1000);
  EXPECT_EQ(scored->answer["accuracy"], 1) << "the set's labels are the truth of its cloud";
  const auto plain = folder.write("plain.xyz", "1 2 3\n4 5 6\n");
  const auto without = score(plain, labels, {{"classes", "s3dis"}});
  ASSERT_FALSE(without);
  EXPECT_THAT(describe(without.error()), HasSubstr("points have no labels"));
}

TEST_F(Score, IsOfAllPointsOfASetOrOfOneSplit) {
  const auto set = smallSet({"s3dis"});
  const auto mine = folder / "mine";
  for (const char* environment : {"house", "tower"}) {
    fs::create_directories(mine / environment / "grid-1");
    auto ids = idsIn(set / "labels" / environment / (kScan + ".s3dis.npy"));
    if (environment == std::string("tower")) std::replace(ids.begin(), ids.end(), 2, 1);  // its walls are floors
    std::ofstream(mine / environment / (kScan + ".npy"), std::ios::binary) << arrayOf(ids);
  }
  const auto all = score(set, mine, {{"classes", ""}});
  ASSERT_TRUE(all) << describe(all.error());
  EXPECT_EQ(all->answer["files"], 2);
  const auto train = score(set, mine, {{"classes", ""}, {"split", "train"}});
  ASSERT_TRUE(train) << describe(train.error());
  EXPECT_EQ(train->answer["accuracy"], 1);
  const auto test = score(set, mine, {{"classes", ""}, {"split", "test"}});
  ASSERT_TRUE(test) << describe(test.error());
  EXPECT_EQ(test->answer["classes"][2]["iou"], 0);
  const auto points = [](const Result<Outcome>& r) { return r->answer["points"].get<double>(); };
  EXPECT_EQ(points(all), points(train) + points(test));
  EXPECT_NEAR(all->answer["accuracy"].get<double>(),
              (points(train) + points(test) * test->answer["accuracy"].get<double>()) / points(all), 1e-12);
  const auto itself = score(set, set / "labels", {{"classes", ""}});
  ASSERT_TRUE(itself) << describe(itself.error());
  EXPECT_EQ(itself->answer["mean_iou"], 1) << "as the set names its own labels";

  const auto refused = [&](const fs::path& predicted, const json& more) {
    const auto scored = score(set, predicted, more);
    EXPECT_FALSE(scored);
    return scored ? std::string() : describe(scored.error());
  };
  EXPECT_THAT(refused(mine, {{"classes", "ifc"}}), HasSubstr("specify the classes of the set: s3dis"));
  EXPECT_THAT(refused(mine, {{"classes", ""}, {"split", "validation"}}), HasSubstr("no scans to score"));
  EXPECT_THAT(refused(map, {{"classes", ""}}), HasSubstr("must be in a folder"));
  std::ofstream(mine / "house" / (kScan + ".label")) << "";
  EXPECT_THAT(refused(mine, {{"classes", ""}}), HasSubstr("house/" + kScan + ": this scan has labels in two files"));
  fs::remove(mine / "house" / (kScan + ".label"));
  fs::resize_file(mine / "house" / (kScan + ".npy"), 200);
  EXPECT_THAT(refused(mine, {{"classes", ""}}), HasSubstr("mine/house/" + kScan + ".npy: cut short"));
  fs::remove(mine / "house" / (kScan + ".npy"));
  EXPECT_THAT(refused(mine, {{"classes", ""}}), HasSubstr("house/" + kScan + ": this scan has no labels"));
  fs::remove(set / "records/house" / (kScan + ".json"));
  const auto part = score(set, mine, {{"classes", ""}});
  ASSERT_TRUE(part) << describe(part.error());
  EXPECT_THAT(said(part->report), HasSubstr("not in the set and were not scored: 1"));
}

// A picture of a page, and where its pixels are that are neither white nor grey: fractions of its width (from the left)
// and its height (from below).
struct PagePicture {
  int width = 0, height = 0;
  double left = 1, right = 0, low = 1, high = 0;
  std::size_t coloured = 0;
};
std::vector<PagePicture> picturesIn(const std::string& page) {
  constexpr std::string_view kBegin = "href=\"data:image/png;base64,";
  constexpr std::string_view kDigits = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
  std::vector<PagePicture> pictures;
  for (auto at = page.find(kBegin); at != std::string::npos; at = page.find(kBegin, at)) {
    std::vector<stbi_uc> png;
    std::uint32_t bits = 0;
    int have = 0;
    for (at += kBegin.size(); kDigits.find(page[at]) != std::string_view::npos; ++at) {
      bits = bits << 6U | static_cast<std::uint32_t>(kDigits.find(page[at]));
      have += 6;
      if (have >= 8) png.push_back(static_cast<stbi_uc>(bits >> static_cast<unsigned>(have -= 8)));
    }
    PagePicture one;
    int channels = 0;
    const std::unique_ptr<stbi_uc, void (*)(void*)> rgb(
        stbi_load_from_memory(png.data(), static_cast<int>(png.size()), &one.width, &one.height, &channels, 3),
        stbi_image_free);
    EXPECT_TRUE(rgb);
    if (!rgb) return pictures;
    for (int y = 0; y < one.height; ++y)
      for (int x = 0; x < one.width; ++x) {
        const auto* p = rgb.get() + static_cast<std::ptrdiff_t>(3) * (y * one.width + x);
        if (p[0] == p[1] && p[1] == p[2]) continue;
        ++one.coloured;
        one.left = std::min(one.left, static_cast<double>(x) / one.width);
        one.right = std::max(one.right, static_cast<double>(x + 1) / one.width);
        one.low = std::min(one.low, 1 - static_cast<double>(y + 1) / one.height);
        one.high = std::max(one.high, 1 - static_cast<double>(y) / one.height);
      }
    pictures.push_back(one);
  }
  return pictures;
}

// A piece of a wall is taken for clutter.
TEST_F(Score, ShowsWhereABlockOfWrongPointsIs) {
  const auto set = smallSet({"s3dis"});
  const auto cloud = set / "scans/house" / (kScan + ".e57");
  auto ids = idsIn(set / "labels/house" / (kScan + ".s3dis.npy"));
  const auto truth = ids;
  Bounds all, block;
  std::uint64_t wrong = 0;
  Progress progress;
  constexpr std::uint16_t kWall = 2;
  std::optional<Eigen::Vector3d> middle;
  ASSERT_TRUE(forEachPlace(
      cloud,
      [&](const ScanHeader&, const Eigen::Vector3d& at, std::uint64_t k) {
        if (ids[k] == kWall && !middle) middle = at;
      },
      progress));
  ASSERT_TRUE(middle);
  ASSERT_TRUE(forEachPlace(
      cloud,
      [&](const ScanHeader&, const Eigen::Vector3d& at, std::uint64_t k) {
        all.extend(at);
        if (ids[k] != kWall || (at - *middle).cwiseAbs().maxCoeff() > 0.6) return;
        ids[k] = 12;  // clutter
        ++wrong;
        block.extend(at);
      },
      progress));
  ASSERT_GT(wrong, 100U);
  const auto predicted = folder.write("predicted.npy", arrayOf(ids)), page = folder / "o.html";
  const auto scored = score(cloud, predicted, {{"classes", "s3dis"}, {"output", page.string()}});
  ASSERT_TRUE(scored) << describe(scored.error());
  EXPECT_EQ(scored->answer["confusion"][2][12], wrong);
  const auto text = textIn(page);
  const auto pictures = picturesIn(text);
  ASSERT_EQ(pictures.size(), 6U) << "a plan, two elevations and the same of the one confusion";
  constexpr double kRim_m = 0.05;  // of the pictures around the cloud
  const auto fraction = [&](const Eigen::Vector3d& at, int axis) {
    return (at[axis] - all.min[axis] + kRim_m) / (all.max[axis] - all.min[axis] + 2 * kRim_m);
  };
  const std::array<std::array<int, 2>, 3> axes = {{{0, 1}, {0, 2}, {1, 2}}};
  for (std::size_t k = 0; k < axes.size(); ++k) {
    const auto& one = pictures[k];
    EXPECT_GT(one.coloured, 20U) << k;
    EXPECT_NEAR(one.left, fraction(block.min, axes[k][0]), 0.03) << k;
    EXPECT_NEAR(one.right, fraction(block.max, axes[k][0]), 0.03) << k;
    EXPECT_NEAR(one.low, fraction(block.min, axes[k][1]), 0.03) << k;
    EXPECT_NEAR(one.high, fraction(block.max, axes[k][1]), 0.03) << k;
  }
  EXPECT_THAT(text, HasSubstr("taken for clutter"));
  const auto place = text.find("<small>50000");  // of the densest of them, as it can be looked up
  ASSERT_NE(place, std::string::npos);
  double x = 0, y = 0, z = 0;
  ASSERT_EQ(std::sscanf(text.c_str() + place, "<small>%lf &nbsp; %lf &nbsp; %lf", &x, &y, &z), 3);
  for (const auto& [value, axis] : {std::pair(x, 0), std::pair(y, 1), std::pair(z, 2)}) {
    EXPECT_GE(value, block.min[axis] - 0.01);
    EXPECT_LE(value, block.max[axis] + 0.01);
  }
  ASSERT_TRUE(score(cloud, predicted, {{"classes", "s3dis"}, {"output", (folder / "again.html").string()}}));
  EXPECT_EQ(textIn(folder / "again.html"), text) << "the same bytes";
  ASSERT_TRUE(score(cloud, folder.write("right.npy", arrayOf(truth)),
                    {{"classes", "s3dis"}, {"output", (folder / "right.html").string()}}));
  EXPECT_THAT(textIn(folder / "right.html"), testing::Not(HasSubstr("Where the errors are")));
  EXPECT_THAT(textIn(folder / "right.html"), testing::Not(HasSubstr("<svg")));
}

TEST_F(Score, ShowsTheErrorsOfEachEnvironmentOfASetAndSaysWhatHasNoPlaces) {
  const auto set = smallSet({"s3dis"});
  const auto mine = folder / "mine";
  for (const char* environment : {"house", "tower"}) {
    fs::create_directories(mine / environment / "grid-1");
    auto ids = idsIn(set / "labels" / environment / (kScan + ".s3dis.npy"));
    if (environment == std::string("tower")) std::replace(ids.begin(), ids.end(), 2, 1);  // its walls are floors
    if (environment == std::string("house")) std::replace(ids.begin() + 100, ids.begin() + 200, 2, 1);
    std::ofstream(mine / environment / (kScan + ".npy"), std::ios::binary) << arrayOf(ids);
  }
  const auto page = folder / "o.html";
  ASSERT_TRUE(score(set, mine, {{"classes", ""}, {"output", page.string()}}));
  auto text = textIn(page);
  EXPECT_LT(text.find("<h3>tower</h3>"), text.find("<h3>house</h3>")) << "the worst first";
  EXPECT_EQ(picturesIn(text).size(), 9U);
  fs::remove(set / "scans/tower" / (kScan + ".e57"));
  const auto without = score(set, mine, {{"classes", ""}, {"output", page.string()}});
  ASSERT_TRUE(without) << describe(without.error());
  EXPECT_THAT(said(without->report), HasSubstr("clouds that are no longer there, without pictures of their errors: 1"));
  text = textIn(page);
  EXPECT_THAT(text, testing::Not(HasSubstr("<h3>tower</h3>")));
  const auto truth = folder.write("truth.npy", arrayOf({1, 1, 2})), predicted = folder.write("p.txt", "1\n2\n2\n");
  ASSERT_TRUE(score(truth, predicted, {{"output", page.string()}}));
  EXPECT_THAT(textIn(page), HasSubstr("the labels do not say where their points are"));
}

TEST_F(Score, AsksWhichOfTheClassesOfASet) {
  const auto set = smallSet({"s3dis", "ifc"});
  const auto unsaid = score(set, set / "labels", {{"classes", ""}});
  ASSERT_FALSE(unsaid);
  EXPECT_THAT(describe(unsaid.error()), HasSubstr("specify the classes of the set: s3dis, ifc"));
  const auto ifc = score(set, set / "labels", {{"classes", "ifc"}});
  ASSERT_TRUE(ifc) << describe(ifc.error());
  EXPECT_EQ(ifc->answer["accuracy"], 1);
}

std::string outputOf(const std::string& command) {
  const std::unique_ptr<std::FILE, int (*)(std::FILE*)> pipe(::popen((command + " 2>&1").c_str(), "r"), ::pclose);
  std::string text;
  std::array<char, 4096> piece;
  while (const std::size_t n = std::fread(piece.data(), 1, piece.size(), pipe.get())) text.append(piece.data(), n);
  return text;
}

// Ignored truth is taken away before; its own label list leaves the ignored class out, so that a point that was given
// up counts as missed.
TEST_F(Score, EqualsThatOfScikitLearn) {
  const std::string python = "/usr/bin/python3";
  if (outputOf(python + " -c 'import sklearn.metrics; print(1)'").find("1\n") != 0)
    GTEST_SKIP() << "python3-sklearn is not installed";
  folder.write("score.py",
               "import json, sys, numpy as np\n"
               "from sklearn import metrics as m\n"
               "y, p = np.load(sys.argv[1]), np.load(sys.argv[2])\n"
               "y, p = y[y != 0], p[y != 0]\n"
               "ids = [1, 2, 7]\n"
               "k = dict(labels=ids, average=None, zero_division=0)\n"
               "print(json.dumps(dict(\n"
               "  confusion=m.confusion_matrix(y, p, labels=ids + [0])[:3].tolist(),\n"
               "  iou=m.jaccard_score(y, p, **k).tolist(), precision=m.precision_score(y, p, **k).tolist(),\n"
               "  recall=m.recall_score(y, p, **k).tolist(), accuracy=m.accuracy_score(y, p))))\n");
  std::mt19937 random(7);
  std::vector<std::uint16_t> truth, predicted;
  const std::array<std::uint16_t, 4> ids = {0, 1, 2, 7};
  for (int i = 0; i < 100000; ++i) {
    truth.push_back(ids[random() % 4]);
    predicted.push_back(random() % 3 == 0 ? ids[random() % 4] : truth.back());
  }
  const auto t = folder.write("t.npy", arrayOf(truth)), p = folder.write("p.npy", arrayOf(predicted));
  const auto text = outputOf(python + " " + (folder / "score.py").string() + " " + t.string() + " " + p.string());
  const auto theirs = json::parse(text, nullptr, false);
  ASSERT_TRUE(theirs.is_object()) << text;
  const auto scored = score(t, p);
  ASSERT_TRUE(scored) << describe(scored.error());
  const auto& ours = scored->answer;
  EXPECT_EQ(ours["accuracy"], theirs["accuracy"]);
  double sum = 0;
  for (std::size_t k = 0; k < 3; ++k) {
    for (const char* figure : {"iou", "precision", "recall"}) EXPECT_EQ(ours["classes"][k][figure], theirs[figure][k]);
    sum += theirs["iou"][k].get<double>();
    const auto& row = ours["confusion"][k];  // with the lamps, which are nowhere
    EXPECT_EQ(json({row[0], row[1], row[2], row[4]}), theirs["confusion"][k]);
  }
  EXPECT_DOUBLE_EQ(ours["mean_iou"], sum / 3) << "of the classes that are somewhere";
}

// Class and instance of each point.
std::string pairsOf(const std::vector<std::array<std::uint16_t, 2>>& labels) {
  auto array = numpyHead("<u2", labels.size(), 2);
  for (const auto& one : labels) array.append(reinterpret_cast<const char*>(one.data()), sizeof one);
  return array;
}

// By hand: two walls of 200 points and one of 50. One prediction has 150 points of the first, one half of the second,
// one lies on points without a truth, and one has the small wall and 50 points of a floor.
TEST_F(Score, OfInstancesIsThatOfAHandComputedExample) {
  std::vector<std::array<std::uint16_t, 2>> truth, predicted;
  const auto add = [&](std::size_t points, std::array<std::uint16_t, 2> is, std::array<std::uint16_t, 2> taken_for) {
    truth.insert(truth.end(), points, is);
    predicted.insert(predicted.end(), points, taken_for);
  };
  add(150, {1, 1}, {1, 21});
  add(50, {1, 1}, {0, 0});
  add(100, {1, 2}, {1, 22});
  add(100, {1, 2}, {2, 0});
  add(120, {0, 0}, {1, 23});
  add(50, {1, 3}, {1, 24});
  add(50, {2, 9}, {1, 24});
  folder.write("p.confidence.txt", "21 0.9\n22 0.8\n23 0.7\n24 0.5\n");
  const auto scored = score(folder.write("t.npy", pairsOf(truth)), folder.write("p.npy", pairsOf(predicted)),
                            {{"output", (folder / "o.html").string()}});
  ASSERT_TRUE(scored) << describe(scored.error());
  const auto& wall = scored->answer["instances"][0];
  EXPECT_EQ(wall["truth"], 2) << "the third is too small";
  EXPECT_EQ(wall["predicted"], 4);
  EXPECT_DOUBLE_EQ(wall["ap_25"], 1);
  EXPECT_DOUBLE_EQ(wall["ap_50"], 0.5) << "half a wall is not more than half";
  EXPECT_DOUBLE_EQ(wall["ap"], 5 * 0.5 / 9) << "three quarters are enough up to 0.7";
  EXPECT_TRUE(scored->answer["instances"][1]["ap"].is_null()) << "no floor has 100 points";
  EXPECT_EQ(scored->answer["instance_ap_50"], 0.5);
  EXPECT_EQ(scored->answer["classes_in_instance_mean"], 1);
  EXPECT_THAT(textIn(folder / "o.html"), HasSubstr("Instances"));
  folder.write("p.confidence.txt", "21 0.9\n22 sure\n");
  const auto refused = score(folder / "t.npy", folder / "p.npy");
  ASSERT_FALSE(refused);
  EXPECT_THAT(refused.error().source, HasSubstr("p.confidence.txt line 2"));
  const auto without = score(folder.write("t2.npy", arrayOf({1, 2})), folder.write("p2.npy", arrayOf({1, 2})));
  ASSERT_TRUE(without);
  EXPECT_FALSE(without->answer.contains("instances")) << "nobody predicted one";
}

// One wall is no instance of the prediction.
TEST_F(Score, NamesAndShowsTheLargestMissedInstances) {
  const auto set = smallSet({"s3dis"});
  const auto cloud = set / "scans/house" / (kScan + ".e57");
  const auto ids = idsIn(set / "labels/house" / (kScan + ".s3dis.npy"));
  std::vector<std::array<std::uint16_t, 2>> predicted(ids.size());
  std::uint64_t missing = 0;
  Progress progress;
  const auto instances = readPointLabels(set / "labels/house" / (kScan + ".instances.npy"), progress);
  ASSERT_TRUE(instances) << describe(instances.error());
  ASSERT_TRUE(forEachPlace(
      cloud,
      [&](const ScanHeader& scan, const Eigen::Vector3d&, std::uint64_t k) {
        predicted[k] = {ids[k], static_cast<std::uint16_t>(instances->ids[k])};
        if (instances->ids[k] == 0 || scan.products[instances->ids[k] - 1].name != "south0") return;
        predicted[k][1] = 0;
        ++missing;
      },
      progress));
  ASSERT_GT(missing, 100U);
  const auto page = folder / "o.html";
  const auto scored = score(cloud, folder.write("predicted.npy", pairsOf(predicted)),
                            {{"classes", "s3dis"}, {"output", page.string()}});
  ASSERT_TRUE(scored) << describe(scored.error());
  EXPECT_EQ(scored->answer["accuracy"], 1) << "no class is wrong";
  const auto text = textIn(page);
  EXPECT_THAT(text, HasSubstr("Largest missed instances"));
  EXPECT_THAT(text, HasSubstr("<td>A<td>IfcWall south0<td>wall<td class=\"n\">"));
  EXPECT_THAT(text, testing::Not(HasSubstr("<td>B<td>")));
  const auto pictures = picturesIn(text);
  ASSERT_EQ(pictures.size(), 3U) << "of the wall: no class is wrong anywhere";
  EXPECT_GT(pictures[0].coloured, 20U);
}

// Written from the definition with masks of points, another way than ours.
TEST_F(Score, OfInstancesEqualsTheDefinitionInNumpy) {
  const std::string python = "/usr/bin/python3";
  if (outputOf(python + " -c 'import numpy; print(1)'").find("1\n") != 0)
    GTEST_SKIP() << "python3-numpy is not installed";
  folder.write("ap.py", R"(
import json, sys
import numpy as np
t, p = np.load(sys.argv[1]), np.load(sys.argv[2])
sure = {int(a): float(b) for a, b in (line.split() for line in open(sys.argv[3]))}
void = (t[:, 0] == 0) | (t[:, 1] == 0)

def masks(labels, c):
    of = labels[:, 0] == c
    return [(int(i), of & (labels[:, 1] == i)) for i in np.unique(labels[of, 1]) if i > 0]

def ap(c, least):
    small = [m for _, m in masks(t, c) if m.sum() < 100]
    truth = [m for _, m in masks(t, c) if m.sum() >= 100]
    found = [(sure.get(i, 1.0), m) for i, m in masks(p, c) if m.sum() >= 100]
    if not truth:
        return None
    if not found:
        return 0.0
    iou = np.array([[(a & m).sum() / (a | m).sum() for _, m in found] for a in truth])
    score, right, missed, used = [], [], 0, set()
    for row in iou:
        hits = [k for k in np.flatnonzero(row > least) if k not in used]
        if not hits:
            missed += 1
            continue
        used.add(hits[0])
        ranks = sorted((found[k][0] for k in hits), reverse=True)
        score += ranks
        right += [1] + [0] * (len(ranks) - 1)
    for k, (confidence, m) in enumerate(found):
        if (iou[:, k] > least).any():
            continue
        nothing = (m & void).sum() + sum((m & s).sum() for s in small)
        if nothing / m.sum() <= least:
            score.append(confidence)
            right.append(0)
    score, right = np.array(score), np.array(right)
    cuts = np.unique(score)
    precision = [right[score >= cut].sum() / (score >= cut).sum() for cut in cuts] + [1.0]
    recall = [right[score >= cut].sum() / (right.sum() + missed) for cut in cuts] + [0.0]
    return float(np.dot(precision, np.convolve([recall[0]] + recall + [0.0], [-0.5, 0, 0.5], 'valid')))

rows = []
for c in (1, 2, 7, 9):
    all_of = [ap(c, x) for x in (0.5, 0.55, 0.6, 0.65, 0.7, 0.75, 0.8, 0.85, 0.9)]
    rows.append([None if all_of[0] is None else float(np.mean(all_of)), all_of[0], ap(c, 0.25)])
print(json.dumps(rows))
)");
  for (const unsigned seed : {1U, 2U, 3U}) {
    std::mt19937 random(seed);
    std::vector<std::array<std::uint16_t, 2>> truth, predicted;
    const std::array<std::uint16_t, 4> ids = {0, 1, 2, 7};
    std::string sure;
    std::uint16_t number = 1;
    for (std::uint16_t instance = 1; instance < 120; ++instance) {
      const std::uint16_t is = ids[random() % 4];
      const std::size_t points = 40 + random() % 500;
      truth.insert(truth.end(), points, {is, static_cast<std::uint16_t>(random() % 9 == 0 ? 0 : instance)});
      const std::size_t cut = random() % 3 == 0 ? random() % points : points;  // one is found as two
      for (const std::size_t part : {cut, points - cut}) {
        const std::uint16_t taken_for = random() % 5 == 0 ? ids[random() % 4] : is;
        if (random() % 4 != 0) ++number;  // else its neighbour goes on
        predicted.insert(predicted.end(), part, {taken_for, number});
      }
    }
    for (std::uint16_t k = 1; k <= number; ++k)
      if (k % 10 != 0)
        sure += std::to_string(k) + " " + std::to_string(0.05 * static_cast<double>(random() % 20)) + "\n";
    const auto t = folder.write("t.npy", pairsOf(truth)), p = folder.write("p.npy", pairsOf(predicted)),
               c = folder.write("p.confidence.txt", sure);
    const auto text =
        outputOf(python + " " + (folder / "ap.py").string() + " " + t.string() + " " + p.string() + " " + c.string());
    const auto theirs = json::parse(text, nullptr, false);
    ASSERT_TRUE(theirs.is_array()) << text;
    const auto scored = score(t, p);
    ASSERT_TRUE(scored) << describe(scored.error());
    for (std::size_t k = 0; k < 4; ++k) {
      const auto& ours = scored->answer["instances"][k];
      if (theirs[k][0].is_null()) {
        EXPECT_TRUE(ours["ap"].is_null()) << k;
        continue;
      }
      EXPECT_GT(theirs[k][2], 0.1) << "a test of something";
      EXPECT_NEAR(ours["ap"].get<double>(), theirs[k][0].get<double>(), 1e-12) << seed << " " << k;
      EXPECT_NEAR(ours["ap_50"].get<double>(), theirs[k][1].get<double>(), 1e-12) << seed << " " << k;
      EXPECT_NEAR(ours["ap_25"].get<double>(), theirs[k][2].get<double>(), 1e-12) << seed << " " << k;
    }
  }
}

}  // namespace
}  // namespace standpoint

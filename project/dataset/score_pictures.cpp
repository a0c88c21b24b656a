// SPDX-License-Identifier: GPL-3.0-or-later
#include "project/dataset/score_pictures.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <optional>
#include <utility>

#include <fmt/format.h>

#include "core/number_text.h"
#include "core/report_html.h"
#include "pointclouds/scores/error_places.h"
#include "project/dataset/error_drawing.h"

namespace standpoint {

namespace {

constexpr std::size_t kScenes = 4, kConfusions = 6, kInstances = 4;  // that are shown at most
// Of a missed instance: points that its best prediction has, too; those that it lacks; those that it has beyond.
constexpr std::size_t kBoth = 0, kLacking = 1, kBeyond = 5;

struct Confusion {
  std::size_t truth = 0, predicted = 0;  // slots
  std::uint64_t points = 0;
  std::optional<DensestPlace::Place> place;
  std::size_t scene = 0;  // that it is in
};
struct Missed {
  MissedInstance instance;
  std::size_t scene = 0;
  std::string name;    // of its product
  PointSpread spread;  // of its points
};
// Pairs whose clouds are in one frame.
struct Scene {
  std::string name;
  std::vector<std::size_t> pairs;
  std::uint64_t wrong = 0;
};

class ErrorPictures {
 public:
  ErrorPictures(const ScoreAnswer& answer, ScoredLabels labels, Report& report)
      : answer_(answer), labels_(std::move(labels)), report_(report), others_(answer.classes.size()) {
    kept_of_ = labels_.pairs.size() - 1;
    for (std::size_t k = 0; k < answer.classes.size(); ++k) slot_of_id_[answer.classes[k].id] = k;
  }

  Result<std::string> html(Progress& progress) {
    progress.stage("Draw the errors");
    chooseConfusions();
    chooseInks();
    TRY(chooseScenes());
    const bool is_perfect = confusions_.empty() && missed_.empty();
    if (is_perfect) return std::string();
    std::string text = reportHeading("Where the errors are");
    if (scenes_.empty())
      return text + smallText(printed("No pictures: the labels do not say where their points are. Score against a "
                                      "cloud, or against a set that still has its clouds."));
    spreads_.resize(scenes_.size());
    for (std::size_t s = 0; s < scenes_.size(); ++s) TRY(find(s, progress));
    if (!inks_.empty()) text += legend();
    for (std::size_t s = 0; s < scenes_.size(); ++s) {
      TRY_ASSIGN(const auto scene, draw(s, progress));
      text += scene;
    }
    return text + confusionsHtml() + missedHtml();
  }

 private:
  std::string nameOf(std::size_t slot) const {
    return slot < others_ ? answer_.classes[slot].name : printed("an ignored class");
  }

  void chooseConfusions() {
    for (std::size_t row = 0; row < answer_.matrix.size(); ++row)
      for (std::size_t column = 0; column < answer_.matrix[row].size(); ++column)
        if (row != column && answer_.matrix[row][column] > 0)
          confusions_.push_back({row, column, answer_.matrix[row][column], {}, 0});
    std::stable_sort(confusions_.begin(), confusions_.end(),
                     [](const Confusion& a, const Confusion& b) { return a.points > b.points; });
    if (confusions_.size() > kConfusions) confusions_.resize(kConfusions);
  }

  // The classes that most wrong points were taken for have a colour of their own.
  void chooseInks() {
    std::vector<std::pair<std::uint64_t, std::size_t>> wrong;
    for (std::size_t column = 0; column <= others_; ++column) {
      std::uint64_t points = 0;
      for (std::size_t row = 0; row < answer_.matrix.size(); ++row)
        if (row != column) points += answer_.matrix[row][column];
      if (points > 0) wrong.emplace_back(points, column);
    }
    std::stable_sort(wrong.begin(), wrong.end(), [](const auto& a, const auto& b) { return a.first > b.first; });
    ink_of_slot_.assign(others_ + 1, kInks.size() - 1);  // the last one is of all other classes
    const auto own = wrong.size() <= kInks.size() ? wrong.size() : kInks.size() - 1;
    for (std::size_t k = 0; k < own; ++k) {
      ink_of_slot_[wrong[k].second] = k;
      inks_.emplace_back(kInks[k], nameOf(wrong[k].second));
    }
    if (own < wrong.size()) inks_.emplace_back(kInks.back(), printed("other classes"));
  }

  Result<void> chooseScenes() {
    std::size_t without = 0;
    for (std::size_t k = 0; k < labels_.pairs.size(); ++k) {
      const auto& pair = labels_.pairs[k];
      std::error_code error;
      if (pair.cloud.empty() || !std::filesystem::exists(pair.cloud, error)) {
        without += pair.cloud.empty() ? 0 : 1;
        continue;
      }
      auto at = std::find_if(scenes_.begin(), scenes_.end(), [&](const Scene& s) { return s.name == pair.scene; });
      if (at == scenes_.end()) at = scenes_.insert(at, {pair.scene, {}, 0});
      at->pairs.push_back(k);
      at->wrong += labels_.wrong[k];
    }
    if (without > 0)
      report_.note(answer_.truth.string(),
                   fmt::format("clouds that are no longer there, without pictures of their errors: {}", without));
    found_scenes_ = scenes_.size();
    std::stable_sort(scenes_.begin(), scenes_.end(), [](const Scene& a, const Scene& b) { return a.wrong > b.wrong; });
    if (scenes_.size() > kScenes) scenes_.erase(scenes_.begin() + kScenes, scenes_.end());
    if (labels_.instances == nullptr) return {};
    const auto sceneOfPair = [&](std::size_t pair) {
      return static_cast<std::size_t>(std::find_if(scenes_.begin(), scenes_.end(),
                                                   [&](const Scene& s) {
                                                     return std::find(s.pairs.begin(), s.pairs.end(), pair) !=
                                                            s.pairs.end();
                                                   }) -
                                      scenes_.begin());
    };
    const auto isShown = [&](std::size_t pair) { return scenes_.empty() || sceneOfPair(pair) < scenes_.size(); };
    for (const auto& one : labels_.instances->missed(kInstances, isShown))
      missed_.push_back({one, sceneOfPair(one.scene), {}, {}});
    return {};
  }

  // A point as the pictures see it.
  struct Judged {
    const ScanHeader& scan;
    const Eigen::Vector3d& at;
    std::size_t truth = 0, predicted = 0;  // slots
    std::uint32_t id = 0, instance = 0, predicted_id = 0, predicted_instance = 0;
    bool isWrong() const { return truth != predicted; }
  };
  // Those that are scored.
  template <class Take>
  Result<void> eachOf(std::size_t pair, const Take& take, Progress& progress) {
    if (kept_of_ != pair) {
      labels_.last = {};
      TRY_ASSIGN(labels_.last, readPair(labels_.pairs[pair], labels_.map, progress));
      kept_of_ = pair;
    }
    const auto &truth = labels_.last.truth, &predicted = labels_.last.predicted;
    const auto slot = [&](std::uint32_t id) {
      const auto at = slot_of_id_.find(id);
      return at == slot_of_id_.end() ? others_ : at->second;
    };
    const auto points = truth.ids.size();
    const auto& cloud = labels_.pairs[pair].cloud;
    const TakePlace judge = [&](const ScanHeader& scan, const Eigen::Vector3d& at, std::uint64_t k) {
      if (k >= points) return;
      const Judged point{scan,
                         at,
                         slot(truth.ids[k]),
                         slot(predicted.ids[k]),
                         truth.ids[k],
                         truth.instances[k],
                         predicted.ids[k],
                         predicted.instances[k]};
      if (point.truth != others_) take(point);
    };
    TRY_ASSIGN(const auto read, forEachPlace(cloud, judge, progress));
    if (read != points)
      return failure(ErrorKind::unusable, "has another number of points than the labels beside it; verify the set",
                     cloud.string());
    return {};
  }

  static bool isOf(const Judged& point, const MissedInstance& one) {
    return point.id == one.id && point.instance == one.instance;
  }

  // How far the points of a scene reach, and where its errors are the densest.
  Result<void> find(std::size_t scene, Progress& progress) {
    std::vector<DensestPlace> places(confusions_.size());
    std::vector<std::size_t> confusion_at((others_ + 1) * (others_ + 1), confusions_.size());
    for (std::size_t c = 0; c < confusions_.size(); ++c)
      confusion_at[confusions_[c].truth * (others_ + 1) + confusions_[c].predicted] = c;
    for (const auto pair : scenes_[scene].pairs) {
      std::vector<Missed*> missed;
      for (auto& one : missed_)
        if (one.instance.scene == pair) missed.push_back(&one);
      TRY(eachOf(
          pair,
          [&](const Judged& point) {
            spreads_[scene].add(point.at);
            const auto c = confusion_at[point.truth * (others_ + 1) + point.predicted];
            if (c < confusions_.size()) places[c].add(point.at);
            for (auto* one : missed) {
              if (!isOf(point, one->instance)) continue;
              if (one->spread.points() == 0 && point.instance <= point.scan.products.size()) {
                const auto& product = point.scan.products[point.instance - 1];
                one->name = fmt::format("{} {}", product.ifc_class, product.name.empty() ? product.id : product.name);
              }
              one->spread.add(point.at);
            }
          },
          progress));
    }
    for (std::size_t c = 0; c < confusions_.size(); ++c) {
      const auto place = places[c].place();
      if (!place || (confusions_[c].place && confusions_[c].place->points >= place->points)) continue;
      confusions_[c].place = place;
      confusions_[c].scene = scene;
    }
    return {};
  }

  Result<std::string> draw(std::size_t scene, Progress& progress) {
    constexpr double kLeast_m = 4;
    const auto& spread = spreads_[scene];
    if (spread.points() == 0) return std::string();
    const Bounds box = boxAround(spread);
    auto views = viewsOf(box, spread.points(), 480);
    std::vector<std::optional<CloseUp>> closer(confusions_.size()), of_missed(missed_.size());
    for (std::size_t c = 0; c < confusions_.size(); ++c)
      if (const auto& place = confusions_[c].place; place && confusions_[c].scene == scene)
        closer[c].emplace(cubeAround(place->at_m, std::max(kLeast_m, place->edge_m)), 40 * place->points);
    for (std::size_t m = 0; m < missed_.size(); ++m) {
      const auto& one = missed_[m];
      if (one.scene != scene || one.spread.points() == 0) continue;
      const auto around = one.spread.without(0.01);
      of_missed[m].emplace(
          cubeAround((around.min + around.max) / 2, 1.3 * std::max(1.0, (around.max - around.min).maxCoeff())),
          20 * one.instance.points);
    }
    std::uint64_t outside = 0, wrong_outside = 0;
    for (const auto pair : scenes_[scene].pairs)
      TRY(eachOf(
          pair,
          [&](const Judged& point) {
            const auto ink = point.isWrong() ? std::optional(ink_of_slot_[point.predicted]) : std::nullopt;
            for (auto& view : views) ink ? view.addWrong(point.at, *ink) : view.addRight(point.at);
            const bool is_outside = !isIn(box, point.at);
            outside += is_outside ? 1 : 0;
            wrong_outside += is_outside && point.isWrong() ? 1 : 0;
            for (std::size_t c = 0; c < closer.size(); ++c) {
              if (!closer[c] || !closer[c]->has(point.at)) continue;
              closer[c]->add(point.at, ink);
              closer[c]->shown += point.truth == confusions_[c].truth && point.predicted == confusions_[c].predicted;
            }
            for (std::size_t m = 0; m < of_missed.size(); ++m)
              if (of_missed[m] && missed_[m].instance.scene == pair) addToMissed(point, missed_[m], *of_missed[m]);
          },
          progress));
    for (std::size_t c = 0; c < closer.size(); ++c)
      if (closer[c]) confusion_rows_[c] = rowOf(confusions_[c], *closer[c]);
    for (std::size_t m = 0; m < of_missed.size(); ++m)
      if (of_missed[m]) missed_pictures_[m] = of_missed[m]->svg();
    return scenes_[scene].wrong == 0 ? "" : sceneHtml(scene, views, outside, wrong_outside);
  }

  static void addToMissed(const Judged& point, const Missed& missed, CloseUp& picture) {
    if (!picture.has(point.at)) return;
    const auto& one = missed.instance;
    const bool is_it = isOf(point, one);
    const bool is_predicted = one.iou > 0 && point.predicted_id == one.id && point.predicted_instance == one.prediction;
    picture.shown += is_it ? 1 : 0;
    picture.add(point.at, is_it && is_predicted ? std::optional(kBoth)
                          : is_it               ? std::optional(kLacking)
                          : is_predicted        ? std::optional(kBeyond)
                                                : std::nullopt);
  }

  std::string legend() const {
    std::vector<std::pair<Rgb, std::string>> entries = {{kInkOfRight, printed("right")}};
    for (const auto& [colour, name] : inks_) entries.emplace_back(colour, printedf("taken for {}", name));
    return legendOf(entries) +
           smallText(
               printed("Points that are wrong have the colour of the class that they were taken for, the stronger "
                       "the more of the points there are wrong. Coordinates are in metres, in the frame of the "
                       "cloud's file; the numbers are those of the close-ups below.")) +
           (found_scenes_ > scenes_.size()
                ? smallText(printedf("The {} of {} environments with the most wrong points are shown.", scenes_.size(),
                                     found_scenes_))
                : "");
  }

  std::string sceneHtml(std::size_t scene, const std::vector<ErrorView>& views, std::uint64_t outside,
                        std::uint64_t wrong_outside) const {
    std::string text = scenes_[scene].name.empty() ? "" : "<h3>" + htmlText(scenes_[scene].name) + "</h3>\n";
    std::vector<PlaceMark> marks;
    for (std::size_t c = 0; c < confusions_.size(); ++c)
      if (confusions_[c].place && confusions_[c].scene == scene)
        marks.push_back({std::to_string(c + 1), confusions_[c].place->at_m});
    text += largeViews(views, marks);
    if (outside > 0)
      text += smallText(printedf("{} of {} points lie far off and are not in these pictures; {} of them are wrong.",
                                 groupedDigits(outside), groupedDigits(spreads_[scene].points()),
                                 groupedDigits(wrong_outside)));
    return text;
  }

  std::string placeText(const Eigen::Vector3d& at) const {
    return fmt::format("<small>{:.2f} &nbsp; {:.2f} &nbsp; {:.2f}</small>", at.x(), at.y(), at.z());
  }
  std::string sceneCell(std::size_t scene) const {
    return scenes_[scene].name.empty() ? "" : htmlText(scenes_[scene].name) + "<br>";
  }

  struct ConfusionRow {
    std::string cells, picture;
  };
  ConfusionRow rowOf(const Confusion& one, const CloseUp& picture) const {
    return {fmt::format("{}<td>{}<td class=\"n\">{}<td class=\"n\">{}<td>{}{}</tr>\n", htmlText(nameOf(one.truth)),
                        htmlText(nameOf(one.predicted)), groupedDigits(one.points), groupedDigits(picture.shown),
                        sceneCell(one.scene), placeText(one.place->at_m)),
            picture.svg()};
  }

  std::string confusionsHtml() const {
    if (confusion_rows_.empty()) return "";
    std::string text = reportHeading("Most frequent confusions") +
                       reportTable({{"No."},
                                    {"True class"},
                                    {"Taken for"},
                                    {"Points", true},
                                    {"of these in the picture", true},
                                    {"Where most are together (m, frame of the cloud's file)"}});
    for (const auto& [c, row] : confusion_rows_) text += fmt::format("<tr><td>{}<td>{}", c + 1, row.cells);
    text += "</table>\n";
    for (const auto& [c, row] : confusion_rows_)
      text +=
          fmt::format(
              "<p><b>{}</b> {}</p>\n", c + 1,
              htmlText(printedf("{} taken for {}", nameOf(confusions_[c].truth), nameOf(confusions_[c].predicted)))) +
          row.picture;
    return text;
  }

  std::string missedHtml() const {
    if (missed_pictures_.empty()) return "";
    std::string text = reportHeading("Largest missed instances") +
                       legendOf({{kInks[kBoth], printed("found")},
                                 {kInks[kLacking], printed("missed")},
                                 {kInks[kBeyond], printed("too much")}}) +
                       smallText(printed("Instances that no prediction of their class matches with an IoU of more than "
                                         "50 %, beside the prediction that matches best.")) +
                       reportTable({{"No."},
                                    {"Instance"},
                                    {"Class"},
                                    {"Points", true},
                                    {"Best IoU, %", true},
                                    {"Middle (m, frame of the cloud's file)"}});
    for (const auto& [m, picture] : missed_pictures_) {
      const auto& one = missed_[m];
      const auto box = one.spread.without(0.01);
      text += fmt::format("<tr><td>{}<td>{}<td>{}<td class=\"n\">{}<td class=\"n\">{:.1f}<td>{}{}</tr>\n", letterOf(m),
                          htmlText(one.name), htmlText(nameOf(slot_of_id_.at(one.instance.id))),
                          groupedDigits(one.instance.points), 100 * one.instance.iou, sceneCell(one.scene),
                          placeText((box.min + box.max) / 2));
    }
    text += "</table>\n";
    for (const auto& [m, picture] : missed_pictures_)
      text += fmt::format("<p><b>{}</b> {}</p>\n", letterOf(m), htmlText(missed_[m].name)) + picture;
    return text;
  }
  static char letterOf(std::size_t m) { return static_cast<char>('A' + static_cast<char>(m)); }

  const ScoreAnswer& answer_;
  ScoredLabels labels_;
  Report& report_;
  std::size_t others_;  // the slot of all classes that are not scored
  std::map<std::uint32_t, std::size_t> slot_of_id_;
  std::vector<std::size_t> ink_of_slot_;
  std::vector<std::pair<Rgb, std::string>> inks_;  // and what they stand for
  std::vector<Confusion> confusions_;
  std::vector<Missed> missed_;
  std::vector<Scene> scenes_;  // that are shown
  std::size_t found_scenes_ = 0;
  std::vector<PointSpread> spreads_;  // of each scene
  std::map<std::size_t, ConfusionRow> confusion_rows_;
  std::map<std::size_t, std::string> missed_pictures_;
  std::size_t kept_of_ = 0;  // the pair of labels_.last
};

}  // namespace

Result<std::string> picturesOfErrors(const ScoreAnswer& answer, ScoredLabels labels, Report& report,
                                     Progress& progress) {
  return ErrorPictures(answer, std::move(labels), report).html(progress);
}

}  // namespace standpoint

// SPDX-License-Identifier: GPL-3.0-or-later
#include <array>
#include <map>

#include <fmt/format.h>

#include "core/csv_text.h"
#include "core/number_text.h"
#include "core/part_file.h"
#include "core/report_html.h"
#include "pointclouds/scores/cleaning_scores.h"
#include "project/dataset/cleaning_score.h"
#include "project/dataset/error_drawing.h"
#include "project/dataset/share_text.h"

namespace standpoint {

namespace {

constexpr const char* kCleaningStyle = "svg.e{max-height:none;border:none}\n";

std::string countCells(std::uint64_t in, std::uint64_t removed) {
  return fmt::format("<td class=\"n\">{}<td class=\"n\">{}", groupedDigits(in), groupedDigits(removed));
}

// Why a point should go, in the words of the page.
const std::map<std::string, const char*>& causeWords() {
  static const std::map<std::string, const char*> words = {{"mixed", "mixed"},
                                                           {"mirrored", "mirrored or seen by a detour"},
                                                           {"weather", "rain, snow, fog or dust"},
                                                           {"moving", "moving"},
                                                           {"noise", "noise without a surface"}};
  return words;
}

std::string causesHtml(const CleaningAnswer& answer) {
  std::string text =
      reportHeading("What should go") +
      reportTable(
          {{"Cause"}, {"Points", true}, {"Removed", true}, {"Recall, %", true}, {"Of all that was removed, %", true}});
  const auto row = [&](const std::string& name, const CleanCause& c) {
    text += "<tr><td>" + htmlText(name) + countCells(c.in, c.removed) + shareCell(c.recall) + shareCell(c.precision) +
            "</tr>\n";
  };
  for (const auto& [flag, name] : causeWords())
    if (const auto& cause = answer.causes.at(flag); cause.in > 0) row(printed(name), cause);
  const auto& plainly = answer.plainly_mixed;
  if (plainly.in > 0) row(printed("mixed, more than 1 cm off"), {plainly.in, plainly.removed, plainly.fraction, {}});
  row(printed("All"), answer.flawed);
  return text + "</table>\n" +
         smallText(printed("A point can have several causes. Most mixed points are so near to a surface that no "
                           "program finds them, and they do no harm."));
}

std::string classesHtml(const CleaningAnswer& answer) {
  if (answer.classes.empty()) return "";
  std::string text = reportHeading("Good points that were lost") + reportTable({{"Class"},
                                                                                {"Good points", true},
                                                                                {"Lost", true},
                                                                                {"Lost, %", true},
                                                                                {"Points that should go", true},
                                                                                {"Removed", true},
                                                                                {"Recall, %", true}});
  for (const auto& c : answer.classes)
    text += "<tr><td>" + htmlText(c.name) + countCells(c.good.in, c.good.removed) + shareCell(c.good.fraction) +
            countCells(c.flawed.in, c.flawed.removed) + shareCell(c.flawed.fraction) + "</tr>\n";
  return text + "</table>\n";
}

std::string moversHtml(const CleaningAnswer& answer) {
  if (answer.movers.empty()) return "";
  std::string text =
      reportHeading("What moved") + reportTable({{"Mover"}, {"Points", true}, {"Removed", true}, {"Recall, %", true}});
  for (const auto& m : answer.movers)
    text += "<tr><td>" + htmlText(m.name.empty() ? m.id : m.name) + countCells(m.points.in, m.points.removed) +
            shareCell(m.points.fraction) + "</tr>\n";
  return text + "</table>\n";
}

std::string cleaningPage(const CleaningAnswer& a, const std::string& pictures) {
  std::string text = reportBeginning(htmlText(printedf("Cleaning of {}", a.truth.filename().string())), kCleaningStyle);
  text +=
      "<p class=\"verdict\">" +
      htmlText(printedf("Removed {} of what should go; lost {} of the good points; {} of what was removed should go",
                        shareText(a.flawed.recall), shareText(a.good.fraction), shareText(a.flawed.precision))) +
      "</p>\n<p>" +
      htmlText(printedf("Cleaned cloud: {}, {} points. Truth: {}, {} points, of which {} were removed.",
                        a.cleaned.string(), groupedDigits(a.cleaned_points), a.truth.string(), groupedDigits(a.points),
                        groupedDigits(a.removed))) +
      "</p>\n";
  if (a.thinned)
    text +=
        "<p>" +
        htmlText(printedf("{} more are not in the cleaned cloud, but others of their kind close by: it was thinned.",
                          groupedDigits(*a.thinned))) +
        "</p>\n";
  if (a.doubled + a.unknown > 0)
    text += "<p>" +
            htmlText(printedf("The cleaned cloud has {} points where the truth has none, and {} more often than the "
                              "truth has them; they do not count.",
                              groupedDigits(a.unknown), groupedDigits(a.doubled))) +
            "</p>\n";
  return text + causesHtml(a) + moversHtml(a) + classesHtml(a) + pictures + "</body></html>\n";
}

std::string cleaningTable(const CleaningAnswer& a) {
  std::string text = "counted,name,points,removed\n";
  const auto line = [&](const char* what, const std::string& name, std::uint64_t in, std::uint64_t removed) {
    text += fmt::format("{},{},{},{}\n", what, csvText(name), in, removed);
  };
  line("all", "", a.points, a.removed);
  line("flawed", "", a.flawed.in, a.flawed.removed);
  line("good", "", a.good.in, a.good.removed);
  for (const auto& [flag, c] : a.causes) line("cause", flag, c.in, c.removed);
  line("cause", "mixed by over 1 cm", a.plainly_mixed.in, a.plainly_mixed.removed);
  for (const auto& m : a.movers) line("mover", m.name, m.points.in, m.points.removed);
  for (const auto& c : a.classes) line("good of class", c.name, c.good.in, c.good.removed);
  for (const auto& c : a.classes) line("flawed of class", c.name, c.flawed.in, c.flawed.removed);
  return text;
}

// What a picture tells of a point; beside these it is right.
enum Wrong : std::size_t { kLost = 0, kLeft = 1 };

struct WrongPlace {
  DensestPlace places;
  std::optional<DensestPlace::Place> place;
  std::optional<CloseUp> picture;
};

}  // namespace

Result<std::string> picturesOfCleaning(const CleaningAnswer& answer, const std::vector<std::uint8_t>& kept,
                                       Progress& progress) {
  constexpr double kLeast_m = 4;
  if (answer.good.removed == 0 && answer.flawed.removed == answer.flawed.in) return std::string();
  const auto wrongOf = [](const CleanedPoint& point) {
    return point.is_flawed == point.is_removed ? std::nullopt
                                               : std::optional<std::size_t>(point.is_flawed ? kLeft : kLost);
  };
  progress.stage("Draw the errors");
  PointSpread spread;
  std::array<WrongPlace, 2> wrongs;
  const TakeCleaned find = [&](const CleanedPoint& point) {
    spread.add(point.at_m);
    if (const auto wrong = wrongOf(point)) wrongs[*wrong].places.add(point.at_m);
  };
  TRY(forEachCleaned(answer.truth, kept, find, progress));
  const Bounds box = boxAround(spread);
  auto views = viewsOf(box, spread.points(), 480);
  for (auto& wrong : wrongs) {
    wrong.place = wrong.places.place();
    if (wrong.place)
      wrong.picture.emplace(cubeAround(wrong.place->at_m, std::max(kLeast_m, wrong.place->edge_m)),
                            40 * wrong.place->points);
  }
  const TakeCleaned draw = [&](const CleanedPoint& point) {
    if (point.is_flawed && point.is_removed) return;
    const auto ink = wrongOf(point);
    for (auto& view : views) ink ? view.addWrong(point.at_m, *ink) : view.addRight(point.at_m);
    for (auto& wrong : wrongs)
      if (wrong.picture && wrong.picture->has(point.at_m)) wrong.picture->add(point.at_m, ink);
  };
  TRY(forEachCleaned(answer.truth, kept, draw, progress));
  std::vector<PlaceMark> marks;
  std::string closer;
  const std::array<const char*, 2> titles = {"Where most good points were lost", "Where most is left that should go"};
  for (const std::size_t wrong : {std::size_t{kLeft}, std::size_t{kLost}}) {
    const auto& one = wrongs[wrong];
    if (!one.place) continue;
    marks.push_back({std::to_string(marks.size() + 1), one.place->at_m});
    closer +=
        fmt::format("<p><b>{}</b> {} <small>{:.2f} &nbsp; {:.2f} &nbsp; {:.2f}</small></p>\n", marks.size(),
                    htmlText(printed(titles[wrong])), one.place->at_m.x(), one.place->at_m.y(), one.place->at_m.z()) +
        one.picture->svg();
  }
  return reportHeading("Where the errors are") +
         legendOf({{kInkOfRight, printed("good and kept")},
                   {kInks[kLeft], printed("left, should go")},
                   {kInks[kLost], printed("good, but lost")}}) +
         smallText(printed("Coordinates are in metres, in the frame of the scan's file; the numbers are those of the "
                           "close-ups below.")) +
         largeViews(views, marks) + closer;
}

Result<void> writeCleaningReport(const CleaningAnswer& answer, const std::string& pictures,
                                 const std::filesystem::path& file) {
  const auto ending = file.extension();
  return writeWholeText(file, ending == ".html"  ? cleaningPage(answer, pictures)
                              : ending == ".csv" ? cleaningTable(answer)
                                                 : AnswerValue<CleaningAnswer>::write(answer).dump(2) + "\n");
}

}  // namespace standpoint

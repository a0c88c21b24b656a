// SPDX-License-Identifier: GPL-3.0-or-later
#include <fmt/format.h>

#include "core/csv_text.h"
#include "core/number_text.h"
#include "core/part_file.h"
#include "core/report_html.h"
#include "project/dataset/score_verb.h"
#include "project/dataset/share_text.h"

namespace standpoint {

namespace {

constexpr const char* kScoreStyle = R"(table.m{font-size:7pt}table.m td,table.m th{padding:2px 3px}
svg.e{max-height:none;border:none}
)";

// Of every scored class, also those that are nowhere: their dashes say so.
std::string classesHtml(const ScoreAnswer& answer) {
  std::string text = reportHeading("Classes") + reportTable({{"Class"},
                                                             {"Id", true},
                                                             {"Points of the truth", true},
                                                             {"Points predicted", true},
                                                             {"IoU, %", true},
                                                             {"Precision, %", true},
                                                             {"Recall, %", true}});
  for (const auto& c : answer.classes)
    text += fmt::format("<tr><td>{}<td class=\"n\">{}<td class=\"n\">{}<td class=\"n\">{}{}{}{}</tr>\n",
                        htmlText(c.name), c.id, groupedDigits(c.truth), groupedDigits(c.predicted), shareCell(c.iou),
                        shareCell(c.precision), shareCell(c.recall));
  return text + "</table>\n<p><small>" +
         htmlText(printed("IoU: points of the class in truth and prediction, of those in either. A class that is in "
                          "neither has no figures and is left out of the mean.")) +
         "</small></p>\n";
}

std::string instancesHtml(const ScoreAnswer& answer) {
  if (answer.instances.empty()) return "";
  std::string text = reportHeading("Instances") + reportTable({{"Class"},
                                                               {"Instances of the truth", true},
                                                               {"Instances predicted", true},
                                                               {"AP, %", true},
                                                               {"AP at IoU 0.5, %", true},
                                                               {"AP at IoU 0.25, %", true}});
  for (const auto& c : answer.instances)
    if (c.truth + c.predicted > 0)
      text += fmt::format("<tr><td>{}<td class=\"n\">{}<td class=\"n\">{}{}{}{}</tr>\n", htmlText(c.name), c.truth,
                          c.predicted, shareCell(c.ap), shareCell(c.ap_50), shareCell(c.ap_25));
  text += fmt::format("<tr><td>{}<td><td>{}{}{}</tr>\n", htmlText(printed("Mean")), shareCell(answer.instance_ap),
                      shareCell(answer.instance_ap_50), shareCell(answer.instance_ap_25));
  return text + "</table>\n<p><small>" +
         htmlText(printed("AP: average precision of instances of 100 points or more in each scan, the mean over IoU of "
                          "0.5 to 0.9, as ScanNet defines it.")) +
         "</small></p>\n";
}

// A cell as dark as its share of the truth's class.
std::string matrixCell(std::uint64_t points, std::uint64_t of) {
  if (points == 0) return "<td>";
  const double share = static_cast<double>(points) / static_cast<double>(of);
  return fmt::format("<td class=\"n\" title=\"{}\" style=\"background:rgba(0,114,178,{:.3f});color:{}\">{:.1f}",
                     groupedDigits(points), share, share > 0.5 ? "#fff" : "#111", 100 * share);
}

// Of the classes that are somewhere.
std::string matrixHtml(const ScoreAnswer& answer) {
  std::vector<std::size_t> shown;
  for (std::size_t k = 0; k < answer.classes.size(); ++k)
    if (answer.classes[k].truth + answer.classes[k].predicted > 0) shown.push_back(k);
  std::string text =
      reportHeading("Confusion matrix") + "<table class=\"m\"><tr><th>" + htmlText(printed("True class"));
  for (const auto k : shown) text += fmt::format("<th class=\"n\">{}", answer.classes[k].id);
  if (answer.given_up > 0) text += "<th class=\"n\">–";
  text += "</tr>\n";
  for (const auto row : shown) {
    const auto& one = answer.classes[row];
    text += fmt::format("<tr><td>{} {}", one.id, htmlText(one.name));
    for (const auto column : shown) text += matrixCell(answer.matrix[row][column], one.truth);
    if (answer.given_up > 0) text += matrixCell(answer.matrix[row].back(), one.truth);
    text += "</tr>\n";
  }
  return text + "</table>\n<p><small>" +
         htmlText(
             printed("Each row: what the points of a class were taken for, in % of them. The columns are headed by "
                     "the ids of the classes, or by – for ignored ones.")) +
         "</small></p>\n";
}

std::string scorePage(const ScoreAnswer& answer, const std::string& pictures) {
  std::string text =
      reportBeginning(htmlText(printedf("Scores of {}", answer.predicted.filename().string())), kScoreStyle);
  const auto percent = [](const std::optional<double>& share) {
    return share ? fmt::format("{:.2f} %", 100 * *share) : std::string("–");
  };
  text += "<p class=\"verdict\">" +
          htmlText(printedf("Mean IoU {} of {} classes, accuracy {}, mean recall {}", percent(answer.mean_iou),
                            answer.classes_in_mean, percent(answer.accuracy), percent(answer.mean_recall))) +
          "</p>\n<p>" +
          htmlText(printedf("Truth: {}. Classes: {}. {} points in {} files; {} points whose truth is ignored are left "
                            "out, {} points that were predicted as an ignored class count as missed.",
                            answer.truth.string(), answer.map, groupedDigits(answer.points), answer.files,
                            groupedDigits(answer.ignored), groupedDigits(answer.given_up))) +
          "</p>\n";
  return text + classesHtml(answer) + instancesHtml(answer) + matrixHtml(answer) + pictures + "</body></html>\n";
}

// The matrix goes on to the right of the figures.
std::string scoreTable(const ScoreAnswer& answer) {
  std::string text = "class,id,truth,predicted,both,iou,precision,recall";
  for (const auto& c : answer.classes) text += "," + csvText("as " + c.name);
  text += ",as ignored\n";
  const auto number = [](const std::optional<double>& value) { return value ? exactText(*value) : ""; };
  for (std::size_t k = 0; k < answer.classes.size(); ++k) {
    const auto& c = answer.classes[k];
    text += fmt::format("{},{},{},{},{},{},{},{}", csvText(c.name), c.id, c.truth, c.predicted, c.both, number(c.iou),
                        number(c.precision), number(c.recall));
    for (const auto points : answer.matrix[k]) text += fmt::format(",{}", points);
    text += "\n";
  }
  return text;
}

}  // namespace

Result<void> writeScoreReport(const ScoreAnswer& answer, const std::string& pictures,
                              const std::filesystem::path& file) {
  const auto ending = file.extension();
  return writeWholeText(file, ending == ".html"  ? scorePage(answer, pictures)
                              : ending == ".csv" ? scoreTable(answer)
                                                 : AnswerValue<ScoreAnswer>::write(answer).dump(2) + "\n");
}

}  // namespace standpoint

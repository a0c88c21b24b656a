// SPDX-License-Identifier: GPL-3.0-or-later
#include <algorithm>
#include <cmath>

#include <fmt/format.h>

#include "core/environment.h"
#include "core/part_file.h"
#include "core/report_html.h"
#include "core/units.h"
#include "project/survey/assess_verb.h"

namespace standpoint {

namespace {

// Okabe and Ito's colours, which people with any colour vision tell apart, and a sign beside each.
struct Sign {
  const char *colour, *sign, *word;
};
Sign signOf(Verdict verdict) {
  constexpr Sign kSigns[] = {
      {"#009E73", "✓", "good"}, {"#E69F00", "!", "check"}, {"#D55E00", "✗", "bad"}, {"#777777", "–", "not known"}};
  return kSigns[static_cast<int>(verdict)];
}

constexpr const char *kPlaceHead = "Worst place (m, frame of the model's file)",
                     *kGapPlaceHead = "Place (m, frame of the model's file)";

std::string smallPrint(const std::string& text) { return "<p><small>" + htmlText(text) + "</small></p>\n"; }

std::string verdictHtml(Verdict verdict) {
  const auto sign = signOf(verdict);
  return fmt::format("<span style=\"color:{}\">{}</span> {}", sign.colour, sign.sign, printed(sign.word));
}

std::string headline(const AssessAnswer& answer) {
  std::string text = "<p class=\"verdict\">";
  const std::pair<std::size_t, Verdict> counts[] = {{answer.good, Verdict::good},
                                                    {answer.warn, Verdict::warn},
                                                    {answer.bad, Verdict::bad},
                                                    {answer.unknown, Verdict::unknown}};
  for (const auto& [count, verdict] : counts) {
    const auto sign = signOf(verdict);
    text += fmt::format("<b style=\"color:{}\">{}</b>&nbsp;{}&nbsp;{} &emsp; ", sign.colour, sign.sign, count,
                        printed(verdict == Verdict::warn ? "to check" : sign.word));
  }
  return text + "</p>\n";
}

std::string placeHtml(const std::optional<AssessPlace>& place) {
  if (!place) return "";
  std::string text;
  if (!place->stations.empty()) text += htmlText(fmt::format("{}", fmt::join(place->stations, " – "))) + "<br>";
  if (const auto& p = place->product)
    text += htmlText(fmt::format("{} {}", p->ifc_class, p->name.empty() ? p->id : p->name)) + "<br>";
  if (place->at)
    text += fmt::format("<small>{:.2f} &nbsp; {:.2f} &nbsp; {:.2f}</small>", place->at->x(), place->at->y(),
                        place->at->z());
  return text;
}

std::string figures(const AssessAnswer& answer) {
  std::string text = reportTable({{"Figure"}, {"Value", true}, {"Limit"}, {"Verdict"}, {kPlaceHead}});
  for (const auto& row : answer.rows) {
    text += "<tr><td>" + htmlText(printed(row.label));
    if (!row.note.empty()) text += "<br><small>" + htmlText(printed(row.note)) + "</small>";
    text += fmt::format("<td class=\"n\">{}<td>{}", row.good_text.empty() ? "" : htmlText(valueText(row)),
                        htmlText(printed(row.good_text)));
    if (!row.bad_text.empty())
      text += "<br><small>" + htmlText(printed("bad") + " " + printed(row.bad_text)) + "</small>";
    if (!row.limit_source.empty()) text += "<br><small>" + htmlText(printed(row.limit_source)) + "</small>";
    text += "<td class=\"s\">" + verdictHtml(row.verdict) + "<td>" + placeHtml(row.worst) + "</tr>\n";
  }
  return text + "</table>\n";
}

Verdict linkVerdict(const AssessAnswer& answer, double overlap) {
  for (const auto& row : answer.rows)
    if (row.id == "overlap" && row.good && row.bad)
      return 100 * overlap >= *row.good ? Verdict::good : 100 * overlap >= *row.bad ? Verdict::warn : Verdict::bad;
  return Verdict::unknown;
}

// From above: what is seen and what is not, the stations, and their links coloured by overlap.
std::string sketch(const AssessAnswer& answer) {
  const auto& places = answer.sketch.surface;
  if (places.empty()) return "";
  Eigen::Vector2d low = places.front().at, high = low;
  const auto extend = [&](const Eigen::Vector2d& at) { low = low.cwiseMin(at), high = high.cwiseMax(at); };
  for (const auto& place : places) extend(place.at);
  for (const auto& station : answer.sketch.stations) extend(station.at);
  const double size = std::max((high - low).maxCoeff(), 1.0), margin = 0.05 * size;
  const auto x = [&](const Eigen::Vector2d& at) { return at.x() - low.x() + margin; };
  const auto y = [&](const Eigen::Vector2d& at) { return high.y() - at.y() + margin; };
  const Eigen::Vector2d extent = high - low + Eigen::Vector2d::Constant(2 * margin);
  std::string text = fmt::format("<svg viewBox=\"0 0 {:.2f} {:.2f}\">\n", extent.x(), extent.y());
  for (const bool seen : {true, false}) {  // a dot is a line without length and with round ends
    text += fmt::format("<path fill=\"none\" stroke-linecap=\"round\" stroke=\"{}\" stroke-width=\"{:.3f}\" d=\"",
                        seen ? "#dddddd" : "#CC79A7", 0.008 * size);
    for (const auto& place : places)
      if (place.seen == seen) text += fmt::format("M{:.2f} {:.2f}h0", x(place.at), y(place.at));
    text += "\"/>\n";
  }
  for (std::size_t k = 0; k < answer.sketch.gaps.size(); ++k) {
    const auto& gap = answer.sketch.gaps[k];
    text += fmt::format("<path fill=\"none\" stroke=\"#882255\" stroke-width=\"{:.3f}\" d=\"", 0.003 * size);
    for (const auto& [a, b] : gap.rim) text += fmt::format("M{:.2f} {:.2f}L{:.2f} {:.2f}", x(a), y(a), x(b), y(b));
    text += fmt::format(
        "\"/>\n<text x=\"{:.2f}\" y=\"{:.2f}\" font-size=\"{:.3f}\" font-weight=\"bold\" fill=\"#882255\">{}</text>\n",
        x(gap.at), y(gap.at), 0.024 * size, k + 1);
  }
  const auto where = [&](const std::string& name) {
    return std::find_if(answer.sketch.stations.begin(), answer.sketch.stations.end(),
                        [&](const auto& s) { return s.name == name; });
  };
  for (const auto& pair : answer.pairs) {
    const auto a = where(pair.a), b = where(pair.b);
    if (a == answer.sketch.stations.end() || b == answer.sketch.stations.end()) continue;
    text += fmt::format(
        "<line x1=\"{:.2f}\" y1=\"{:.2f}\" x2=\"{:.2f}\" y2=\"{:.2f}\" stroke=\"{}\" stroke-width=\"{:.3f}\"/>\n",
        x(a->at), y(a->at), x(b->at), y(b->at), signOf(linkVerdict(answer, pair.overlap)).colour, 0.006 * size);
  }
  for (const auto& station : answer.sketch.stations)
    text += fmt::format(
        "<circle cx=\"{0:.2f}\" cy=\"{1:.2f}\" r=\"{2:.3f}\" fill=\"#0072B2\"/><text x=\"{3:.2f}\" "
        "y=\"{1:.2f}\" font-size=\"{4:.3f}\">{5}</text>\n",
        x(station.at), y(station.at), 0.01 * size, x(station.at) + 0.016 * size, 0.03 * size, htmlText(station.name));
  return text + "</svg>\n" +
         smallPrint(printed("From above, all storeys: grey is covered, pink is not, the largest gaps are outlined and "
                            "numbered; lines between stations have the colour of their overlap's verdict."));
}

std::string numberOr(const std::optional<double>& value, double factor, int decimals) {
  return value ? fmt::format("{:.{}f}", *value * factor, decimals) : "–";
}

std::string scans(const AssessAnswer& answer) {
  std::string text = reportTable({{"Scan"},
                                  {"Points", true},
                                  {"Stray, %", true},
                                  {"Deviation, mm", true},
                                  {"95 %, mm", true},
                                  {"Noise, mm", true},
                                  {"/ expected", true}});
  for (const auto& s : answer.scans)
    text += fmt::format(
        "<tr><td>{}<br><small>{}</small><td class=\"n\">{}<td class=\"n\">{:.2f}<td class=\"n\">{}<td class=\"n\">{}"
        "<td class=\"n\">{}<td class=\"n\">{}</tr>\n",
        htmlText(s.station), htmlText(std::filesystem::path(s.file).filename().string()), s.points,
        100 * s.stray_fraction, numberOr(s.deviation_median_m, 1000, 2), numberOr(s.deviation_95_m, 1000, 2),
        numberOr(s.noise_m, 1000, 2), numberOr(s.noise_ratio, 1, 2));
  return text + "</table>\n";
}

std::string stationsHtml(const AssessAnswer& answer) {
  std::string text = reportTable(
      {{"Station"}, {"Sees, m²", true}, {"Targets", true}, {"Pose error, mm", true}, {"Rotation, °", true}});
  for (const auto& s : answer.stations)
    text += fmt::format("<tr><td>{}<td class=\"n\">{:.1f}<td class=\"n\">{}<td class=\"n\">{}<td class=\"n\">{}</tr>\n",
                        htmlText(s.station), s.seen_m2, s.targets ? std::to_string(*s.targets) : "–",
                        numberOr(s.pose_error_m, 1000, 2), numberOr(s.pose_error_rad, 1 / kRadPerDeg, 4));
  return text + "</table>\n" + smallPrint(printed("Errors of poses are known only to a simulator."));
}

std::string pairsHtml(const AssessAnswer& answer) {
  if (answer.pairs.empty()) return "";
  std::string text = reportHeading("Overlap") + reportTable({{"Link"}, {"Common, m²", true}, {"Overlap", true}});
  for (const auto& p : answer.pairs)
    text += fmt::format("<tr><td>{} – {}<td class=\"n\">{:.1f}<td class=\"n\">{:.0f} %</tr>\n", htmlText(p.a),
                        htmlText(p.b), p.common_m2, 100 * p.overlap);
  return text + "</table>\n";
}

std::string holesHtml(const AssessAnswer& answer) {
  if (answer.holes.empty()) return "";
  std::string text =
      reportHeading("Not covered") + reportTable({{"Product"}, {"Not covered, m²", true}, {"of, m²", true}});
  for (const auto& h : answer.holes)
    text += fmt::format("<tr><td>{} {} <small>{}</small><td class=\"n\">{:.2f}<td class=\"n\">{:.2f}</tr>\n",
                        htmlText(h.ifc_class), htmlText(h.name), htmlText(h.id), h.unseen_m2, h.exposed_m2);
  return text + "</table>\n";
}

// The numbers are those of the sketch.
std::string gapsHtml(const AssessAnswer& answer) {
  if (answer.sketch.gaps.empty()) return "";
  std::string text =
      reportHeading("Largest gaps") +
      reportTable({{"No."}, {"Product"}, {"m²", true}, {"Spacing on the rest, mm", true}, {kGapPlaceHead}});
  for (std::size_t k = 0; k < answer.sketch.gaps.size(); ++k) {
    const auto& gap = answer.patches[k];
    text += fmt::format(
        "<tr><td>{}<td>{} {} <small>{}</small><td class=\"n\">{:.2f}<td class=\"n\">{}<td><small>{:.2f} &nbsp; {:.2f} "
        "&nbsp; {:.2f}</small></tr>\n",
        k + 1, htmlText(gap.ifc_class), htmlText(gap.name), htmlText(gap.id), gap.area_m2,
        numberOr(gap.spacing_m, 1000, 1), gap.at.x(), gap.at.y(), gap.at.z());
  }
  return text + "</table>\n";
}

std::string htmlPage(const AssessAnswer& answer) {
  const auto title = htmlText(answer.project.empty() ? printed("Quality of the scans")
                                                     : printedf("Quality of the scans of {}", answer.project));
  std::string text = reportBeginning(title) + headline(answer);
  const auto limits = answer.limits.empty() ? printed(answer.profile)
                                            : printedf("{}, changed by {}", printed(answer.profile), answer.limits);
  text += "<p>" +
          htmlText(printedf("Limits: {}. Surface that counts: {} m², by {} samples; a point within {} mm of a surface "
                            "belongs to it.",
                            limits, fmt::format("{:.1f}", answer.exposed_m2), answer.samples,
                            fmt::format("{:g}", answer.radius_m * 1000))) +
          "</p>\n";
  text += figures(answer) + reportHeading("Plan") + sketch(answer) + reportHeading("Scans") + scans(answer) +
          reportHeading("Stations") + stationsHtml(answer) + pairsHtml(answer) + holesHtml(answer) + gapsHtml(answer);
  return text + "</body></html>\n";
}

std::string quoted(const std::string& text) {
  std::string cell = "\"";
  for (const char c : text) cell += c == '"' ? "\"\"" : std::string(1, c);
  return cell + "\"";
}

std::string csvRows(const AssessAnswer& answer) {
  const auto number = [](const std::optional<double>& value) { return value ? fmt::format("{:.6g}", *value) : ""; };
  std::string text = "id,label,value,unit,good,bad,verdict,note,stations,product,x_m,y_m,z_m\n";
  for (const auto& row : answer.rows) {
    const auto place = row.worst.value_or(AssessPlace());
    text += fmt::format("{},{},{},{},{},{},{},{},{},{},", row.id, quoted(row.label), number(row.value), row.unit,
                        number(row.good), number(row.bad), nameOf(row.verdict), quoted(row.note),
                        quoted(fmt::format("{}", fmt::join(place.stations, " "))),
                        quoted(place.product ? place.product->id : ""));
    text += place.at ? fmt::format("{:.3f},{:.3f},{:.3f}\n", place.at->x(), place.at->y(), place.at->z()) : ",,\n";
  }
  return text;
}

}  // namespace

Result<void> writeQualityReport(const AssessAnswer& answer, const std::filesystem::path& file) {
  const auto ending = file.extension().string();
  if (ending != ".html" && ending != ".csv")
    return failure(ErrorKind::usage, "unsupported report format: use .html or .csv", file.string());
  return writeWholeText(file, ending == ".html" ? htmlPage(answer) : csvRows(answer));
}

}  // namespace standpoint

// SPDX-License-Identifier: GPL-3.0-or-later
#include "importers/obj/mtl.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>
#include <set>

#include "importers/files/text_cursor.h"
#include "importers/files/text_pieces.h"

namespace standpoint {

namespace {

float unit(double v) { return static_cast<float>(std::clamp(v, 0.0, 1.0)); }

std::string lower(std::string_view text) {
  std::string result(text);
  for (auto& c : result)
    if (c >= 'A' && c <= 'Z') c = static_cast<char>(c - 'A' + 'a');
  return result;
}

class MtlParser {
 public:
  MtlParser(std::string_view text, const std::string& name, Report& report)
      : text_(text, 1), name_(name), report_(report) {}

  std::vector<MtlMaterial> run() {
    while (!text_.done()) {
      text_.skipSpaces();
      if (text_.atStatementEnd()) {
        text_.finishStatement();
        continue;
      }
      line_ = text_.line();
      const auto key = lower(text_.word());
      const auto rest = text_.rest();
      statement(key, rest);
    }
    sayWhatIsNotKept();
    return std::move(materials_);
  }

 private:
  std::string place() const { return name_ + " line " + std::to_string(line_); }

  void statement(const std::string& key, const std::string& rest) {
    if (key == "newmtl") return begin(rest);
    if (!current_) return orphan(key);
    if (isMap(key)) return map(key, rest);
    auto& s = current_->surface;
    if (key == "kd")
      kd(rest);
    else if (key == "d")
      number(rest.starts_with("-halo") ? rest.substr(5) : rest, [&](double v) { s.colour.a = unit(v), has_d_ = true; });
    else if (key == "tr")
      number(rest, [&](double v) {
        if (!has_d_) s.colour.a = unit(1 - v);
      });
    else if (key == "ni")
      number(rest, [&](double v) {
        if (v > 1 && v <= 10) s.index_of_refraction = static_cast<float>(v);
      });
    else if (key == "pr")
      number(rest, [&](double v) { s.roughness = unit(v); });
    else if (key == "pm")
      number(rest, [&](double v) { s.metallic = unit(v); });
    else if (key == "pc")
      number(rest, [&](double v) { s.clearcoat = unit(v); });
    else if (key == "ks")
      ks(rest);
    else if (key == "illum")
      number(rest, [&](double v) { s.unlit = v == 0; });
    else
      other(key, rest);
    // Light goes through what is not opaque.
    if (s.colour.a < 1)
      s.transmission = 1 - s.colour.a;
    else
      s.transmission.reset();
  }

  void begin(const std::string& name) {
    has_d_ = false;
    const bool is_new = names_.insert(name).second;
    if (!is_new)
      report_.warn(place(), "material " + inQuotes(name) + " is defined more than once; the first definition is used");
    if (!is_new) {
      ignored_ = {};
      current_ = &ignored_;
      return;
    }
    materials_.emplace_back();
    current_ = &materials_.back();
    current_->surface.name = name;
    current_->surface.source = "newmtl " + name;
  }

  void orphan(const std::string& key) {
    static constexpr std::array<std::string_view, 12> kObj = {"v", "vn", "vt", "f",      "o",      "g",
                                                              "s", "l",  "p",  "usemtl", "mtllib", "vp"};
    if (std::find(kObj.begin(), kObj.end(), key) != kObj.end()) return count("statements of an OBJ");
    count("statements before the first newmtl");
  }

  void count(const char* what) {
    auto& [first, n] = odd_[what];
    if (n++ == 0) first = line_;
  }

  // The numbers up to the first word that is none.
  static std::vector<double> numbers(const std::string& rest) {
    const std::string line = rest + '\n';
    TextCursor cursor(line, 0);
    std::vector<double> result;
    for (double v = 0; cursor.skipSpaces(), !cursor.atLineEnd() && result.size() < 16 && cursor.number(v);)
      result.push_back(v);
    return result;
  }

  template <class Use>
  void number(const std::string& rest, const Use& use) {
    const auto n = numbers(rest);
    if (n.empty() || !std::isfinite(n[0]))
      return report_.warn(place(), inQuotes(rest) + " is not a number and was ignored");
    use(n[0]);
  }

  // r g b, or r alone for all three.
  std::optional<std::array<float, 3>> colour(const std::string& rest) {
    auto n = numbers(rest);
    if (n.size() == 1) n = {n[0], n[0], n[0]};
    if (n.size() >= 3 && std::isfinite(n[0]) && std::isfinite(n[1]) && std::isfinite(n[2]))
      return std::array{unit(n[0]), unit(n[1]), unit(n[2])};
    report_.warn(place(), inQuotes(rest) + " is not a colour of three numbers and was ignored");
    return std::nullopt;
  }

  void kd(const std::string& rest) {
    const auto c = colour(rest);
    if (c) current_->surface.colour = {(*c)[0], (*c)[1], (*c)[2], current_->surface.colour.a};
  }

  void ks(const std::string& rest) {
    if (const auto c = colour(rest)) current_->surface.specular = std::max({(*c)[0], (*c)[1], (*c)[2]});
  }

  // Tf is read by nobody alike: Maya writes 1 1 1 for opaque, the specification means clear by it.
  void other(const std::string& key, const std::string& rest) {
    static constexpr std::array<std::string_view, 10> kLooks = {"ka",  "ns",    "ke",     "tf",        "ps",
                                                                "pcr", "aniso", "anisor", "sharpness", "km"};
    if (std::find(kLooks.begin(), kLooks.end(), key) == kLooks.end()) return count("unknown statements");
    const auto n = numbers(rest);
    if (std::any_of(n.begin(), n.end(), [](double v) { return v != 0; })) looks_.insert(key);
  }

  static bool isMap(const std::string& key) {
    static constexpr std::array<std::string_view, 6> kMaps = {"bump", "disp", "decal", "refl", "norm", "map"};
    return key.starts_with("map_") || std::find(kMaps.begin(), kMaps.end(), key) != kMaps.end();
  }

  void map(const std::string& key, const std::string& rest) {
    Eigen::Vector2f scale(1, 1), offset(0, 0);
    const auto file = withoutOptions(rest, scale, offset);
    if (file.empty()) return report_.warn(place(), key + " does not name a file");
    if (key == "map_kd")
      current_->texture = file, current_->texture_scale = scale, current_->texture_offset = offset;
    else if (key == "map_d")
      current_->cutout = file;
    else
      current_->other_maps.try_emplace(key, file);
  }

  // "-s 2 2 -clamp on brick wall.png" → "brick wall.png"
  std::string withoutOptions(const std::string& rest, Eigen::Vector2f& scale, Eigen::Vector2f& offset) {
    const std::string line = rest + '\n';
    TextCursor cursor(line, 0);
    for (;;) {
      cursor.skipSpaces();
      const char* from = cursor.at();
      if (*from != '-') return rest.substr(static_cast<std::size_t>(from - line.data()));
      const auto option = std::string(cursor.word());
      if (option == "-s" || option == "-o" || option == "-t" || option == "-mm") {
        double n[3] = {0, 0, 0};
        int count = 0;
        for (;
             cursor.skipSpaces(), count < (option == "-mm" ? 2 : 3) && !cursor.atLineEnd() && cursor.number(n[count]);)
          ++count;
        if (option == "-s" && count > 0)
          scale = Eigen::Vector2f(static_cast<float>(n[0]), static_cast<float>(count > 1 ? n[1] : 1));
        else if (option == "-o" && count > 0)
          offset = Eigen::Vector2f(static_cast<float>(n[0]), static_cast<float>(n[1]));
        else
          options_.insert(option);
      } else if (takesOne(option)) {
        cursor.skipSpaces();
        cursor.word();
        if (option != "-type") options_.insert(option);
      } else {
        return rest.substr(static_cast<std::size_t>(from - line.data()));  // a file may be called so
      }
    }
  }

  static bool takesOne(const std::string& option) {
    static constexpr std::array<std::string_view, 10> kOne = {"-blendu", "-blendv",     "-boost",   "-bm",     "-cc",
                                                              "-clamp",  "-colorspace", "-imfchan", "-texres", "-type"};
    return std::find(kOne.begin(), kOne.end(), option) != kOne.end();
  }

  static std::string joined(const std::set<std::string>& words) {
    std::string result;
    for (const auto& w : words) result += (result.empty() ? "" : ", ") + w;
    return result;
  }

  void sayWhatIsNotKept() {
    for (const auto& [what, found] : odd_)
      report_.warn(name_ + " line " + std::to_string(found.first), what + ", skipped: " + std::to_string(found.second));
    if (!looks_.empty()) report_.note(name_, "skipped lighting properties: " + joined(looks_));
    if (!options_.empty()) report_.note(name_, "skipped texture options: " + joined(options_));
  }

  TextCursor text_;
  const std::string& name_;
  Report& report_;
  std::size_t line_ = 0;
  std::vector<MtlMaterial> materials_;
  MtlMaterial ignored_;
  MtlMaterial* current_ = nullptr;
  bool has_d_ = false;
  std::set<std::string> names_, looks_, options_;
  std::map<std::string, std::pair<std::size_t, std::size_t>> odd_;
};

}  // namespace

std::vector<MtlMaterial> parseMtl(std::string_view text, const std::string& name, Report& report) {
  std::string ended(text.starts_with("\xEF\xBB\xBF") ? text.substr(3) : text);
  if (ended.empty() || ended.back() != '\n') ended += '\n';
  return MtlParser(ended, name, report).run();
}

}  // namespace standpoint

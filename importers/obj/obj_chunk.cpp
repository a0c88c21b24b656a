// SPDX-License-Identifier: GPL-3.0-or-later
#include "importers/obj/obj_chunk.h"

#include <algorithm>
#include <limits>

#include "importers/files/text_cursor.h"

namespace standpoint {

namespace {

constexpr double kLargest = 1e13;  // no coordinate is beyond, in whatever unit; and float can hold it
constexpr float kNone = std::numeric_limits<float>::quiet_NaN();

class ChunkParser {
 public:
  explicit ChunkParser(std::string_view text) : text_(text, 0) {}

  ObjChunk run() {
    while (!text_.done() && !out_.fault) {
      text_.skipSpaces();
      if (text_.atLineEnd())
        text_.finishStatement();
      else
        statement();
    }
    if (!out_.texture_corners.empty()) out_.texture_corners.resize(out_.corners.size(), kNoObjIndex);
    out_.lines = text_.line();
    return std::move(out_);
  }

 private:
  void statement() {
    line_ = text_.line();
    const char* p = text_.at();
    const bool space_second = p[1] == ' ' || p[1] == '\t';
    if (p[0] == 'v' && space_second)
      vertex();
    else if (p[0] == 'f' && space_second)
      face(1);
    else if (p[0] == 'v' && p[1] == 'n')
      text_.skipStatement(), ++out_.known_statements;
    else if (p[0] == 'v' && p[1] == 't')
      textureCoordinate();
    else if (p[0] == '#')
      text_.skipComment();
    else
      seldom();
  }

  void fault(std::string message) {
    if (!out_.fault) out_.fault = ObjFault{line_, std::move(message)};
  }

  // How many numbers there are, of which the first `most` are kept; -1 where a word is none.
  int numbers(double* values, int most) {
    int count = 0;
    for (text_.skipSpaces(); !text_.atStatementEnd(); text_.skipSpaces(), ++count) {
      double ignored = 0;
      if (text_.number(count < most ? values[count] : ignored)) continue;
      text_.skipStatement();
      return -1;
    }
    text_.finishStatement();
    return count;
  }

  void vertex() {
    text_.advance(1);
    double n[7];
    const int count = numbers(n, 7);
    ++out_.known_statements;
    if (const char* why = whyNotVertex(n, count)) return badVertex(why);
    out_.positions.emplace_back(n[0], n[1], n[2]);
    // x y z r g b, or x y z w r g b; x y z w alone is a weight, which only free-form geometry uses.
    if (count == 6 || count == 7) colour(n + count - 3);
    if (count == 5 || count > 7) out_.tallies[std::string(kOddColours)].add(line_);
    if ((count == 4 || count == 7) && n[3] != 1) out_.tallies[std::string(kWeights)].add(line_);
  }

  static const char* whyNotVertex(const double* n, int count) {
    if (count < 0) return "a coordinate is not a number";
    if (count < 3) return "a vertex requires three numbers";
    double largest = 0;
    for (int i = 0; i < 3; ++i) {
      if (!std::isfinite(n[i])) return "a coordinate is not a finite number";
      largest = std::max(largest, std::abs(n[i]));
    }
    return largest > kLargest ? "a coordinate exceeds 1e13" : nullptr;
  }

  void badVertex(const char* why) {
    out_.bad_vertices.push_back({out_.positions.size(), line_, why});
    out_.positions.push_back(Eigen::Vector3d::Constant(kNone));
    out_.tallies[std::string(kBadVertices)].add(line_);
  }

  void colour(const double* rgb) {
    out_.colours.resize(out_.positions.size() - 1, {kNone, kNone, kNone});
    out_.colours.emplace_back(static_cast<float>(rgb[0]), static_cast<float>(rgb[1]), static_cast<float>(rgb[2]));
  }

  void textureCoordinate() {
    text_.advance(2);
    double n[2] = {0, 0};
    ++out_.known_statements;
    if (numbers(n, 2) < 1) n[0] = kNone;
    const Eigen::Vector2f uv(static_cast<float>(n[0]), static_cast<float>(1 - n[1]));  // OBJ's origin is at the bottom
    if (!uv.allFinite()) out_.tallies[std::string(kWrongTexture)].add(line_);
    out_.texture_coordinates.push_back(uv.allFinite() ? uv : Eigen::Vector2f::Zero());
  }

  void face(std::size_t key_length) {
    text_.advance(key_length);
    ++out_.known_statements;
    const std::size_t begin = out_.corners.size();
    for (text_.skipSpaces(); !text_.atStatementEnd(); text_.skipSpaces())
      if (!corner(begin)) return;
    text_.finishStatement();
    if (out_.corners.size() - begin < 3) {
      out_.corners.resize(begin);
      if (out_.texture_corners.size() > begin) out_.texture_corners.resize(begin);
      return out_.tallies[std::string(kShortFaces)].add(line_);
    }
    if (line_ != next_face_line_) out_.face_lines.emplace_back(out_.face_ends.size(), line_);
    next_face_line_ = line_ + 1;
    out_.face_ends.push_back(static_cast<std::uint32_t>(out_.corners.size()));
  }

  // v, v/t, v//n or v/t/n. The normal is not kept: what a beam meets is the face.
  bool corner(std::size_t begin) {
    const auto which = [&] { return "corner " + std::to_string(out_.corners.size() - begin + 1) + " of the face"; };
    std::int64_t v = 0, t = 0, n = 0;
    if (!isNumberStart()) return fault(which() + " has no vertex number"), false;
    if (!integer(v)) return fault(which() + " has an index of more than nine digits"), false;
    bool textured = false;
    if (text_.peek() == '/') {
      text_.advance();
      textured = isNumberStart();
      if (textured && !integer(t)) return fault(which() + " has an index of more than nine digits"), false;
      if (text_.peek() == '/') {
        text_.advance();
        if (isNumberStart() && !integer(n)) return fault(which() + " has an index of more than nine digits"), false;
      }
    }
    if (!text_.atWordEnd() && text_.peek() != '\\' && text_.peek() != '#')
      return fault(which() + " must be v, v/t, v//n or v/t/n"), false;
    if (v == 0) return fault(which() + " has vertex number 0; vertex numbers start at 1"), false;
    const auto index = position(v);
    if (textured) {
      out_.texture_corners.resize(out_.corners.size(), kNoObjIndex);
      out_.texture_corners.push_back(textureIndex(t));
    }
    out_.corners.push_back(index);
    return true;
  }

  std::int32_t position(std::int64_t v) {
    if (v > 0) {
      if (v > out_.largest.value) out_.largest = {v, v, 0, line_};
      return static_cast<std::int32_t>(v - 1);
    }
    const auto preceding = static_cast<std::int64_t>(out_.positions.size());
    if (preceding + v < out_.lowest.value) out_.lowest = {preceding + v, v, preceding, line_};
    return encodeRelative(preceding + v);
  }

  std::int32_t textureIndex(std::int64_t t) const {
    if (t == 0) return kNoObjIndex;
    return t > 0 ? static_cast<std::int32_t>(t - 1)
                 : encodeRelative(static_cast<std::int64_t>(out_.texture_coordinates.size()) + t);
  }

  bool isNumberStart() const { return text_.peek() == '-' || (text_.peek() >= '0' && text_.peek() <= '9'); }

  bool integer(std::int64_t& value) {
    const bool negative = text_.peek() == '-';
    if (negative) text_.advance();
    const char* from = text_.at();
    std::int64_t sum = 0;
    for (; text_.peek() >= '0' && text_.peek() <= '9'; text_.advance())
      if (sum < kMaxObjIndex) sum = 10 * sum + (text_.peek() - '0');
    value = negative ? -sum : sum;
    return text_.at() != from && sum < kMaxObjIndex;
  }

  void seldom() {
    const auto key = text_.word();
    if (key == "f" || key == "fo") return face(0);  // `fo` is what version 2 called it
    if (key == "v") return text_.finishStatement(), badVertex("a vertex requires three numbers");
    if (key == "o")
      event(ObjChange::object);
    else if (key == "g")
      event(ObjChange::group);
    else if (key == "usemtl")
      event(ObjChange::material);
    else if (key == "mtllib")
      event(ObjChange::library);
    else
      other(key);
  }

  void event(ObjChange what) {
    ++out_.known_statements;
    out_.events.push_back({what, static_cast<std::uint32_t>(out_.face_ends.size()), line_, text_.rest()});
  }

  void other(std::string_view key) {
    static constexpr std::array<std::string_view, 15> kSkipped = {
        "bsp", "bzp", "call", "cdc", "cdp", "csh", "curv", "curv2", "hole", "l", "p", "res", "scrv", "surf", "trim"};
    // They belong to those, or say how to draw.
    static constexpr std::array<std::string_view, 22> kSilent = {
        "bevel", "bmat", "c_interp",   "con", "cstype", "ctech", "d_interp",  "deg",    "end", "lod", "maplib", "mg",
        "parm",  "s",    "shadow_obj", "sp",  "stech",  "step",  "trace_obj", "usemap", "vp",  "vw"};
    const bool lost = std::find(kSkipped.begin(), kSkipped.end(), key) != kSkipped.end();
    const bool silent = std::find(kSilent.begin(), kSilent.end(), key) != kSilent.end();
    if (lost || !silent) out_.tallies[std::string(lost ? key : kUnknown)].add(line_);
    if (lost || silent) ++out_.known_statements;
    if (!text_.atLineEnd())
      text_.skipStatement();
    else
      text_.finishStatement();
  }

  TextCursor text_;
  std::size_t line_ = 0, next_face_line_ = std::numeric_limits<std::size_t>::max();
  ObjChunk out_;
};

}  // namespace

ObjChunk parseObjChunk(std::string_view text) { return ChunkParser(text).run(); }

}  // namespace standpoint

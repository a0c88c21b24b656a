// SPDX-License-Identifier: GPL-3.0-or-later
#include "importers/ply/ply_soup.h"

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <initializer_list>
#include <optional>
#include <unordered_map>

#include "importers/ply/ply_rows.h"

namespace standpoint {

namespace {

constexpr double kLargest_m = 1e13;
constexpr std::initializer_list<const char*> kU = {"s", "u", "texture_u", "texture_s"},
                                             kV = {"t", "v", "texture_v", "texture_t"};

// The first property of those names, with or without a list.
int propertyOf(const PlyElement& element, std::initializer_list<const char*> names, bool list = false) {
  for (const char* name : names)
    for (std::size_t i = 0; i < element.properties.size(); ++i)
      if (element.properties[i].name == name && element.properties[i].count_type.has_value() == list)
        return static_cast<int>(i);
  return -1;
}

// Three or four properties as one colour: integers by their range, floating-point numbers from 0 to 1.
class ColourColumns {
 public:
  explicit ColourColumns(const PlyElement& element) {
    const std::array red = {"red", "diffuse_red", "r"}, green = {"green", "diffuse_green", "g"},
                     blue = {"blue", "diffuse_blue", "b"};
    for (std::size_t i = 0; i < red.size() && !there(); ++i)
      columns_ = {propertyOf(element, {red[i]}), propertyOf(element, {green[i]}), propertyOf(element, {blue[i]}),
                  propertyOf(element, {"alpha", "a"})};
    for (std::size_t k = 0; k < 4 && there(); ++k)
      if (columns_[k] >= 0) scale_[k] = scaleOf(element.properties[static_cast<std::size_t>(columns_[k])].type);
  }
  bool there() const { return columns_[0] >= 0 && columns_[1] >= 0 && columns_[2] >= 0; }
  bool uses(int property) const {
    return there() && std::find(columns_.begin(), columns_.end(), property) != columns_.end();
  }

  std::array<std::uint8_t, 4> operator()(const PlyRow& row) const {
    std::array<std::uint8_t, 4> result = {255, 255, 255, 255};
    for (std::size_t k = 0; k < 4; ++k)
      if (columns_[k] >= 0) {
        const double v = row.at(static_cast<std::size_t>(columns_[k])) * scale_[k];
        result[k] = v >= 0 ? static_cast<std::uint8_t>(std::lround(std::min(v, 255.0))) : 0;
      }
    return result;
  }

 private:
  static double scaleOf(PlyType type) {
    if (type == PlyType::float32 || type == PlyType::float64) return 255;
    return type == PlyType::uint16 || type == PlyType::int16 ? 255.0 / 65535 : 1;
  }

  std::array<int, 4> columns_ = {-1, -1, -1, -1};
  std::array<double, 4> scale_ = {1, 1, 1, 1};
};

class SoupReader {
 public:
  SoupReader(const FileBytes& bytes, const PlyFileHeader& header, const std::string& name, Report& report,
             Progress& progress)
      : header_(header), name_(name), report_(report), progress_(progress), rows_(bytes, header, name) {}

  Result<PlySoup> run() {
    out_.soup.face_begins = {0};
    TRY(mustHaveFaces());
    const auto* face = element("face");
    const bool wedges = face != nullptr && propertyOf(*face, {"texcoord"}, true) >= 0;
    vertex_textured_ = !wedges && propertyOf(*element("vertex"), kU) >= 0 && propertyOf(*element("vertex"), kV) >= 0;
    for (const auto& element : header_.elements) {
      TRY(element.name == "vertex"      ? vertices(element)
          : element.name == "face"      ? faces(element)
          : element.name == "tristrips" ? strips(element)
                                        : skip(element));
    }
    TRY(checkCorners());
    if (!out_.soup.texture_corners.empty())
      out_.soup.texture_corners.resize(out_.soup.corners.size(), kNoTextureCorner);
    if (!out_.colour_of_face.empty()) out_.colour_of_face.resize(faceCount(), kNoFaceColour);
    if (short_faces_ > 0)
      report_.lose(first_short_, "faces with fewer than three corners: " + std::to_string(short_faces_));
    return std::move(out_);
  }

 private:
  std::size_t faceCount() const { return out_.soup.face_begins.size() - 1; }

  const PlyElement* element(const char* name) const {
    for (const auto& e : header_.elements)
      if (e.name == name) return &e;
    return nullptr;
  }

  Result<void> mustHaveFaces() const {
    const auto* vertex = element("vertex");
    if (vertex == nullptr) return failure(ErrorKind::unusable, "has no vertices", name_ + " line 1");
    if (vertex->count >= kNoTextureCorner)
      return failure(ErrorKind::unusable, "more than 4294967294 vertices",
                     name_ + " line " + std::to_string(vertex->line));
    for (const char* kind : {"face", "tristrips"})
      if (const auto* e = element(kind); e != nullptr && e->count > 0) return {};
    return failure(ErrorKind::unusable,
                   "holds " + std::to_string(vertex->count) +
                       " points and no faces: this is a point cloud, not a model; add it as an underlay",
                   name_ + " line " + std::to_string(vertex->line));
  }

  // Calls use(row, number) for each row.
  template <class Use>
  Result<void> eachRow(const PlyElement& element, const Use& use) {
    if (element.properties.empty()) return {};
    for (std::uint64_t i = 0; i < element.count; ++i) {
      if (auto ok = rows_.next(element, i, row_); !ok) return ok;
      if (auto ok = use(i); !ok) return ok;
      if ((i & 0xFFFFU) != 0) continue;
      progress_.advance(0.6 * rows_.fraction());
      if (auto ok = progress_.check(); !ok) return ok;
    }
    return {};
  }

  void sayUnread(const PlyElement& element, const std::vector<int>& used, const ColourColumns& colour) {
    std::string unread;
    for (int i = 0; i < static_cast<int>(element.properties.size()); ++i) {
      const auto& name = element.properties[static_cast<std::size_t>(i)].name;
      const bool normal = name == "nx" || name == "ny" || name == "nz";  // what a beam meets is the face
      if (!normal && !colour.uses(i) && std::find(used.begin(), used.end(), i) == used.end())
        unread += (unread.empty() ? "" : ", ") + name.substr(0, 40);
    }
    if (!unread.empty())
      report_.note("line " + std::to_string(element.line),
                   "properties of " + element.name + " not read: " + unread.substr(0, 400));
  }

  Result<void> vertices(const PlyElement& element) {
    const std::vector<int> xyz = {propertyOf(element, {"x"}), propertyOf(element, {"y"}), propertyOf(element, {"z"})};
    if (*std::min_element(xyz.begin(), xyz.end()) < 0)
      return failure(ErrorKind::unusable, "vertices require x, y and z",
                     name_ + " line " + std::to_string(element.line));
    const int u = propertyOf(element, kU), v = propertyOf(element, kV);
    const ColourColumns colour(element);
    sayUnread(element, {xyz[0], xyz[1], xyz[2], u, v}, colour);
    auto& soup = out_.soup;
    soup.positions.reserve(element.count);
    return eachRow(element, [&](std::uint64_t i) -> Result<void> {
      Eigen::Vector3d p;
      for (int k = 0; k < 3; ++k) p[k] = row_.at(static_cast<std::size_t>(xyz[static_cast<std::size_t>(k)]));
      if (!(p.cwiseAbs().maxCoeff() <= kLargest_m) || !p.allFinite()) {
        p.setConstant(NAN);
        if (bad_.size() < 1000) bad_.emplace_back(i, rows_.place(element, i));
      }
      soup.positions.push_back(p);
      if (colour.there()) soup.colours.push_back(colour(row_));
      if (vertex_textured_)
        soup.texture_coordinates.push_back(
            texture(row_.at(static_cast<std::size_t>(u)), row_.at(static_cast<std::size_t>(v))));
      return {};
    });
  }

  // The format's programs (MeshLab, CloudCompare) count v from the image's bottom, as OBJ does.
  static Eigen::Vector2f texture(double u, double v) {
    const Eigen::Vector2f uv(static_cast<float>(u), static_cast<float>(1 - v));
    return uv.allFinite() ? uv : Eigen::Vector2f::Zero();
  }

  // Equal coordinates are one, so that corners of one vertex meet again.
  std::uint32_t textureIndex(const Eigen::Vector2f& uv) {
    const auto key = std::uint64_t{std::bit_cast<std::uint32_t>(uv.x())} << 32U | std::bit_cast<std::uint32_t>(uv.y());
    auto& all = out_.soup.texture_coordinates;
    const auto [known, is_new] = texture_of_.try_emplace(key, static_cast<std::uint32_t>(all.size()));
    if (is_new) all.push_back(uv);
    return known->second;
  }

  Result<void> faces(const PlyElement& element) {
    const int indices = propertyOf(element, {"vertex_indices", "vertex_index"}, true);
    if (indices < 0)
      return failure(ErrorKind::unusable, "faces require a list vertex_indices",
                     name_ + " line " + std::to_string(element.line));
    const int wedges = propertyOf(element, {"texcoord"}, true), number = propertyOf(element, {"texnumber"});
    const ColourColumns colour(element);
    sayUnread(element, {indices, wedges, number}, colour);
    out_.soup.corners.reserve(3 * element.count);
    out_.soup.face_begins.reserve(element.count + 1);
    if (header_.form != PlyForm::text) out_.row_of_face.reserve(element.count);
    return eachRow(element, [&](std::uint64_t i) -> Result<void> {
      const auto from = row_.begin[static_cast<std::size_t>(indices)],
                 n = row_.sizes[static_cast<std::size_t>(indices)];
      if (n < 3) return countShort(element, i), Result<void>();
      const double* uv = nullptr;
      if (wedges >= 0 && row_.sizes[static_cast<std::size_t>(wedges)] == 2 * n)
        uv = row_.values.data() + row_.begin[static_cast<std::size_t>(wedges)];
      for (std::size_t k = 0; k < n; ++k) {
        if (auto ok = corner(element, i, row_.values[from + k]); !ok) return ok;
        if (uv != nullptr)
          wedge(texture(uv[2 * k], uv[2 * k + 1]));
        else if (vertex_textured_)
          vertexTexture();
      }
      const double image = number >= 0 ? row_.at(static_cast<std::size_t>(number)) : 0;
      endFace(i, image >= 0 && image < static_cast<double>(header_.texture_files.size())
                     ? static_cast<std::uint32_t>(image) + 1
                     : 0);
      if (colour.there()) {
        const auto c = colour(row_);
        out_.colour_of_face.resize(faceCount() - 1, kNoFaceColour);
        out_.colour_of_face.push_back(static_cast<std::uint32_t>(c[0] << 16 | c[1] << 8 | c[2]));
      }
      return {};
    });
  }

  void countShort(const PlyElement& element, std::uint64_t row) {
    if (short_faces_++ == 0) first_short_ = rows_.place(element, row);
  }

  Result<void> corner(const PlyElement& element, std::uint64_t row, double index) {
    const auto* vertex = this->element("vertex");
    if (!(index >= 0 && index < static_cast<double>(vertex->count)) || index != std::floor(index))
      return failure(ErrorKind::unusable,
                     "refers to a missing vertex; vertex count is " + std::to_string(vertex->count),
                     name_ + " " + rows_.place(element, row));
    out_.soup.corners.push_back(static_cast<std::uint32_t>(index));
    return {};
  }

  void wedge(const Eigen::Vector2f& uv) {
    out_.soup.texture_corners.resize(out_.soup.corners.size() - 1, kNoTextureCorner);
    out_.soup.texture_corners.push_back(textureIndex(uv));
  }

  void vertexTexture() { out_.soup.texture_corners.resize(out_.soup.corners.size(), out_.soup.corners.back()); }

  void endFace(std::uint64_t row, std::uint32_t surface) {
    auto& soup = out_.soup;
    const auto face = static_cast<std::uint32_t>(faceCount());
    soup.face_begins.push_back(soup.corners.size());
    if (soup.runs.empty() || soup.runs.back().surface != surface) soup.runs.push_back({face, face, 0, surface});
    soup.runs.back().end = face + 1;
    if (header_.form == PlyForm::text)
      out_.line_of_face.push_back(rows_.line());
    else
      out_.row_of_face.push_back(static_cast<std::uint32_t>(row));
  }

  // Each corner after the second makes a triangle with the two before it, turned every other time; -1 begins anew.
  Result<void> strips(const PlyElement& element) {
    const int indices = propertyOf(element, {"vertex_indices", "vertex_index"}, true);
    if (indices < 0)
      return failure(ErrorKind::unusable, "strips require a list vertex_indices",
                     name_ + " line " + std::to_string(element.line));
    return eachRow(element, [&](std::uint64_t i) -> Result<void> {
      const auto from = row_.begin[static_cast<std::size_t>(indices)],
                 n = row_.sizes[static_cast<std::size_t>(indices)];
      std::size_t length = 0;
      for (std::size_t k = 0; k < n; ++k) {
        const double* at = row_.values.data() + from + k;
        length = *at == -1 ? 0 : length + 1;
        if (length < 3) continue;
        const bool turned = length % 2 == 0;
        for (const double index : {turned ? at[-1] : at[-2], turned ? at[-2] : at[-1], at[0]}) {
          if (auto ok = corner(element, i, index); !ok) return ok;
          if (vertex_textured_) vertexTexture();
        }
        endFace(i, header_.texture_files.empty() ? 0 : 1);
      }
      return {};
    });
  }

  Result<void> skip(const PlyElement& element) {
    if (element.count > 0)
      report_.lose("line " + std::to_string(element.line),
                   std::to_string(element.count) + " of the element " + element.name.substr(0, 40) + " were skipped");
    return eachRow(element, [](std::uint64_t) { return Result<void>(); });
  }

  // Vertices may be bad as long as no face uses them.
  Result<void> checkCorners() {
    if (bad_.empty()) return {};
    for (const auto c : out_.soup.corners) {
      if (!std::isnan(out_.soup.positions[c].x())) continue;
      const auto known = std::find_if(bad_.begin(), bad_.end(), [&](const auto& b) { return b.first == c; });
      return failure(ErrorKind::unusable, "a coordinate is not a finite number below 1e13",
                     name_ + " " + (known == bad_.end() ? "vertex " + std::to_string(c) : known->second));
    }
    report_.warn(bad_.front().second, "vertices have non-finite coordinates; not used by any face");
    return {};
  }

  const PlyFileHeader& header_;
  const std::string& name_;
  Report& report_;
  Progress& progress_;
  PlyRows rows_;
  PlyRow row_;
  PlySoup out_;
  bool vertex_textured_ = false;
  std::vector<std::pair<std::uint64_t, std::string>> bad_;
  std::unordered_map<std::uint64_t, std::uint32_t> texture_of_;  // looked up only, never walked
  std::size_t short_faces_ = 0;
  std::string first_short_;
};

}  // namespace

Result<PlySoup> readPlySoup(const FileBytes& bytes, const PlyFileHeader& header, const std::string& name,
                            Report& report, Progress& progress) {
  return SoupReader(bytes, header, name, report, progress).run();
}

}  // namespace standpoint

// SPDX-License-Identifier: GPL-3.0-or-later
#include "pointclouds/e57/e57_pictures.h"

#include <array>
#include <cmath>

#include "pointclouds/e57/e57_scan_xml.h"
#include "pointclouds/files/number_text.h"
#include "pointclouds/files/raw_bytes.h"

namespace standpoint::e57 {
namespace {

constexpr std::size_t kBlobHeader = 16;
constexpr std::uint64_t kLargestPicture = std::uint64_t{1} << 30;
constexpr const char* kPictureStructure = "type=\"Structure\"";
constexpr const char* kJpeg = "image/jpeg";
constexpr const char* kPng = "image/png";

Result<std::vector<std::uint8_t>> readBlob(PagedReader& file, const Element& blob, const std::string& source) {
  const auto offset = numberFrom<std::uint64_t>(blob.attribute("fileOffset"));
  const auto length = numberFrom<std::uint64_t>(blob.attribute("length"));
  if (!offset || !length) return failure(ErrorKind::unusable, "the image has no fileOffset or length", source);
  if (*offset % kPageBytes >= kPayloadBytes || *offset >= file.physicalSize() || *length > kLargestPicture ||
      logicalFrom(*offset) + kBlobHeader + *length > file.logicalSize())
    return failure(ErrorKind::unusable, "the image is outside the file", source);
  std::array<std::uint8_t, kBlobHeader> header;
  TRY(file.read(logicalFrom(*offset), header));
  if (header[0] != 0) return failure(ErrorKind::unusable, "no blob section at the image's fileOffset", source);
  std::vector<std::uint8_t> bytes(*length);
  TRY(file.read(logicalFrom(*offset) + kBlobHeader, bytes));
  return bytes;
}

std::uint32_t countOf(const Element& parent, const char* name) {
  const double value = real(parent.child(name), 0);
  return value >= 1 && value <= 1 << 30 ? static_cast<std::uint32_t>(value) : 0;
}

}  // namespace

Result<std::uint64_t> writeBlob(PagedWriter& out, std::span<const std::uint8_t> bytes) {
  const std::uint64_t offset = physicalFrom(out.logicalSize());
  const std::size_t padding = (4 - bytes.size() % 4) % 4;
  std::array<std::uint8_t, kBlobHeader> header{};
  store<std::uint64_t>(header.data() + 8, kBlobHeader + bytes.size() + padding);
  TRY(out.append(header));
  TRY(out.append(bytes));
  constexpr std::array<std::uint8_t, 3> kZeros{};
  TRY(out.append({kZeros.data(), padding}));
  return offset;
}

void appendPicture(XmlWriter& xml, const StationPicture& picture, std::uint64_t blob_offset, const std::string& guid,
                   const std::string& scan_guid) {
  const bool pinhole = picture.projection == StationPicture::Projection::pinhole;
  const char* const representation = pinhole ? "pinholeRepresentation" : "sphericalRepresentation";
  xml.open("vectorChild", kPictureStructure);
  xml.string("guid", guid);
  if (!picture.name.empty()) xml.string("name", picture.name);
  xml.string("associatedData3DGuid", scan_guid);
  if (picture.acquired_gps_s > 0) appendTime(xml, "acquisitionDateTime", picture.acquired_gps_s);
  appendPose(xml, picture.file_from_camera);
  xml.open(representation, kPictureStructure);
  xml.leaf(picture.media_type == kPng ? "pngImage" : "jpegImage", "type=\"Blob\" fileOffset=\"" +
                                                                      numberText(blob_offset) + "\" length=\"" +
                                                                      numberText(picture.bytes.size()) + "\"");
  xml.integer("imageWidth", picture.width);
  xml.integer("imageHeight", picture.height);
  if (pinhole) xml.real("focalLength", picture.focal_length_m);
  xml.real("pixelWidth", picture.pixel_width);
  xml.real("pixelHeight", picture.pixel_height);
  if (pinhole) {
    xml.real("principalPointX", picture.principal_x);
    xml.real("principalPointY", picture.principal_y);
  }
  xml.close(representation);
  xml.close("vectorChild");
}

std::vector<std::vector<ListedPicture>> picturesOfScans(const Document& document, std::size_t scans, Report& report) {
  std::vector<std::vector<ListedPicture>> of_scan(scans);
  const Element* const images = document.root->child("images2D");
  if (!images) return of_scan;
  std::map<std::string, std::size_t> scan_of_guid;
  if (const Element* const data = document.root->child("data3D"))
    for (std::size_t i = 0; i < scans; ++i) scan_of_guid.emplace(text(*data->children[i], "guid"), i);
  std::size_t homeless = 0;
  for (std::size_t i = 0; i < images->children.size(); ++i) {
    const Element& image = *images->children[i];
    const std::string guid = text(image, "associatedData3DGuid");
    const auto found = scan_of_guid.find(guid);
    const bool only = scans == 1 && guid.empty();
    if (!only && (guid.empty() || found == scan_of_guid.end()))
      ++homeless;
    else
      of_scan[only ? 0 : found->second].push_back({&image, document.file.name() + " images2D/" + std::to_string(i)});
  }
  if (homeless > 0)
    report.lose(document.file.name(), std::to_string(homeless) + " images belong to no scan in the file");
  return of_scan;
}

Result<StationPicture> readPicture(PagedReader& file, const ListedPicture& listed, Report& report) {
  const Element& image = *listed.element;
  StationPicture picture;
  const Element* shape = image.child("sphericalRepresentation");
  if (!shape) {
    shape = image.child("pinholeRepresentation");
    picture.projection = StationPicture::Projection::pinhole;
  }
  if (!shape) return failure(ErrorKind::unusable, "only spherical and pinhole images are supported", listed.source);
  const Element* const jpeg = shape->child("jpegImage");
  const Element* const blob = jpeg ? jpeg : shape->child("pngImage");
  if (!blob) return failure(ErrorKind::unusable, "the image has neither jpegImage nor pngImage", listed.source);
  TRY_ASSIGN(auto bytes, readBlob(file, *blob, listed.source));
  picture.bytes = std::move(bytes);
  picture.media_type = jpeg ? kJpeg : kPng;
  picture.name = text(image, "name");
  picture.width = countOf(*shape, "imageWidth");
  picture.height = countOf(*shape, "imageHeight");
  picture.pixel_width = real(shape->child("pixelWidth"), 0);
  picture.pixel_height = real(shape->child("pixelHeight"), 0);
  picture.focal_length_m = real(shape->child("focalLength"), 0);
  picture.principal_x = real(shape->child("principalPointX"), 0);
  picture.principal_y = real(shape->child("principalPointY"), 0);
  picture.file_from_camera = readPose(image, listed.source, report);
  if (const Element* const time = image.child("acquisitionDateTime"))
    picture.acquired_gps_s = real(time->child("dateTimeValue"), 0);
  if (shape->child("imageMask")) report.warn(listed.source, "the image mask was skipped");
  return picture;
}

}  // namespace standpoint::e57

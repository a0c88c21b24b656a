// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/ply_header.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace standpoint {
namespace {

// Of the line that is refused, or nothing.
std::string refusal(const std::vector<const char*>& lines) {
  PlyHeaderLines header;
  for (const char* line : lines)
    if (const auto more = header.take(line); !more) return more.error().message;
  return {};
}

TEST(PlyHeader, HasItsElementsInOrderWithTheirPropertiesAndLines) {
  PlyHeaderLines lines;
  for (const char* line :
       {"ply\r", "format binary_big_endian 1.0", "comment element of nothing", "element vertex 12", "property float x",
        "", "property double  y", "element face 3", "property list uchar int vertex_indices"})
    EXPECT_TRUE(lines.take(line).value()) << line;
  EXPECT_FALSE(lines.take("end_header").value());
  const auto& header = lines.header();
  EXPECT_EQ(header.form, PlyForm::big_endian);
  ASSERT_EQ(header.elements.size(), 2U);
  EXPECT_EQ(header.elements[0].count, 12U);
  EXPECT_EQ(header.elements[0].line, 4U);
  EXPECT_EQ(header.elements[0].leastBytes(false), 12U);
  EXPECT_EQ(header.elements[0].properties[1].type, PlyType::float64);
  EXPECT_TRUE(header.elements[1].hasLists());
  EXPECT_EQ(header.elements[1].leastBytes(false), 1U) << "the count of an empty list";
}

TEST(PlyHeader, SaysWhatIsWrongWithALine) {
  using ::testing::HasSubstr;
  EXPECT_THAT(refusal({"plyx"}), HasSubstr("not a PLY file"));
  EXPECT_THAT(refusal({"ply", "end_header"}), HasSubstr("no format"));
  EXPECT_THAT(refusal({"ply", "format text 1.0"}), HasSubstr("format must be"));
  EXPECT_THAT(refusal({"ply", "property float x"}), HasSubstr("before the first element"));
  EXPECT_THAT(refusal({"ply", "element vertex -1"}), HasSubstr("'-1' is not a count"));
  EXPECT_THAT(refusal({"ply", "element vertex 1", "element vertex 1"}), HasSubstr("duplicate element 'vertex'"));
  EXPECT_THAT(refusal({"ply", "element vertex 1", "property float128 x"}), HasSubstr("'float128' is not a property"));
  EXPECT_THAT(refusal({"ply", "element face 1", "property list float int i"}), HasSubstr("floating-point"));
  EXPECT_THAT(refusal({"ply", "vertices 3"}), HasSubstr("unknown PLY header entry 'vertices'"));
}

}  // namespace
}  // namespace standpoint

// SPDX-License-Identifier: GPL-3.0-or-later
#include "tests/importers/dxf_files.h"

namespace standpoint::test {
namespace {

using ::testing::AnyOf;
using ::testing::HasSubstr;
using ::testing::IsEmpty;
using ::testing::StartsWith;

std::string refusedEntities(const std::string& entities) { return refusedDxf(DxfText{.entities = entities}.text()); }

// One of each.
DxfText wholeDxf() {
  return {
      .layers = "0 LAYER|2 Walls|70 0|62 4",
      .blocks = "0 BLOCK|8 0|2 Part|70 0|10 1|20 0|30 0|" + kDxfTriangle + "|0 ENDBLK",
      .entities = kDxfTriangle +
                  "|0 POLYLINE|8 Walls|66 1|70 64|0 VERTEX|70 192|10 0|20 0|30 0|0 VERTEX|70 192|10 1|20 0|30 0|0 "
                  "VERTEX|70 192|10 0|20 1|30 0|0 VERTEX|70 128|71 1|72 -2|73 3|0 SEQEND|0 "
                  "POLYLINE|66 1|70 16|71 2|72 2|0 VERTEX|70 64|10 0|20 0|30 0|0 VERTEX|70 64|10 1|20 0|30 0|0 "
                  "VERTEX|70 64|10 0|20 1|30 0|0 VERTEX|70 64|10 1|20 1|30 0|0 SEQEND|0 MESH|91 0|92 3|10 0|20 0|30 "
                  "0|10 1|20 0|30 0|10 0|20 1|30 0|93 4|90 3|90 0|90 1|90 2|94 0|95 0|90 0|0 INSERT|8 Walls|66 1|2 "
                  "Part|10 9|20 9|30 9|41 2|42 2|43 2|50 30|70 2|71 2|44 3|45 3|210 0|220 1|230 0|0 ATTRIB|2 A|1 B|0 "
                  "SEQEND|0 CIRCLE|39 1|10 0|20 0|30 0|40 1|0 LWPOLYLINE|90 2|70 1|39 1|10 0|20 0|42 0.5|10 1|20 0|0 "
                  "3DSOLID|1 acis"};
}

TEST(HostileDxf, SaysWhichOtherFormItIs) {
  EXPECT_THAT(refusedDxf(std::string("AutoCAD Binary DXF\r\n\x1A\0", 22)),
              HasSubstr("a.dxf: is a binary DXF; save it as a text (ASCII) DXF"));
  EXPECT_THAT(refusal(write(scratch() / "plan.dwg", "AC1032" + std::string(100, '\0'))),
              HasSubstr("plan.dwg: is a DWG; save it as DXF"));
  EXPECT_THAT(refusedDxf(""), HasSubstr("a.dxf line 1: is not DXF: it does not begin with a SECTION"));
  EXPECT_THAT(refusedDxf("  0\nHELLO\n"), HasSubstr("a.dxf line 2: is not DXF"));
  EXPECT_THAT(refusedDxf("hello\nyou\n"), HasSubstr("a.dxf line 1: 'hello' is not a group code"));
}

TEST(HostileDxf, IsRefusedByLine) {
  const std::string head = "0 3DFACE|8 0|";
  for (const char* number : {"nan", "inf", "1e400", "1e99"})
    EXPECT_THAT(refusedEntities(head + "10 " + number),
                AnyOf(HasSubstr("a.dxf line 24: a number is not finite and below 1e13"),
                      HasSubstr("a.dxf line 24: '" + std::string(number) + "' is not a number")));
  EXPECT_THAT(refusedEntities(head + "10 1,5"), HasSubstr("line 24: '1,5' is not a number"));
  EXPECT_THAT(refusedEntities("0 POLYLINE|70 64|0 VERTEX|70 192|10 0|20 0|30 0|0 VERTEX|70 128|71 1|72 2|73 3"),
              HasSubstr("refers to vertex 2; there are 1"));
  EXPECT_THAT(refusedEntities("0 MESH|92 3|10 0|20 0|30 0|93 4|90 3|90 0|90 1|90 2"),
              HasSubstr("a.dxf line 36: refers to vertex 1; there are 1"));
  EXPECT_THAT(refusedEntities("0 MESH|92 3|10 0|20 0|30 0|93 4|90 3|90 0"), HasSubstr("the list of faces ends early"));
  EXPECT_THAT(refusedEntities("0 MESH|93 4|90 4"), HasSubstr("a face has more corners than its list has items"));
  EXPECT_THAT(refusedDxf(dxfGroups("0 SECTION|2 ENTITIES|0 SECTION|2 BLOCKS")),
              HasSubstr("line 6: a section begins inside a section"));
  EXPECT_THAT(refusedDxf(dxfGroups("0 SECTION|2 ENTITIES") + "8\n" + std::string(3 << 20, 'x')),
              HasSubstr("line 6: is longer than 1 MiB"));
}

TEST(HostileDxf, TakesNoCountAtItsWord) {
  for (const char* entities :
       {"0 MESH|92 2000000000|93 2000000000|90 2000000000", "0 LWPOLYLINE|90 2000000000|39 1|10 0|20 0",
        "0 POLYLINE|70 16|71 2000000000|72 2000000000|0 SEQEND", "0 SPLINE|72 2000000000|73 2000000000|40 1",
        "0 HATCH|91 2000000000|93 2000000000"})
    EXPECT_NO_FATAL_FAILURE(refusedEntities(entities)) << entities;
  // A circle of a million kilometres.
  EXPECT_EQ(refusedEntities("0 CIRCLE|39 1|10 0|20 0|40 1e9"), "accepted");
}

TEST(HostileDxf, CutsABlockThatIsInsertedInItself) {
  const auto model = dxf(DxfText{.blocks = "0 BLOCK|2 A|" + kDxfTriangle + "|0 INSERT|2 B|0 ENDBLK|0 BLOCK|2 B|" +
                                           kDxfTriangle + "|0 INSERT|2 A|10 1|20 0|30 0|0 ENDBLK",
                                 .entities = "0 INSERT|2 A"}
                             .text());
  ASSERT_TRUE(model) << describe(model.error());
  EXPECT_EQ(model->environment.products.size(), 2U);
  EXPECT_THAT(toldByDxf(*model), HasSubstr("blocks that contain themselves, the inner one left out: 1"));
}

TEST(HostileDxf, RefusesWhatGrowsWithoutBound) {
  const auto part = "0 BLOCK|2 B0|" + kDxfTriangle + "|0 ENDBLK";
  EXPECT_THAT(refusedDxf(DxfText{.blocks = part, .entities = "0 INSERT|2 B0|70 2000000000|71 2000000000"}.text()),
              HasSubstr("exceeds the limit of 20 000 000 placed corners"));
  EXPECT_THAT(refusedDxf(DxfText{.blocks = part, .entities = "0 INSERT|2 B0|70 7000000|71 1"}.text()),
              HasSubstr("exceeds the limit of 20 000 000 placed corners"));
  std::string tree = part, chain = part, empty = "0 BLOCK|2 B0|0 ENDBLK";
  for (int i = 1; i <= 70; ++i) {
    const std::string begin = "|0 BLOCK|2 B" + std::to_string(i), insert = "|0 INSERT|2 B" + std::to_string(i - 1);
    std::string ten;
    for (int k = 0; k < 10; ++k) ten += insert;
    if (i <= 30) tree += begin + ten + "|0 ENDBLK", empty += begin + ten + "|0 ENDBLK";
    chain += begin + insert + "|0 ENDBLK";
  }
  EXPECT_THAT(refusedDxf(DxfText{.blocks = tree, .entities = "0 INSERT|2 B30"}.text()),
              HasSubstr("exceeds the limit of"));
  EXPECT_THAT(refusedDxf(DxfText{.blocks = chain, .entities = "0 INSERT|2 B70"}.text()),
              HasSubstr("blocks are nested more than 64 deep"));
  EXPECT_EQ(refusedDxf(DxfText{.blocks = chain, .entities = "0 INSERT|2 B60"}.text()), "accepted");
  EXPECT_EQ(refusedDxf(DxfText{.blocks = empty, .entities = "0 INSERT|2 B30"}.text()), "accepted");
}

TEST(HostileDxf, RefusesChordsWithoutBound) {
  std::string arcs = "0 LWPOLYLINE|39 1";
  for (int i = 0; i < 3000; ++i) arcs += i % 2 == 0 ? "|10 0|20 0|42 1" : "|10 1e12|20 0|42 1";
  EXPECT_THAT(refusedEntities(arcs), HasSubstr("exceeds the limit of 5 000 000 chords of arcs"));
}

TEST(HostileDxf, IsRefusedOrReadWhereverItEnds) {
  const std::string whole = wholeDxf().text();
  ASSERT_EQ(refusedDxf(whole), "accepted");
  const auto file = scratch() / "cut.dxf";
  const std::size_t begin = whole.rfind("ENTITIES"), end = whole.rfind("ENDSEC");
  for (std::size_t size = 0; size < whole.size(); size += 3) {
    const std::string answer = refusal(write(file, whole.substr(0, size)));
    EXPECT_THAT(answer, AnyOf(StartsWith("cut.dxf line "), "accepted")) << size;
    EXPECT_FALSE(answer == "accepted" && size >= begin && size < end) << size;
  }
}

TEST(HostileDxf, SurvivesChangedBytes) {
  const std::string whole = wholeDxf().text();
  for (std::uint32_t round = 0; round < 600; ++round) {
    std::string text = whole;
    for (std::uint32_t i = 0; i < 4; ++i) {
      const std::uint64_t at = (round * 2654435761U + i * 40503U * (round + 7)) % text.size();
      text[at] = static_cast<char>("0197-.\n \xE4x"[(round + i) % 10]);
    }
    const auto model = dxf(text);
    EXPECT_THAT(model ? validate(model->environment) : std::string(), IsEmpty());
    EXPECT_TRUE(model || !model.error().source.empty());
  }
}

}  // namespace
}  // namespace standpoint::test

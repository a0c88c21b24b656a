// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/random.h"
#include "tests/importers/mesh_files.h"

namespace standpoint::test {
namespace {

using ::testing::HasSubstr;

Result<ImportedModel> hostileObj(const std::string& text) { return import(write(scratch() / "a.obj", text)); }
std::string refusedObj(const std::string& text) { return refusal(write(scratch() / "a.obj", text)); }

const std::string kThree = "v 0 0 0\nv 1 0 0\nv 0 1 0\n";

TEST(ObjHostile, WrongNumbersOfAVertexThatAFaceUsesAreRefusedWithTheirLine) {
  const std::string face = "v 1 0 0\nv 0 1 0\nf 1 2 3\n";
  EXPECT_THAT(refusedObj("# a\nv nan 0 0\n" + face), HasSubstr("a.obj line 2: a coordinate is not a finite number"));
  EXPECT_THAT(refusedObj("v 1 -inf 0\n" + face), HasSubstr("line 1"));
  EXPECT_THAT(refusedObj("v 0 0 1e999\n" + face), HasSubstr("line 1: a coordinate is not a finite number"));
  EXPECT_THAT(refusedObj("v 0 0 1e300\n" + face), HasSubstr("line 1: a coordinate exceeds 1e13"));
  EXPECT_THAT(refusedObj("v 0 0\n" + face), HasSubstr("line 1: a vertex requires three numbers"));
  EXPECT_THAT(refusedObj("v\n" + face), HasSubstr("line 1: a vertex requires three numbers"));
  EXPECT_THAT(refusedObj("v 1,5 0 0\n" + face), HasSubstr("line 1: a coordinate is not a number"));
  EXPECT_THAT(refusedObj("v 1.#IND 0 0\n" + face), HasSubstr("line 1"));
}

TEST(ObjHostile, AWrongVertexThatNoFaceUsesKeepsItsNumberAndIsSaid) {
  const auto model = hostileObj("v 3.1+e2 0 0\n" + kThree + "f 2 3 4\n");
  ASSERT_TRUE(model) << describe(model.error());
  ASSERT_EQ(model->report.issues.size(), 1U);
  EXPECT_EQ(model->report.issues[0].source, "line 1");
  EXPECT_EQ(triangleCount(model->environment), 1U);
}

TEST(ObjHostile, WrongIndicesAreRefusedWithTheirLine) {
  EXPECT_THAT(refusedObj("v 0 0 0\n\n# note\nf 1 1 4\n"), HasSubstr("line 4: refers to vertex 4, but there are 1"));
  EXPECT_THAT(refusedObj("v 0 0 0\nf 1 0 1\n"), HasSubstr("line 2: corner 2"));
  EXPECT_THAT(refusedObj("v 0 0 0\nf 1 1 -2\n"), HasSubstr("line 2: refers to vertex -2, but only 1 precede it"));
  EXPECT_THAT(refusedObj("v 0 0 0\nf 1 1 4294967297\n"),
              HasSubstr("line 2: corner 3 of the face has an index of more than nine digits"));
  EXPECT_THAT(refusedObj("v 0 0 0\nf 1 1 -99999999999999999999\n"), HasSubstr("line 2"));
  EXPECT_THAT(refusedObj("v 0 0 0\nf a b c\n"), HasSubstr("line 2: corner 1 of the face has no vertex number"));
  EXPECT_THAT(refusedObj("v 0 0 0\nf 1 1 1.5\n"),
              HasSubstr("line 2: corner 3 of the face must be v, v/t, v//n or v/t/n"));
  EXPECT_THAT(refusedObj(kThree + "f 1/1/1/1 2 3\n"), HasSubstr("line 4"));
}

TEST(ObjHostile, FacesMayComeBeforeTheirVertices) {
  const auto model = hostileObj("f 1 2 3\n" + kThree);
  ASSERT_TRUE(model);
  EXPECT_EQ(triangleCount(model->environment), 1U);
}

TEST(ObjHostile, ListsOnceWhatIsNotASurface) {
  const auto model =
      hostileObj(kThree + "p 1\nl 1 2\nl 2 3\ncstype bezier\ncurv 0 1 1 2\nend\nf 1 2\nf 1 2 3\ncall other.obj\ns 1\n");
  ASSERT_TRUE(model);
  EXPECT_EQ(model->report.losses(), 5U);
  EXPECT_EQ(model->report.issues.at(1).source, "line 5");
  EXPECT_THAT(model->report.issues.at(1).message, HasSubstr("line statements skipped (not a surface): 2"));
}

TEST(ObjHostile, ATextureCoordinateThatIsNotThereCostsItsCornerOnly) {
  const auto model = hostileObj(kThree + "vt 0 0\nf 1/1 2/7 3/-4\n");
  ASSERT_TRUE(model);
  EXPECT_EQ(model->environment.meshes.at(0)->triangles.size(), 1U);
  ASSERT_EQ(model->report.losses(), 1U);
  EXPECT_EQ(model->report.issues.at(0).source, "line 5");
  EXPECT_THAT(model->report.issues.at(0).message, HasSubstr("texture coordinates missing or not numbers: 2"));
}

TEST(ObjHostile, SomethingElseOfThatNameIsRefused) {
  EXPECT_THAT(refusedObj("\x64\x86\x07 .text code of a compiler\n"),
              HasSubstr("a.obj line 1: contains no OBJ statements"));
  EXPECT_TRUE(hostileObj("# nothing\n"));
  EXPECT_TRUE(hostileObj(""));
}

TEST(ObjHostile, OneLineOfManyMegabytesIsRead) {
  std::string text = kThree + "f 1 2 3\n# " + std::string(3'000'000, '#') + "\nf 3 2 1\nf";
  for (int i = 0; i < 100'000; ++i) text += " 1 2 3";
  const auto model = hostileObj(text);
  ASSERT_TRUE(model) << describe(model.error());
  EXPECT_GE(triangleCount(model->environment), 2U);
}

TEST(ObjHostile, AnOutlineThatCrossesItselfAThousandTimesIsSaid) {
  std::string text, face = "f";
  for (std::uint32_t i = 0; i < 3000; ++i) {
    const auto r = philox({6, 0}, i, 0, 0);
    text += "v " + std::to_string(uniform(r[0])) + " " + std::to_string(uniform(r[1])) + " 0\n";
    face += " " + std::to_string(i + 1);
  }
  const auto model = hostileObj(text + face);
  ASSERT_TRUE(model);
  EXPECT_THAT(model->report.issues.at(0).message, HasSubstr("intersect themselves"));
}

TEST(ObjHostile, CutOffAnywhereItIsAModelOrAnErrorWithItsLine) {
  const std::string text = "mtllib a.mtl\no a\ng b\nusemtl c\n" + kThree +
                           "v 0 0 1 1 0 0\nvt 0 0\nvn 0 0 1\nf 1/1/1 2//1 3\nf 1 2 \\\n -1\nl 1 2\n";
  const auto file = scratch() / "cut.obj";
  for (std::size_t length = 0; length <= text.size(); ++length) {
    const auto model = import(write(file, text.substr(0, length)));
    EXPECT_EQ(model ? validate(model->environment) : "", "") << length;
    EXPECT_THAT(model ? "cut.obj line " : model.error().source, HasSubstr("cut.obj line ")) << length;
  }
}

TEST(ObjHostile, RandomBytesAreAModelOrAnError) {
  const std::string text =
      "mtllib a.mtl\no a\ng b\nusemtl c\n" + kThree + "f 1 2 3\nf -1 -2 -3\nl 1 2\ncurv 1 2\nf 1/1/1 2//2 -1\n";
  const auto file = scratch() / "mutated.obj";
  for (std::uint32_t round = 0; round < 150; ++round) {
    auto mutated = text;
    const auto r = philox({9, 0}, round, 0, 0);
    for (int k = 0; k < 3; ++k)
      mutated[r[static_cast<std::size_t>(k)] % mutated.size()] = static_cast<char>(r[3] >> (8 * k));
    const auto model = import(write(file, mutated));
    EXPECT_EQ(model ? validate(model->environment) : "", "");
  }
}

}  // namespace
}  // namespace standpoint::test

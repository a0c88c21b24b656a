// SPDX-License-Identifier: GPL-3.0-or-later
#include <cmath>

#include "core/random.h"
#include "tests/importers/mesh_files.h"

namespace standpoint::test {
namespace {

using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::SizeIs;

struct Facet {
  std::array<float, 9> corners;
  std::uint16_t word = 0;
};

template <class T>
void putBytes(std::string& to, T value) {
  to.append(reinterpret_cast<const char*>(&value), sizeof value);  // of a little-endian machine
}

std::string binary(std::string header, const std::vector<Facet>& facets) {
  header.resize(80, ' ');
  putBytes(header, static_cast<std::uint32_t>(facets.size()));
  for (const auto& f : facets) {
    for (int i = 0; i < 3; ++i) putBytes(header, NAN);  // a normal that nobody needs
    for (const float c : f.corners) putBytes(header, c);
    putBytes(header, f.word);
  }
  return header;
}

// A tetrahedron on the axes, outward: volume 1/6.
const std::vector<Facet> kTetrahedron = {{{0, 0, 0, 0, 1, 0, 1, 0, 0}},
                                         {{0, 0, 0, 1, 0, 0, 0, 0, 1}},
                                         {{-0.F, 0, 0, 0, 0, 1, 0, 1, 0}},
                                         {{1, 0, 0, 0, 1, 0, 0, 0, 1}}};

std::string textSolid(const std::string& name) {
  std::string out = "solid " + name + "\n";
  for (const auto& f : kTetrahedron) {
    out += "  facet normal nan nan nan\n    outer loop\n";
    for (std::size_t i = 0; i < 9; i += 3)
      out += "      vertex " + std::to_string(f.corners[i]) + " " + std::to_string(f.corners[i + 1]) + " " +
             std::to_string(f.corners[i + 2]) + "\n";
    out += "    endloop\n  endfacet\n";
  }
  return out + "endsolid " + name + "\n";
}

Result<ImportedModel> stl(const std::string& bytes) { return import(write(scratch() / "a.stl", bytes)); }
std::string refusedStl(const std::string& bytes) { return refusal(write(scratch() / "a.stl", bytes)); }

TEST(Stl, BinaryAndTextAreWeldedToTheSameClosedSolid) {
  for (const auto& bytes :
       {binary("made by a test", kTetrahedron), binary("solid made by a test", kTetrahedron), textSolid("pyramid")}) {
    const auto model = stl(bytes);
    ASSERT_TRUE(model) << describe(model.error());
    const auto& mesh = *model->environment.meshes.at(0);
    EXPECT_THAT(mesh.positions, SizeIs(4));
    EXPECT_TRUE(isClosed(mesh));
    EXPECT_NEAR(volume(mesh), 1.0 / 6, 1e-7);
    EXPECT_TRUE(model->report.issues.empty());
  }
}

TEST(Stl, ABinaryFileIsKnownByItsSizeWhateverItIsCalled) {
  const auto model = import(write(scratch() / "a.dat", binary("nothing", kTetrahedron)));
  ASSERT_TRUE(model) << describe(model.error());
  EXPECT_EQ(triangleCount(model->environment), 4U);
}

TEST(Stl, AFileOfAnotherKindIsNotTakenForOne) {
  for (const auto& bytes : {std::string(500, 'x'), binary("nothing", kTetrahedron) + "more"}) {
    const auto model = import(write(scratch() / "a.dat", bytes));
    ASSERT_FALSE(model);
    EXPECT_THAT(describe(model.error()), HasSubstr("a.dat: unsupported format; use IFC"));
  }
}

TEST(Stl, SolidsOfATextBecomeProducts) {
  const auto model = stl(textSolid("one and a half") + textSolid("") + textSolid("three"));
  ASSERT_TRUE(model) << describe(model.error());
  const auto& p = model->environment.products;
  ASSERT_THAT(p, SizeIs(3));
  EXPECT_EQ(p[0].name, "one and a half");
  EXPECT_EQ(p[1].name, "a");
  EXPECT_EQ(p[2].id, "solid 3");
}

TEST(Stl, ColoursAreReadAsVisCamAndAsMagicsWriteThem) {
  auto facets = kTetrahedron;
  for (auto& f : facets) f.word = 0x8000U | 31U << 10U;  // VisCAM: red
  facets[3].word = 0;
  const auto viscam = stl(binary("VisCAM", facets));
  ASSERT_TRUE(viscam);
  EXPECT_THAT(viscam->environment.products.at(0).materials, ElementsAre("", "#ff0000"));
  for (auto& f : facets) f.word = 31U << 10U;  // Magics: blue
  facets[3].word = 0x8000U;                    // the default of the header
  const auto magics = stl(binary(std::string("COLOR=\x10\x20\x30\xFF", 10), facets));
  ASSERT_TRUE(magics);
  EXPECT_THAT(magics->environment.products.at(0).materials, ElementsAre("#0000ff", "#102030"));
}

TEST(Stl, ManyColoursBecomeColoursOfTheVertices) {
  std::vector<Facet> facets;
  for (std::uint16_t i = 0; i < 300; ++i) {
    const auto x = static_cast<float>(i);
    facets.push_back({{x, 0, 0, x + 1, 0, 0, x, 1, 0}, static_cast<std::uint16_t>(0x8000U | i)});
  }
  const auto model = stl(binary("VisCAM", facets));
  ASSERT_TRUE(model);
  EXPECT_THAT(model->environment.surfaces, SizeIs(1));
  EXPECT_THAT(model->environment.meshes.at(0)->colours, SizeIs(900));
}

TEST(StlHostile, WhatIsWrongIsRefusedWithItsPlace) {
  auto nan = kTetrahedron;
  nan[1].corners[4] = NAN;
  EXPECT_THAT(refusedStl(binary("x", nan)), HasSubstr("a.stl triangle 2: a coordinate is not a finite number"));
  EXPECT_THAT(refusedStl(binary("x", kTetrahedron).substr(0, 200)), HasSubstr("says 4 triangles, but has data for 2"));
  EXPECT_THAT(refusedStl(std::string(80, 'x') + "\xFF\xFF\xFF\xFF"), HasSubstr("says 4294967295 triangles"));
  EXPECT_THAT(refusedStl("solid a\nfacet\nouter loop\nvertex 0 0\n"),
              HasSubstr("line 4: a vertex requires three numbers"));
  EXPECT_THAT(refusedStl("solid a\nfacet\nouter loop\nvertex 0 0 inf\n"),
              HasSubstr("line 4: a coordinate is not a finite number"));
  EXPECT_THAT(refusedStl("solid a\nfacet\nvertex 0 0 0\nendfacet\n"),
              HasSubstr("line 4: facet without three vertices"));
  EXPECT_THAT(refusedStl("solid a\nvertex 0 0 0\n"), HasSubstr("line 2"));
  EXPECT_THAT(refusedStl("solid a\nfacet\nvertex 0 0 0\n"), HasSubstr("ends inside a facet"));
  EXPECT_THAT(refusedStl("solid a\nhello\n"), HasSubstr("line 2: 'hello' is not an STL keyword"));
  EXPECT_THAT(refusedStl("short"), HasSubstr("a.stl line 1"));
}

TEST(StlHostile, CutOffOrMutatedItIsAModelOrAnErrorWithItsPlace) {
  const auto file = scratch() / "cut.stl";
  for (const std::string& whole : {binary("x", kTetrahedron), textSolid("x")}) {
    for (std::size_t length = 0; length < whole.size(); length += 3) {
      const auto model = import(write(file, whole.substr(0, length)));
      EXPECT_THAT(model ? "cut.stl" : describe(model.error()), HasSubstr("cut.stl")) << length;
    }
    for (std::uint32_t round = 0; round < 100; ++round) {
      auto mutated = whole;
      const auto r = philox({11, 0}, round, 0, 0);
      mutated[r[0] % mutated.size()] = static_cast<char>(r[1]);
      const auto model = import(write(file, mutated));
      EXPECT_EQ(model ? validate(model->environment) : "", "");
    }
  }
}

}  // namespace
}  // namespace standpoint::test

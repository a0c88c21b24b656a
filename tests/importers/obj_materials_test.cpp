// SPDX-License-Identifier: GPL-3.0-or-later
#include <sys/stat.h>

#include "importers/obj/mtl.h"
#include "tests/importers/mesh_files.h"

namespace standpoint::test {
namespace {

using ::testing::Contains;
using ::testing::ElementsAre;
using ::testing::Field;
using ::testing::HasSubstr;
using ::testing::IsEmpty;
using ::testing::SizeIs;

const std::string kOneTriangle = "v 0 0 0\nv 1 0 0\nv 0 1 0\nvt 0 0\nvt 1 0\nvt 0 1\n";
const std::string kPngFile = "\x89PNG\r\n\x1A\nrest";

auto saysOnce(Severity severity, const std::string& text) {
  return Contains(::testing::AllOf(Field(&Issue::severity, severity), Field(&Issue::message, HasSubstr(text))));
}

Surface mtl(const std::string& text) {
  Report report;
  const auto all = parseMtl("newmtl a\n" + text + "\n", "a.mtl", report);
  EXPECT_THAT(report.issues, IsEmpty());
  return all.at(0).surface;
}

TEST(ObjMaterials, ComeFromTheMtlAndAMissingOneIsAWarning) {
  const auto folder = scratch();
  write(folder / "two words.mtl", "newmtl Red brick\nKd 0.5 0.25 0.125\nd 0.5\nPr 0.75\n");
  const auto model = import(write(folder / "a.obj",
                                  "mtllib two words.mtl\nmtllib none.mtl\nv 0 0 0\nv 1 0 0\nv 0 1 0\n"
                                  "usemtl Red brick\nf 1 2 3\nusemtl other\nf 1 3 2\n"));
  ASSERT_TRUE(model) << describe(model.error());
  const auto& s = model->environment.surfaces;
  ASSERT_EQ(s.size(), 2U);
  EXPECT_EQ(s[0].colour, (Colour{0.5F, 0.25F, 0.125F, 0.5F}));
  EXPECT_EQ(s[0].roughness, 0.75F);
  EXPECT_EQ(s[0].transmission, 0.5F);
  EXPECT_EQ(s[0].source, "newmtl Red brick");
  EXPECT_THAT(model->environment.products.at(0).materials, ElementsAre("Red brick", "other"));
  ASSERT_EQ(model->report.issues.size(), 2U);
  EXPECT_EQ(model->report.issues[0].severity, Severity::warning);
  EXPECT_EQ(model->report.issues[0].source, "line 2");
  EXPECT_EQ(model->report.issues[1].source, "line 8");
}

TEST(ObjMaterials, SeveralLibrariesOnALineAndUseBeforeTheyAreNamed) {
  const auto folder = scratch();
  write(folder / "a.mtl", "newmtl a\nKd 1 0 0\n");
  write(folder / "b.mtl", "newmtl b\nKd 0 1 0\nnewmtl a\nKd 0 0 0\n");
  const auto model =
      import(write(folder / "m.obj", kOneTriangle + "usemtl b\nf 1 2 3\nusemtl a\nf 3 2 1\nmtllib a.mtl b.mtl\n"));
  ASSERT_TRUE(model);
  EXPECT_EQ(model->environment.surfaces.at(0).colour, (Colour{0, 1, 0, 1}));
  EXPECT_EQ(model->environment.surfaces.at(1).colour, (Colour{1, 0, 0, 1}));
  EXPECT_THAT(model->report.issues, IsEmpty());
}

TEST(ObjMaterials, DissolveWinsOverTransparencyWhicheverComesFirst) {
  EXPECT_EQ(mtl("Tr 0.9\nd 0.25").colour.a, 0.25F);
  EXPECT_EQ(mtl("d 0.25\nTr 0.9").colour.a, 0.25F);
  EXPECT_EQ(mtl("Tr 0.75").transmission, 0.75F);
  EXPECT_EQ(mtl("d -halo 0.5").colour.a, 0.5F);
  EXPECT_FALSE(mtl("d 1").transmission);
}

TEST(ObjMaterials, PhysicalValuesAreKept) {
  const auto s = mtl("Kd 0.5\nNi 1.45\nPr 0.2\nPm 1\nPc 0.5\nKs 0.1 0.4 0.2");
  EXPECT_EQ(s.colour, (Colour{0.5F, 0.5F, 0.5F, 1}));
  EXPECT_EQ(s.index_of_refraction, 1.45F);
  EXPECT_EQ(s.roughness, 0.2F);
  EXPECT_EQ(s.metallic, 1.0F);
  EXPECT_EQ(s.clearcoat, 0.5F);
  EXPECT_EQ(s.specular, 0.4F);
  EXPECT_FALSE(mtl("Ni 1").index_of_refraction);  // what exporters write for nothing
  EXPECT_TRUE(mtl("illum 0").unlit);
}

TEST(ObjMaterials, WrongNumbersAreSaidWithTheirLine) {
  Report report;
  const auto all = parseMtl("newmtl a\r\nKd nan 0 0\r\nd one\r\nfoo 1\r\n", "a.mtl", report);
  EXPECT_EQ(all.at(0).surface.colour, Colour());
  ASSERT_THAT(report.issues, SizeIs(3));
  EXPECT_EQ(report.issues[0].source, "a.mtl line 2");
  EXPECT_EQ(report.issues[1].source, "a.mtl line 3");
  EXPECT_EQ(report.issues[2].source, "a.mtl line 4");
}

TEST(ObjMaterials, OptionsOfATextureAreToldFromItsName) {
  Report report;
  const auto name = [&](const std::string& map) {
    return parseMtl("newmtl a\nmap_Kd " + map + "\n", "a.mtl", report).at(0).texture;
  };
  EXPECT_EQ(name("brick wall.png"), "brick wall.png");
  EXPECT_EQ(name("-s 2 2 2 -o 0.5 -clamp on -blendu off -mm 0 1 -imfchan r a b.png"), "a b.png");
  EXPECT_EQ(name("-texres 512 1.png"), "1.png");
  EXPECT_EQ(name("-1.png"), "-1.png");
}

TEST(ObjMaterials, ATextureStaysEncodedAndItsScaleGoesIntoTheCoordinates) {
  const auto folder = scratch();
  std::filesystem::create_directories(folder / "maps");
  write(folder / "maps" / "Brick Wall.PNG", kPngFile);
  write(folder / "a.mtl", "newmtl a\nmap_Kd -s 2 4 -o 0.5 0 maps\\brick wall.png\n");
  const auto model = import(write(folder / "a.obj", "mtllib a.mtl\n" + kOneTriangle + "usemtl a\nf 1/1 2/2 3/3\n"));
  ASSERT_TRUE(model);
  const auto& e = model->environment;
  ASSERT_EQ(e.images.size(), 1U);
  EXPECT_EQ(e.images[0]->media_type, "image/png");
  EXPECT_EQ(std::string(reinterpret_cast<const char*>(e.images[0]->bytes.data()), e.images[0]->bytes.size()), kPngFile);
  EXPECT_EQ(e.surfaces.at(0).image, 0);
  // (u, v) from the bottom become (2 u + 0.5, 4 v), then v counts from the top.
  EXPECT_THAT(e.meshes.at(0)->texture_coordinates,
              ElementsAre(Eigen::Vector2f(0.5F, 1), Eigen::Vector2f(2.5F, 1), Eigen::Vector2f(0.5F, -3)));
  EXPECT_THAT(model->report.issues, saysOnce(Severity::note, "is taken from Brick Wall.PNG"));
}

TEST(ObjMaterials, NothingOutsideTheModelsFolderIsRead) {
  const auto folder = scratch();
  std::filesystem::create_directories(folder / "model");
  write(folder / "out.png", kPngFile);
  write(folder / "out.mtl", "newmtl a\nKd 1 0 0\n");
  std::filesystem::create_symlink(folder / "out.png", folder / "model" / "link.png");
  const std::vector<std::string> names = {"../out.png", (folder / "out.png").string(), "link.png", "C:\\out.png",
                                          "..\\out.png"};
  for (const auto& name : names) {
    write(folder / "model" / "a.mtl", "newmtl a\nmap_Kd " + name + "\n");
    const auto model =
        import(write(folder / "model" / "a.obj", "mtllib a.mtl\n" + kOneTriangle + "usemtl a\nf 1/1 2/2 3/3\n"));
    ASSERT_TRUE(model);
    EXPECT_THAT(model->environment.images, IsEmpty()) << name;
    EXPECT_THAT(model->report.issues, saysOnce(Severity::loss, "outside the model's folder")) << name;
  }
  const auto model =
      import(write(folder / "model" / "a.obj", "mtllib ../out.mtl\n" + kOneTriangle + "usemtl a\nf 1 2 3\n"));
  EXPECT_EQ(model->environment.surfaces.at(0).colour, Colour());
}

TEST(ObjMaterials, APathOfAnotherMachineFindsTheFileBesideTheModel) {
  const auto folder = scratch();
  write(folder / "brick.jpg", "\xFF\xD8\xFFrest");
  write(folder / "a.mtl", "newmtl a\nmap_Kd C:\\Users\\me\\brick.jpg\n");
  const auto model = import(write(folder / "a.obj", "mtllib a.mtl\n" + kOneTriangle + "usemtl a\nf 1/1 2/2 3/3\n"));
  ASSERT_TRUE(model);
  ASSERT_THAT(model->environment.images, SizeIs(1));
  EXPECT_EQ(model->environment.images[0]->media_type, "image/jpeg");
  EXPECT_THAT(model->report.issues, saysOnce(Severity::note, "is taken from brick.jpg"));
}

TEST(ObjMaterials, OtherImageFormatsAndCutoutsAreLossesByName) {
  const auto folder = scratch();
  write(folder / "a.tga", "not an image");
  write(folder / "a.mtl", "newmtl a\nmap_Kd a.tga\nmap_d holes.png\nmap_Bump bump.png\n");
  const auto model = import(write(folder / "a.obj", "mtllib a.mtl\n" + kOneTriangle + "usemtl a\nf 1/1 2/2 3/3\n"));
  ASSERT_TRUE(model);
  EXPECT_THAT(model->report.issues, saysOnce(Severity::loss, "'a.tga' is neither PNG nor JPEG"));
  EXPECT_THAT(model->report.issues, saysOnce(Severity::loss, "holes.png"));
  EXPECT_THAT(model->report.issues, saysOnce(Severity::note, "map_bump"));
}

TEST(ObjMaterials, ALibraryThatIsAPipeADeviceOrTheModelItselfDoesNoHarm) {
  const auto folder = scratch();
  ASSERT_EQ(mkfifo((folder / "pipe.mtl").c_str(), 0600), 0);
  for (const std::string name : {"pipe.mtl", "/dev/zero", "a.obj", ".", "..", "mtllib"}) {
    const auto model = import(write(folder / "a.obj", "mtllib " + name + "\n" + kOneTriangle + "f 1 2 3\n"));
    ASSERT_TRUE(model) << name;
    EXPECT_FALSE(model->report.issues.empty()) << name;
  }
}

TEST(ObjMaterials, ARenamedModelFindsTheMtlThatWasRenamedWithIt) {
  const auto folder = scratch();
  write(folder / "new.mtl", "newmtl a\nKd 1 0 0\n");
  const auto model = import(write(folder / "new.obj", "mtllib old.mtl\n" + kOneTriangle + "usemtl a\nf 1 2 3\n"));
  ASSERT_TRUE(model);
  EXPECT_EQ(model->environment.surfaces.at(0).colour, (Colour{1, 0, 0, 1}));
  EXPECT_THAT(model->report.issues, saysOnce(Severity::warning, "new.mtl is used instead"));
}

}  // namespace
}  // namespace standpoint::test

// SPDX-License-Identifier: GPL-3.0-or-later
#include <array>
#include <filesystem>
#include <fstream>

#include <gtest/gtest.h>
#include <png.h>

#include "tests/importers/ifc_fixture.h"

namespace standpoint::test {
namespace {

// A square of 2 m in two triangles; the picture lies on it once, its lower left corner at the origin.
std::string square(const std::string& texture) {
  return "#100=IFCCARTESIANPOINTLIST3D(((0.,0.,0.),(2.,0.,0.),(2.,2.,0.),(0.,2.,0.)));\n#101=IFCTRIANGULATEDFACESET(#"
         "100,$,.F.,((1,2,3),(1,3,4)),$);\n" +
         product(110, "IFCPLATE", "#101", "Tessellation") + "#120=" + texture +
         ";\n#121=IFCTEXTUREVERTEXLIST(((0.,0.),(1.,0.),(1.,1.),(0.,1.)));\n#122=IFCINDEXEDTRIANGLETEXTUREMAP((#120),#"
         "101,#121,((1,2,3),(1,3,4)));\n";
}

// 2 × 1 points of RGB: red, green.
const std::string kPixels = "IFCPIXELTEXTURE(.T.,.T.,$,$,$,2,1,3,(\"0FF0000\",\"000FF00\"))";

TEST(IfcTexture, TheLowerLeftCornerOfThePictureLiesWhereTheFileSays) {
  const ImportedModel model = importText(ifcText(square(kPixels)));
  EXPECT_EQ(issuesOf(model), "");
  const Mesh& mesh = *model.environment.meshes.at(0);
  ASSERT_EQ(mesh.texture_coordinates.size(), 4U);
  for (std::size_t i = 0; i < 4; ++i) {
    EXPECT_FLOAT_EQ(mesh.texture_coordinates[i].x(), mesh.positions[i].x() / 2);
    EXPECT_FLOAT_EQ(mesh.texture_coordinates[i].y(), 1 - mesh.positions[i].y() / 2);
  }
  ASSERT_EQ(model.environment.surfaces.at(mesh.surface_of_triangle[0]).image, 0);
}

TEST(IfcTexture, PointsInTheModelBecomeAPng) {
  // Red and green below, blue and white above.
  const ImportedModel model = importText(
      ifcText(square("IFCPIXELTEXTURE(.T.,.T.,$,$,$,2,2,3,(\"0FF0000\",\"000FF00\",\"00000FF\",\"0FFFFFF\"))")));
  ASSERT_EQ(model.environment.images.size(), 1U);
  const Image& image = *model.environment.images[0];
  EXPECT_EQ(image.media_type, "image/png");
  png_image png{};
  png.version = PNG_IMAGE_VERSION;
  ASSERT_TRUE(png_image_begin_read_from_memory(&png, image.bytes.data(), image.bytes.size())) << png.message;
  EXPECT_EQ(png.width, 2U);
  EXPECT_EQ(png.height, 2U);
  png.format = PNG_FORMAT_RGB;
  std::array<std::uint8_t, 12> points{};
  ASSERT_TRUE(png_image_finish_read(&png, nullptr, points.data(), 0, nullptr)) << png.message;
  EXPECT_EQ(points, (std::array<std::uint8_t, 12>{0, 0, 255, 255, 255, 255, 255, 0, 0, 0, 255, 0}));  // from above
}

TEST(IfcTexture, AClaimOfMorePointsThanThereAreIsALoss) {
  const ImportedModel model = importText(ifcText(square("IFCPIXELTEXTURE(.T.,.T.,$,$,$,16384,16384,3,(\"0FF0000\"))")));
  EXPECT_EQ(issuesOf(model), "loss #120: the pixel count of the pixel texture does not match its size\n");
  EXPECT_EQ(model.environment.images.size(), 0U);
  EXPECT_EQ(model.environment.meshes.size(), 1U);
}

TEST(IfcTexture, APictureBesideTheModelComesAsItIs) {
  const std::string png = "\x89PNG\r\n\x1A\n and the rest";
  const TemporaryFile picture(png, ".png");
  const ImportedModel model =
      importText(ifcText(square("IFCIMAGETEXTURE(.T.,.T.,$,$,$,'" + picture.path().filename().string() + "')")));
  ASSERT_EQ(model.environment.images.size(), 1U) << issuesOf(model);
  EXPECT_EQ(model.environment.images[0]->bytes.size(), png.size());
  EXPECT_EQ(model.environment.images[0]->name, picture.path().filename().string());
}

TEST(IfcTexture, AMissingPictureIsALossWithItsNameAndOneOutsideTheFolderIsNotRead) {
  EXPECT_EQ(issuesOf(importText(ifcText(square("IFCIMAGETEXTURE(.T.,.T.,$,$,$,'brick.png')")))),
            "loss #120: the image 'brick.png' does not exist; place it next to the model\n");
  for (const char* name : {"../secret.png", "/etc/hostname", "https://example.org/brick.png", "a/../../secret.png"})
    EXPECT_EQ(issuesOf(importText(ifcText(square(std::string("IFCIMAGETEXTURE(.T.,.T.,$,$,$,'") + name + "')")))),
              std::string("loss #120: the image '") + name + "' is not in the model's folder and was not read\n");
}

TEST(IfcTexture, TheTexturesTransformationIsAppliedToTheCoordinates) {
  const ImportedModel model =
      importText(ifcText("#60=IFCCARTESIANTRANSFORMATIONOPERATOR2D($,$,#61,4.);\n#61=IFCCARTESIANPOINT((0.5,0.));\n" +
                         square("IFCPIXELTEXTURE(.T.,.T.,$,#60,$,2,1,3,(\"0FF0000\",\"000FF00\"))")));
  const Mesh& mesh = *model.environment.meshes.at(0);
  for (std::size_t i = 0; i < 4; ++i)
    EXPECT_FLOAT_EQ(mesh.texture_coordinates[i].x(), 0.5F + 4 * mesh.positions[i].x() / 2);
}

TEST(IfcTexture, AFaceOfAPolygonalSetAndOneOfABrepHaveTheirCoordinatesToo) {
  const ImportedModel polygonal =
      importText(ifcText("#100=IFCCARTESIANPOINTLIST3D(((0.,0.,0.),(2.,0.,0.),(2.,2.,0.),(0.,2.,0.)));\n#102="
                         "IFCINDEXEDPOLYGONALFACE((1,2,3,4));\n#101=IFCPOLYGONALFACESET(#100,.F.,(#102),$);\n" +
                             product(110, "IFCPLATE", "#101", "Tessellation") + "#120=" + kPixels +
                             ";\n#121=IFCTEXTUREVERTEXLIST(((0.,0.),(1.,0.),(1.,1.),(0.,1.)));\n"
                             "#123=IFCTEXTURECOORDINATEINDICES((1,2,3,4),#102);\n#122=IFCINDEXEDPOLYGONALTEXTUREMAP((#"
                             "120),#101,#121,(#123));\n",
                         "IFCSIUNIT(*,.LENGTHUNIT.,$,.METRE.)", "IFC4X3_ADD2"));
  const ImportedModel brep =
      importText(ifcText("#100=IFCCARTESIANPOINT((0.,0.,0.));\n#101=IFCCARTESIANPOINT((2.,0.,0.));\n#102="
                         "IFCCARTESIANPOINT((2.,2.,0.));\n#103=IFCCARTESIANPOINT((0.,2.,0.));\n"
                         "#104=IFCPOLYLOOP((#100,#101,#102,#103));\n#105=IFCFACEOUTERBOUND(#104,.T.);\n#106=IFCFACE((#"
                         "105));\n#107=IFCOPENSHELL((#106));\n#108=IFCSHELLBASEDSURFACEMODEL((#107));\n" +
                         product(110, "IFCPLATE", "#108", "SurfaceModel") + "#120=" + kPixels +
                         ";\n#131=IFCTEXTUREVERTEX((0.,0.));\n#132=IFCTEXTUREVERTEX((1.,0.));\n#133=IFCTEXTUREVERTEX(("
                         "1.,1.));\n#134=IFCTEXTUREVERTEX((0.,1.));\n"
                         "#135=IFCTEXTUREMAP((#120),(#131,#132,#133,#134),#106);\n"));
  for (const ImportedModel* model : {&polygonal, &brep}) {
    EXPECT_EQ(issuesOf(*model), "");
    const Mesh& mesh = *model->environment.meshes.at(0);
    ASSERT_EQ(mesh.texture_coordinates.size(), 4U);
    for (std::size_t i = 0; i < 4; ++i) EXPECT_FLOAT_EQ(mesh.texture_coordinates[i].y(), 1 - mesh.positions[i].y() / 2);
  }
}

TEST(IfcTexture, AnOpeningInATexturedPlateLeavesThePictureWhereItWas) {
  const ImportedModel model = importText(
      ifcText("#100=IFCCARTESIANPOINTLIST3D(((0.,0.,0.),(2.,0.,0.),(2.,2.,0.),(0.,2.,0.),(0.,0.,1.),(2.,0.,1.),(2.,2.,"
              "1.),(0.,2.,1.)));\n"
              "#101=IFCTRIANGULATEDFACESET(#100,$,.T.,((1,3,2),(1,4,3),(5,6,7),(5,7,8),(1,2,6),(1,6,5),(2,3,7),(2,7,6),"
              "(3,4,8),(3,8,7),(4,1,5),(4,5,8)),$);\n" +
              product(110, "IFCSLAB", "#101", "Tessellation") + "#120=" + kPixels +
              ";\n#121=IFCTEXTUREVERTEXLIST(((0.,0.),(1.,0.),(1.,1.),(0.,1.),(0.,0.),(1.,0.),(1.,1.),(0.,1.)));\n"
              "#122=IFCINDEXEDTRIANGLETEXTUREMAP((#120),#101,#121,$);\n#131=IFCCARTESIANPOINT((1.,1.));\n#132="
              "IFCAXIS2PLACEMENT2D(#131,$);\n#133=IFCRECTANGLEPROFILEDEF(.AREA.,$,#132,0.5,0.5);\n#134="
              "IFCEXTRUDEDAREASOLID(#133,$,#4,1.);\n" +
              product(150, "IFCOPENINGELEMENT", "#134") + "#160=IFCRELVOIDSELEMENT('v',$,$,$,#110,#150);\n"));
  EXPECT_NEAR(volumeOf(model, "#110"), 4 - 0.25, 1e-5);
  const Mesh& mesh = *model.environment.meshes.at(0);
  std::size_t inner = 0;
  for (const Triangle& t : mesh.triangles) {
    bool top = true;
    for (const std::uint32_t i : t) top = top && mesh.positions[i].z() > 0.999F;
    for (const std::uint32_t i : t) {
      if (!top) continue;
      EXPECT_NEAR(mesh.texture_coordinates[i].x(), mesh.positions[i].x() / 2, 1e-5);
      EXPECT_NEAR(mesh.texture_coordinates[i].y(), 1 - mesh.positions[i].y() / 2, 1e-5);
      if (mesh.positions[i].x() > 0.1F && mesh.positions[i].x() < 1.9F) ++inner;
    }
  }
  EXPECT_GE(inner, 4U);
}

// A plate of 2 × 1 × 0.5 m with a style whose picture a rule places.
std::string generated(const std::string& mode, const std::string& transformation = "$") {
  return boxSolid(100, "2.", "1.", "0.5") + product(110, "IFCPLATE", "#102") + "#120=IFCPIXELTEXTURE(.T.,.T.,$," +
         transformation +
         ",$,2,1,3,(\"0FF0000\",\"000FF00\"));\n#121=IFCSURFACESTYLEWITHTEXTURES((#120));\n#122=IFCSURFACESTYLE('"
         "picture',.BOTH.,(#121));\n#123=IFCSTYLEDITEM(#102,(#122),$);\n"
         "#124=IFCTEXTURECOORDINATEGENERATOR((#120),'" +
         mode + "',$);\n";
}

TEST(IfcTexture, ARuleMayTakeThePlaceOnThePictureFromThePoint) {
  const ImportedModel model = importText(ifcText(generated("COORD")));
  EXPECT_EQ(issuesOf(model), "");
  const Mesh& mesh = *model.environment.meshes.at(0);
  ASSERT_EQ(mesh.texture_coordinates.size(), mesh.positions.size());
  for (std::size_t i = 0; i < mesh.positions.size(); ++i) {
    EXPECT_FLOAT_EQ(mesh.texture_coordinates[i].x(), mesh.positions[i].x());
    EXPECT_FLOAT_EQ(mesh.texture_coordinates[i].y(), 1 - mesh.positions[i].y());
  }
  EXPECT_EQ(model.environment.surfaces.at(mesh.surface_of_triangle[0]).image, 0);
}

TEST(IfcTexture, ARuleMayTakeThePlaceOnThePictureFromTheNormal) {
  const ImportedModel model = importText(ifcText(generated("SPHERE")));
  const Mesh& mesh = *model.environment.meshes.at(0);
  ASSERT_EQ(mesh.texture_coordinates.size(), mesh.positions.size());
  for (const Triangle& t : mesh.triangles) {
    const Eigen::Vector3f n =
        (mesh.positions[t[1]] - mesh.positions[t[0]]).cross(mesh.positions[t[2]] - mesh.positions[t[0]]).normalized();
    for (const std::uint32_t i : t) {
      EXPECT_NEAR(mesh.texture_coordinates[i].x(), n.x() / 2 + 0.5F, 1e-5F);
      EXPECT_NEAR(mesh.texture_coordinates[i].y(), 0.5F - n.y() / 2, 1e-5F);
    }
  }
}

TEST(IfcTexture, ARuleThatNeedsACameraIsNamedAsLost) {
  const ImportedModel model = importText(ifcText(generated("CAMERASPACEREFLECTIONVECTOR")));
  EXPECT_TRUE(tells(model, "#124", "CAMERASPACEREFLECTIONVECTOR")) << issuesOf(model);
  EXPECT_TRUE(model.environment.meshes.at(0)->texture_coordinates.empty());
}

}  // namespace
}  // namespace standpoint::test

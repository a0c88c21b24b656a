// SPDX-License-Identifier: GPL-3.0-or-later
// Where on the map a file says that it stands. Truth: the numbers in the file, by the schema's formula.
#include <cmath>
#include <cstdlib>
#include <fstream>

#include <gtest/gtest.h>

#include "importers/gltf/gltf_writer.h"
#include "importers/obj/obj_writer.h"
#include "tests/importers/ifc_fixture.h"
#include "tests/importers/written_glb.h"

namespace standpoint::test {
namespace {

const std::string kMetre = "IFCSIUNIT(*,.LENGTHUNIT.,$,.METRE.)",
                  kMillimetre = "IFCSIUNIT(*,.LENGTHUNIT.,.MILLI.,.METRE.)";

MapConversion conversion(const ImportedModel& model) {
  EXPECT_TRUE(model.georeference.map_from_file.has_value()) << issuesOf(model);
  return model.georeference.map_from_file.value_or(MapConversion());
}

bool says(const ImportedModel& model, const std::string& what) {
  return issuesOf(model).find(what) != std::string::npos;
}

TEST(IfcGeoreference, ScaledFactorsStretchTheAxes) {
  const auto model =
      importText(ifcText("#60=IFCPROJECTEDCRS('EPSG:25832',$,$,$,$,$,#10);\n#61=IFCMAPCONVERSIONSCALED(#12,#60,500000.,"
                         "5400000.,7.,1.,0.,$,0.9996,0.9996,1.);\n",
                         kMetre, "IFC4X3_ADD2"));
  const Eigen::Vector3d map = mapFromFile(conversion(model), {1000, 2000, 3});
  EXPECT_NEAR(map.x(), 500000 + 999.6, 1e-6);
  EXPECT_NEAR(map.y(), 5400000 + 1999.2, 1e-6);
  EXPECT_NEAR(map.z(), 10, 1e-9);
}

TEST(IfcGeoreference, ARigidOperationMovesWithoutTurning) {
  const auto model =
      importText(ifcText("#60=IFCPROJECTEDCRS('EPSG:25832',$,$,$,$,$,#10);\n#61=IFCRIGIDOPERATION(#12,#60,"
                         "IFCLENGTHMEASURE(35010.),IFCLENGTHMEASURE(1560.),12.);\n",
                         kMetre, "IFC4X3_ADD2"));
  const auto c = conversion(model);
  EXPECT_EQ(c.eastings_m, 35010);
  EXPECT_EQ(c.northings_m, 1560);
  EXPECT_EQ(c.orthogonal_height_m, 12);
  EXPECT_EQ(c.x_axis_abscissa, 1);
}

TEST(IfcGeoreference, ARigidOperationInAnglesIsALatitudeAndALongitude) {  // buildingSMART's example: Lake Bled
  const auto model = importText(ifcText(
      "#59=IFCCONVERSIONBASEDUNIT($,.PLANEANGLEUNIT.,'degree',#58);\n#58=IFCMEASUREWITHUNIT(IFCPLANEANGLEMEASURE(0."
      "017453292519943295),#13);\n#60=IFCGEOGRAPHICCRS('EPSG:4258','ETRS89','EPSG:6258','EPSG:8901',#59,#10);\n"
      "#61=IFCRIGIDOPERATION(#12,#60,IFCPLANEANGLEMEASURE(14.0902217),IFCPLANEANGLEMEASURE(46.3623297),475.);\n",
      kMetre, "IFC4X3_ADD2"));
  ASSERT_TRUE(model.georeference.site.has_value());
  EXPECT_NEAR(model.georeference.site->latitude_deg, 46.3623297, 1e-9);
  EXPECT_NEAR(model.georeference.site->longitude_deg, 14.0902217, 1e-9);
  EXPECT_EQ(model.georeference.site->elevation_m, 475);
}

TEST(IfcGeoreference, AScaleBetweenUnitsTellsTheMapsUnitWhereNothingElseDoes) {
  const auto mm =
      importText(ifcText("#60=IFCPROJECTEDCRS('EPSG:25832',$,$,$,$,$,$);\n#61=IFCMAPCONVERSION(#12,#60,500000.,5400000."
                         ",0.,1.,0.,0.001);\n",
                         kMillimetre));
  EXPECT_EQ(conversion(mm).eastings_m, 500000);
  EXPECT_EQ(conversion(mm).scale, 1);
  // As in gherkin's pass-grf005: metres, a CRS in US survey feet, the ratio written the other way round.
  const auto foot =
      importText(ifcText("#60=IFCPROJECTEDCRS('EPSG:2277',$,'NAD83',$,'','3',$);\n#61=IFCMAPCONVERSION(#12,#60,316131."
                         "64,5690966.11,1.,1.,0.,0.30480060960121924);\n",
                         kMetre));
  EXPECT_NEAR(conversion(foot).eastings_m, 316131.64 * 1200 / 3937, 1e-6);
  EXPECT_EQ(conversion(foot).scale, 1);
  EXPECT_TRUE(says(foot, "inverted compared to the schema"));
}

TEST(IfcGeoreference, MetresWithoutAStatedUnitAreSeenInAProjectOfMillimetres) {
  const auto model = importText(ifcText(
      "#60=IFCPROJECTEDCRS('EPSG:25832',$,$,$,$,$,$);\n#61=IFCMAPCONVERSION(#12,#60,500000.,5400000.,0.,1.,0.,$);\n",
      kMillimetre));
  EXPECT_EQ(conversion(model).northings_m, 5400000);
  EXPECT_TRUE(says(model, "warning #61: map unit not specified"));
}

TEST(IfcGeoreference, TheConventionOnTheProjectKnowsItsUnitAndItsScale) {
  const auto model = importText(
      ifcText("#61=IFCPROPERTYSINGLEVALUE('Eastings',$,IFCLENGTHMEASURE(76670.),$);\n#62=IFCPROPERTYSINGLEVALUE('Scale'"
              ",$,IFCREAL(0.001),$);\n#63=IFCPROPERTYSET('p',$,'ePset_MapConversion',$,(#61,#62));\n"
              "#64=IFCRELDEFINESBYPROPERTIES('r',$,$,$,(#20),#63);\n#65=IFCPROPERTYSINGLEVALUE('Name',$,IFCLABEL('EPSG:"
              "31370'),$);\n#66=IFCPROPERTYSET('q',$,'ePset_ProjectedCRS',$,(#65));\n#67=IFCRELDEFINESBYPROPERTIES('s',"
              "$,$,$,(#20),#66);\n",
              kMillimetre, "IFC2X3"));
  EXPECT_EQ(conversion(model).eastings_m, 76670);
  EXPECT_EQ(conversion(model).scale, 1);  // millimetres to metres, which are ours
  EXPECT_EQ(model.georeference.crs, "EPSG:31370");
}

TEST(IfcGeoreference, TheCodeInAWellKnownTextNamesTheMap) {
  const auto model = importText(
      ifcText("#60=IFCPROJECTEDCRS('local name',$,$,$,$,$,#10);\n#61=IFCMAPCONVERSION(#12,#60,1.,2.,3.,1.,0.,1.);\n"
              "#62=IFCWELLKNOWNTEXT('PROJCRS[\"x\",BASEGEOGCRS[\"y\",ID[\"EPSG\",4258]],ID[\"EPSG\",25833]]',#60);\n",
              kMetre, "IFC4X3_ADD2"));
  EXPECT_EQ(model.georeference.crs, "EPSG:25833");
  EXPECT_FALSE(says(model, "is not an EPSG code"));
}

TEST(IfcGeoreference, AWorldCoordinateSystemFarAwayIsThePlaceOnTheMap) {
  std::string text = ifcText(
      "#60=IFCCARTESIANPOINT((155000.,463000.,2.));\n#61=IFCAXIS2PLACEMENT3D(#60,#4,#62);\n#62=IFCDIRECTION((0.,1.,0.))"
      ";\n");
  text.replace(text.find("1.E-5,#2,"), 9, "1.E-5,#61,");
  const auto c = conversion(importText(text));
  expectNear(mapFromFile(c, {10, 0, 0}), {155000, 463010, 2}, 1e-9);
}

TEST(IfcGeoreference, FaultsAreNamed) {
  const auto with = [](const std::string& name, const std::string& datum, const std::string& height) {
    return importText(ifcText("#60=IFCPROJECTEDCRS('" + name + "',$," + datum + "," + height +
                              ",$,$,#10);\n#61=IFCMAPCONVERSION(#12,#60,1.,2.,3.,1.,0.,1.);\n"));
  };
  EXPECT_TRUE(says(with("", "$", "$"), "warning #60: the coordinate reference system has no name"));
  EXPECT_TRUE(says(with("EPSG:12invalid", "$", "$"), "warning #60: 'EPSG:12invalid' is not an EPSG code"));
  EXPECT_TRUE(says(with("EPSG:99999", "$", "$"), "warning #60: EPSG:99999 is not a coordinate reference system"));
  EXPECT_TRUE(says(with("EPSG:4326", "$", "$"), "warning #60: EPSG:4326 is not a projected"));
  EXPECT_TRUE(says(with("EPSG:25832", "'EPSG:0000'", "$"),
                   "warning #60: geodetic datum 'EPSG:0000' is not in the EPSG dataset"));
  EXPECT_TRUE(says(with("EPSG:25832", "$", "'EPSG:1234'"),
                   "warning #60: vertical datum 'EPSG:1234' is not in the EPSG dataset"));
  EXPECT_EQ(issuesOf(with("EPSG:25832", "'EPSG:6258'", "'EPSG:5703'")), "");
}

TEST(IfcGeoreference, ContextsThatDisagreeAreTold) {
  const std::string crs =
      "#60=IFCPROJECTEDCRS('EPSG:25832',$,$,$,$,$,#10);\n#61=IFCMAPCONVERSION(#12,#60,1.,2.,3.,1.,0.,1.);\n#62="
      "IFCGEOMETRICREPRESENTATIONCONTEXT($,'Model',3,1.E-5,#2,$);\n";
  EXPECT_TRUE(says(importText(ifcText(crs)), "warning #62: the context has no map position"));
  EXPECT_TRUE(says(importText(ifcText(crs + "#63=IFCMAPCONVERSION(#62,#60,9.,2.,3.,1.,0.,1.);\n")),
                   "warning #63: conflicts with the map position from #61"));
  EXPECT_EQ(issuesOf(importText(ifcText(crs + "#63=IFCMAPCONVERSION(#62,#60,1.,2.,3.,1.,0.,1.);\n"))), "");
}

// The corpus says of each of these files whether its georeference is right.
TEST(IfcGeoreference, FilesLabelledRightGiveItAndFilesLabelledWrongSayWhy) {
  const char* shared = std::getenv("STANDPOINT_SHARED");
  const std::filesystem::path folder =
      std::filesystem::path(shared ? shared : SOURCE_DIR "/../shared") / "corpus" / "ifc";
  if (!std::filesystem::exists(folder)) GTEST_SKIP() << "no corpus here";
  std::size_t right = 0, wrong = 0;
  for (const auto& entry : std::filesystem::directory_iterator(folder)) {
    const std::string name = entry.path().filename().string();
    if (name.find("-grf0") == std::string::npos) continue;
    Progress progress;
    const auto model = importFile(entry.path(), {}, progress);
    ASSERT_TRUE(model.has_value()) << name;
    const bool pass = name.starts_with("gherkin__pass"), fail = name.starts_with("gherkin__fail");
    if (pass) {
      EXPECT_TRUE(model->georeference.map_from_file.has_value()) << name;
      EXPECT_TRUE(model->georeference.crs.starts_with("EPSG:")) << name;
      ++right;
    }
    if (fail && name.find("building_without") ==
                    std::string::npos) {  // that one has nothing to be wrong; the project's import says so
      EXPECT_TRUE(issuesOf(*model).find("warning") != std::string::npos) << name << "\n" << issuesOf(*model);
      ++wrong;
    }
  }
  EXPECT_GE(right, 8U);
  EXPECT_GE(wrong, 8U);
}

// A box of exact numbers far away, once in its points and once in its placement: what comes in leaves to 0.1 mm.
TEST(IfcGeoreference, AModelFarAwayKeepsItsNumbersThroughObjAndGlb) {
  const double e = 5012345.6789, n = 5432109.8765, h = 123.4567;
  const auto at = [](double v) {
    char text[32];
    std::snprintf(text, sizeof text, "%.4f", v);
    return std::string(text);
  };
  const std::string in_points = "#100=IFCCARTESIANPOINTLIST3D(((" + at(e) + "," + at(n) + "," + at(h) + "),(" +
                                at(e + 2) + "," + at(n) + "," + at(h) + "),(" + at(e) + "," + at(n + 1) + "," + at(h) +
                                "),(" + at(e) + "," + at(n) + "," + at(h + 3) +
                                ")));\n#101=IFCTRIANGULATEDFACESET(#100,$,.T.,((1,3,2),(1,2,4),(1,4,3),(2,3,4)),$);\n" +
                                product(110, "IFCPLATE", "#101", "Tessellation");
  const std::string in_placement = "#160=IFCCARTESIANPOINT((" + at(e + 1) + "," + at(n + 0.5) + "," + at(h) +
                                   "));\n#161=IFCAXIS2PLACEMENT3D(#160,$,$);\n#162=IFCLOCALPLACEMENT($,#161);\n" +
                                   boxSolid(170, "2.", "1.", "3.") +
                                   product(180, "IFCCOLUMN", "#172", "SweptSolid", "#162");
  const ImportedModel model = importText(ifcText(in_points + in_placement));
  for (const char* id : {"#110", "#180"}) {
    expectNear(boundsOf(model, id).min, {e, n, h}, 1e-5);
    expectNear(boundsOf(model, id).max, {e + 2, n + 1, h + 3}, 1e-5);
  }
  EXPECT_LT(bounds(model.environment).max.cwiseAbs().maxCoeff(), 10);  // what is computed with is small: no jitter
  Progress progress;
  const TemporaryFile obj("", ".obj"), glb("", ".glb");
  ASSERT_TRUE(writeEnvironmentObj(model.environment, model.georeference, obj.path(), progress));
  Bounds written;
  std::ifstream lines(obj.path());
  for (std::string word; lines >> word;)
    if (word == "v") {
      Eigen::Vector3d p;
      lines >> p.x() >> p.y() >> p.z();
      written.extend(p);
    }
  expectNear(written.min, {e, n, h}, 1e-4);
  expectNear(written.max, {e + 2, n + 1, h + 3}, 1e-4);
  ASSERT_TRUE(testing::putGlb(model.environment, model.georeference, glb.path(), progress));
  const auto back = importFile(glb.path(), {}, progress);
  ASSERT_TRUE(back.has_value()) << describe(back.error());
  const Bounds b = bounds(back->environment);
  expectNear(b.min + back->georeference.shift_m, {e, n, h}, 1e-4);
  expectNear(b.max + back->georeference.shift_m, {e + 2, n + 1, h + 3}, 1e-4);
}

}  // namespace
}  // namespace standpoint::test

// SPDX-License-Identifier: GPL-3.0-or-later
#include "survey/geodesy.h"

#include <gtest/gtest.h>

#include "tests/project/support.h"

namespace standpoint {
namespace {

TEST(Crs, IsFoundByItsCodeWithOrWithoutTheAuthority) {
  const auto a = findCrs("EPSG:25832");
  ASSERT_TRUE(a);
  EXPECT_EQ(a->name, "ETRS89 / UTM zone 32N");
  EXPECT_TRUE(a->projected);
  EXPECT_EQ(findCrs("25832")->code, "EPSG:25832");
  EXPECT_NE(a->wkt.find("PROJCRS"), std::string::npos);
}

TEST(Crs, ThatNobodyKnowsIsAUsageErrorWithARemedy) {
  for (const char* code : {"EPSG:999999", "", "nonsense"}) {
    const auto crs = findCrs(code);
    ASSERT_FALSE(crs) << code;
    EXPECT_EQ(crs.error().kind, ErrorKind::usage);
    EXPECT_NE(crs.error().message.find("EPSG:25832"), std::string::npos);
  }
}

TEST(Geographic, OfTheOriginOfUtmIsOnTheCentralMeridian) {
  const auto g = geographic("EPSG:25832", {500000, 0, 12});
  ASSERT_TRUE(g);
  EXPECT_NEAR(g->geographic.longitude_deg, 9, 1e-9);
  EXPECT_NEAR(g->geographic.latitude_deg, 0, 1e-9);
  EXPECT_DOUBLE_EQ(g->geographic.elevation_m, 12);
  EXPECT_NEAR(g->grid_convergence_deg, 0, 1e-9);
  EXPECT_NEAR(g->scale_factor, 0.9996, 1e-9);
}

// Two libraries that share no code: PROJ one way, GeographicLib back.
TEST(Utm, ByGeographicLibAgreesWithProjToATenthOfAMillimetre) {
  const auto g = geographic("EPSG:32633", {412345.678, 5654321.012, 0});
  ASSERT_TRUE(g);
  const auto u = utm(g->geographic.latitude_deg, g->geographic.longitude_deg);
  EXPECT_EQ(u.zone, 33);
  EXPECT_TRUE(u.north);
  EXPECT_NEAR(u.easting_m, 412345.678, 2e-4);
  EXPECT_NEAR(u.northing_m, 5654321.012, 2e-4);
  EXPECT_NEAR(u.convergence_deg, g->grid_convergence_deg, 1e-8);
  EXPECT_NEAR(u.scale, g->scale_factor, 1e-8);
}

TEST(Geographic, OutsideTheCrsIsAnErrorNotAPlace) { EXPECT_FALSE(geographic("EPSG:25832", {1e12, 1e12, 0})); }

TEST(GeoreferenceVerb, SetsTheMapConversionAndTellsWhereTheModelIs) {
  const auto outcome = run("georeference", twoStoreyDocument(),
                           {{"crs", "EPSG:25832"}, {"origin", {191000, -265000, 510}}, {"rotation-deg", 0}});
  ASSERT_TRUE(outcome) << describe(outcome.error());
  // The model's centre is at 500003, 5600002, so the map position is 691003, 5335002: Munich.
  EXPECT_NEAR(outcome->answer["geographic"]["latitude_deg"].get<double>(), 48.1396, 1e-3);
  EXPECT_NEAR(outcome->answer["geographic"]["longitude_deg"].get<double>(), 11.5675, 1e-3);
  EXPECT_EQ(outcome->answer["utm"]["zone"], "32N");
  EXPECT_NEAR(outcome->answer["utm"]["easting"].get<double>(), 691003, 0.01);
  EXPECT_EQ(outcome->document.georeference->crs, "EPSG:25832");
}

TEST(GeoreferenceVerb, WithoutOptionsChangesNothing) {
  const Document d = twoStoreyDocument();
  const auto outcome = run("georeference", d, nlohmann::json::object());
  ASSERT_TRUE(outcome);
  EXPECT_EQ(outcome->document, d);
  EXPECT_TRUE(outcome->answer["geographic"].is_null());
}

TEST(Crs, SaysHowLongItsUnitIs) {
  EXPECT_NEAR(
      findCrs(
          "PROJCS[\"a\",GEOGCS[\"b\",DATUM[\"c\",SPHEROID[\"d\",6378137,298.257222101],TOWGS84[0,0,0,0,0,0,0]],"
          "PRIMEM[\"Greenwich\",0],UNIT[\"degree\",0.0174532925199433]],PROJECTION[\"Transverse_Mercator\"],"
          "PARAMETER[\"latitude_of_origin\",31],PARAMETER[\"central_meridian\",-106],PARAMETER[\"scale_factor\",1],"
          "PARAMETER[\"false_easting\",0],PARAMETER[\"false_northing\",0],UNIT[\"US survey foot\",0.304800609601219]]")
          ->metres_per_unit,
      1200.0 / 3937, 1e-9);
  EXPECT_EQ(findCrs("EPSG:25832")->metres_per_unit, 1);
  EXPECT_NEAR(findCrs("EPSG:2903")->metres_per_unit, 1200.0 / 3937, 1e-12);  // New Mexico Central, US survey feet
}

}  // namespace
}  // namespace standpoint

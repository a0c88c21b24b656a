// SPDX-License-Identifier: GPL-3.0-or-later
#include <algorithm>
#include <cmath>
#include <map>
#include <numbers>
#include <sstream>

#include "tests/materials/fixtures.h"
#include "tests/temporary_folder.h"

namespace standpoint {
namespace {

double normalReflectance(double index) { return index > 0 ? std::pow((index - 1) / (index + 1), 2) : 0; }

// A slab at normal incidence, all internal reflections summed without coherence (physics.md §4.6).
struct Slab {
  double transmittance, reflectance;
};
Slab slab(double n, double k, double thickness_m, double wavelength_nm) {
  const double r = normalReflectance(n);
  const double t = std::exp(-4 * std::numbers::pi * k * thickness_m / (wavelength_nm * 1e-9));
  const double both = 1 - r * r * t * t;
  return {(1 - r) * (1 - r) * t / both, r + (1 - r) * (1 - r) * r * t * t / both};
}

// What the faces of a pane reflect that lets this much through: the absorption follows by bisection. A pane that lets
// through more than a lossless one gives 1, which no balance can hold.
double reflectanceOfPane(const PhysicalMaterial& pane, double wavelength_nm, double through) {
  const auto with = [&](double k) { return slab(pane.index_of_refraction, k, pane.thickness_m, wavelength_nm); };
  if (with(0).transmittance < through) return 1;
  double low = 0, high = 1e-3;
  for (int step = 0; step < 60; ++step) {
    const double middle = (low + high) / 2;
    (with(middle).transmittance > through ? low : high) = middle;
  }
  return with(low).reflectance;
}

struct Row {
  double reflectance;
  std::string source, note;
};
using Table = std::map<std::string, std::map<double, Row>>;

Table readTable(const std::filesystem::path& file) {
  Table table;
  std::ifstream stream(file);
  for (std::string line; std::getline(stream, line);) {
    std::vector<std::string> cells;
    std::istringstream cell_stream(line);
    for (std::string cell; std::getline(cell_stream, cell, '\t');) cells.push_back(cell);
    if (line.starts_with('#') || cells.size() != 5 || cells[0] == "material" || cells[2] == "NA") continue;
    table[cells[0]][std::stod(cells[1])] = {std::stod(cells[2]), cells[3], cells[4]};
  }
  return table;
}

std::string sourceOf(const PhysicalMaterial& material, const std::string& figure) {
  for (const auto& citation : material.sources)
    if (citation.figure == figure) return citation.text;
  return {};
}

TEST(Library, HoldsOnlyWhatASurfaceCanDo) {
  ASSERT_GE(shippedLibrary().size(), 60U);
  for (const auto& material : shippedLibrary()) {
    SCOPED_TRACE(material.id);
    EXPECT_TRUE(!isGap(material) || !material.gaps.empty());
    for (const auto& [wavelength, diffuse] : material.reflectance) {
      EXPECT_GE(diffuse, 0);
      EXPECT_LE(diffuse + specularAtNormal(material, wavelength), 1);
    }
    for (const auto& [wavelength, through] : material.transmittance) {
      const double diffuse = atWavelength(material.reflectance, wavelength);
      EXPECT_GT(through, 0);
      EXPECT_LE(through + reflectanceOfPane(material, wavelength, through) + diffuse, 1) << wavelength;
    }
  }
}

TEST(Library, CoversTheWavelengthsOfTerrestrialScanners) {
  for (const auto& material : shippedLibrary()) {
    if (isGap(material)) continue;
    EXPECT_LE(material.reflectance.front().first, 532) << material.id;
    EXPECT_GE(material.reflectance.back().first, 1550) << material.id;
  }
}

// Its numbers may be cited one by one; the spectra that the library ships are not among them.
TEST(Library, TakesNoSpectrumFromTheCampaignWhoseFilesMayNotBeShipped) {
  std::size_t cited = 0;
  for (const auto& material : shippedLibrary())
    for (const auto& citation : material.sources)
      if (citation.text.find("KLUM") != std::string::npos) {
        EXPECT_EQ(citation.figure, "variation") << material.id;
        ++cited;
      }
  EXPECT_GE(cited, 10U);
}

TEST(Library, NamesASourceWithItsLicenceOrSaysUnsourcedForEveryFigure) {
  for (const auto& material : shippedLibrary()) {
    SCOPED_TRACE(material.id);
    EXPECT_EQ(sourceOf(material, "reflectance").empty(), isGap(material) || !material.wet_of.empty());
    EXPECT_EQ(sourceOf(material, "wet_of").empty(), material.wet_of.empty());
    EXPECT_EQ(sourceOf(material, "roughness_rad").empty(), material.roughness_rad == 0);
    EXPECT_EQ(sourceOf(material, "gloss_slope").empty(), material.gloss_slope == 0);
    EXPECT_EQ(sourceOf(material, "index_of_refraction").empty(), material.index_of_refraction == 0);
    EXPECT_EQ(sourceOf(material, "complex_index").empty(), material.complex_index.empty());
    EXPECT_EQ(sourceOf(material, "transmittance").empty(), material.transmittance.empty());
    EXPECT_EQ(sourceOf(material, "panes").empty(), material.panes == 1);
    EXPECT_EQ(sourceOf(material, "variation").empty(), material.variation == 0);
    EXPECT_EQ(sourceOf(material, "surface_variation").empty(), material.surface_variation == 0);
    for (const auto& citation : material.sources) {
      EXPECT_TRUE(!citation.licence.empty() || citation.text.starts_with("unsourced"))
          << citation.figure << ": " << citation.text;
      EXPECT_EQ(citation.text.find('['), std::string::npos) << citation.text;
    }
  }
}

TEST(Library, NamesTheGapsThatItHas) {
  for (const char* id : {"retroreflective_foil", "car_paint_clearcoat", "glass_low_e_coated", "toner_black"}) {
    ASSERT_NE(findMaterial(id), nullptr) << id;
    EXPECT_TRUE(isGap(*findMaterial(id)));
    EXPECT_EQ(gapsOf(*findMaterial(id)).size(), 1U);
  }
  EXPECT_EQ(gapsOf(*findMaterial("concrete_construction")).size(), 1U);  // of its texture
  EXPECT_EQ(gapsOf(*findMaterial("tile_glazed_white")).size(), 1U);
  EXPECT_NE(gapsOf(*findMaterial("glass_double_clear_4mm")).front().find("low-E"), std::string::npos);
}

// KLUM's within-class figures at 905 nm, as physics.md §0.4 quotes them.
TEST(Library, KnowsHowMuchMaterialsVaryWithinTheirClass) {
  EXPECT_EQ(findMaterial("roof_tile_clay_red")->variation, 0.16);
  EXPECT_EQ(findMaterial("plaster_render")->variation, 0.17);
  EXPECT_EQ(findMaterial("concrete_construction")->variation, 0.35);
  EXPECT_EQ(findMaterial("brick_red_bare")->variation, 0.33);
  EXPECT_EQ(findMaterial("asphalt_road_soiled_2")->variation, 0.45);
}

// physics.md §4.8: .15/.30/.50 become .084/.181/.339 in the body, and 0.02 less enters it.
TEST(WetStates, FollowTheModelFromTheirDryMaterial) {
  const TemporaryFolder folder;
  folder.write("a.json", R"({"materials": [
    {"id": "dry", "label": "Dry", "reflectance": [[532, 0.15], [905, 0.3], [1550, 0.5]],
      "source": {"reflectance": "unsourced"}},
    {"id": "moist", "label": "Wet", "wet_of": "dry", "source": {"wet_of": "unsourced"}}]})");
  const auto library = readMaterialLibrary(folder.path());
  ASSERT_TRUE(library.has_value()) << describe(library.error());
  const auto& moist = library->at(1);
  ASSERT_EQ(moist.wet_of, "dry");
  EXPECT_NEAR(atWavelength(moist.reflectance, 532), 0.084, 1e-3);
  EXPECT_NEAR(atWavelength(moist.reflectance, 905), 0.181, 1e-3);
  EXPECT_NEAR(atWavelength(moist.reflectance, 1550), 0.339, 1e-3);
  EXPECT_EQ(findMaterial("concrete_wet")->wet_of, "concrete_construction");
}

// e^(-2.4 α d): a film of 0.5 mm takes 73 % at 1550 nm (α = 1086 1/m) and less than 1 % at 905 nm (7.1 1/m).
TEST(WetStates, AreDarkenedByTheirFilmWhereWaterAbsorbs) {
  const TemporaryFolder folder;
  folder.write("a.json", R"({"materials": [
    {"id": "dry", "label": "Dry", "reflectance": [[905, 0.3], [1550, 0.3]], "measured_as": "hemispherical",
      "source": {"reflectance": "unsourced"}},
    {"id": "moist", "label": "Wet", "wet_of": "dry", "water_film_m": 0.0005,
      "source": {"wet_of": "unsourced", "water_film_m": "unsourced"}},
    {"id": "without", "label": "Wet", "wet_of": "dry", "source": {"wet_of": "unsourced"}}]})");
  const auto library = readMaterialLibrary(folder.path());
  ASSERT_TRUE(library.has_value()) << describe(library.error());
  const auto &moist = library->at(1), &without = library->at(2);
  EXPECT_TRUE(moist.hemispherical);
  EXPECT_NEAR(atWavelength(moist.reflectance, 1550) / atWavelength(without.reflectance, 1550),
              std::exp(-2.4 * 1086 * 0.0005), 1e-6);
  EXPECT_NEAR(atWavelength(moist.reflectance, 905) / atWavelength(without.reflectance, 905),
              std::exp(-2.4 * 7.1 * 0.0005), 1e-6);
  EXPECT_GT(findMaterial("asphalt_wet")->water_film_m, 0);
}

// Hemispherical or bidirectional, as its source says.
TEST(Library, SaysHowAReflectanceWasMeasuredAsItsSourceDoes) {
  for (const auto& material : shippedLibrary()) {
    if (isGap(material) || !material.wet_of.empty()) continue;
    const auto source = sourceOf(material, "reflectance");
    if (source.find("left out") != std::string::npos) continue;
    EXPECT_EQ(material.hemispherical, source.find("hemispherical") != std::string::npos) << material.id;
  }
}

// What the table says, less the specular part that a glossy finish's total holds.
void expectFiguresOf(const PhysicalMaterial& material, const std::map<double, Row>& rows, double taken_off) {
  ASSERT_EQ(material.reflectance.size(), rows.size());
  for (const auto& [wavelength, diffuse] : material.reflectance)
    EXPECT_NEAR(diffuse, std::max(0.0, rows.at(wavelength).reflectance - taken_off), 1e-4)
        << material.id << " " << wavelength;
}

TEST(Library, SaysWhatTheReferenceTableSays) {
  const auto file = sharedFolder() / "reference" / "materials.tsv";
  if (!std::filesystem::exists(file)) GTEST_SKIP() << "the reference table is not at hand";
  const auto table = readTable(file);
  std::size_t compared = 0;
  for (const auto& material : shippedLibrary()) {
    const auto source = sourceOf(material, "reflectance");
    const auto proxy = source.find("proxy, figures of ");
    if (proxy == std::string::npos && !source.starts_with("measured")) continue;
    const auto begin = proxy + 18;
    const auto id = proxy == std::string::npos ? material.id : source.substr(begin, source.find(' ', begin) - begin);
    ASSERT_TRUE(table.contains(id)) << material.id;
    const bool whole = material.index_of_refraction > 0 && source.find("diffuse part: less") != std::string::npos;
    expectFiguresOf(material, table.at(id), whole ? normalReflectance(material.index_of_refraction) : 0);
    ++compared;
  }
  EXPECT_GE(compared, 90U);
}

// At every wavelength: copper sends back 0.60 at 532 nm and 0.97 at 905 nm.
TEST(Library, GivesMetalsTheNormalReflectanceOfTheirOpticalConstants) {
  EXPECT_NEAR(specularAtNormal(*findMaterial("copper_polished"), 532), 0.602, 2e-3);
  EXPECT_NEAR(specularAtNormal(*findMaterial("copper_polished"), 905), 0.966, 2e-3);
  const auto file = sharedFolder() / "reference" / "materials.tsv";
  if (!std::filesystem::exists(file)) GTEST_SKIP() << "the reference table is not at hand";
  const auto table = readTable(file);
  for (const auto& [id, row] :
       {std::pair{"aluminium_polished", "aluminium_polished"},
        std::pair{"stainless_austenitic_polished", "stainless_austenitic_polished"},
        std::pair{"stainless_brushed", "stainless_austenitic_polished"},
        std::pair{"chromium_polished", "chromium_polished"}, std::pair{"copper_polished", "copper_polished"},
        std::pair{"brass_70_30_polished", "brass_70_30_polished"}, std::pair{"steel_polished", "iron_polished"}}) {
    ASSERT_NE(findMaterial(id), nullptr) << id;
    for (const auto& [wavelength, figure] : table.at(row))
      EXPECT_NEAR(specularAtNormal(*findMaterial(id), wavelength), figure.reflectance, 1e-3) << id << " " << wavelength;
  }
}

TEST(Library, MakesAMirrorOfSilverBehindGlassPassedTwice) {
  const auto file = sharedFolder() / "reference" / "materials.tsv";
  if (!std::filesystem::exists(file)) GTEST_SKIP() << "the reference table is not at hand";
  const auto table = readTable(file);
  const auto& glass = findMaterial("glass_float_clear_4mm")->transmittance;
  for (const auto& [wavelength, silver] : table.at("silver_mirror"))
    EXPECT_NEAR(specularAtNormal(*findMaterial("mirror_household"), wavelength),
                silver.reflectance * std::pow(atWavelength(glass, wavelength), 2), 1e-3);
}

// V7 of physics.md §7: the formula that the panes below are held against.
TEST(Panes, OfLosslessGlassReflectTwoFaces) {
  const auto lossless = slab(1.52, 0, 0.004, 905);
  EXPECT_NEAR(lossless.reflectance, 0.0817, 1e-4);
  EXPECT_NEAR(lossless.transmittance, 0.9183, 1e-4);
}

// V8: clear float 4 mm at 905 nm, n and k by Rubin 1985; then the other wavelengths and thicknesses.
TEST(Panes, OfClearFloatTransmitWhatTheirOpticalConstantsSay) {
  EXPECT_NEAR(atWavelength(findMaterial("glass_float_clear_4mm")->transmittance, 905), 0.745, 2e-3);
  struct Constants {
    double wavelength_nm, n, k;
  };
  for (const auto& [wavelength, n, k] :
       {Constants{532, 1.5261, 1.81e-7}, Constants{660, 1.5207, 9.11e-7}, Constants{785, 1.5175, 2.28e-6},
        Constants{830, 1.5166, 2.89e-6}, Constants{905, 1.5152, 3.77e-6}, Constants{1064, 1.5129, 4.92e-6},
        Constants{1550, 1.5070, 3.95e-6}})
    for (const int mm : {4, 6, 10}) {
      const auto* pane = findMaterial("glass_float_clear_" + std::to_string(mm) + "mm");
      ASSERT_NE(pane, nullptr);
      EXPECT_NEAR(atWavelength(pane->transmittance, wavelength), slab(n, k, mm / 1000.0, wavelength).transmittance,
                  1e-3)
          << pane->id << " " << wavelength;
    }
  EXPECT_NEAR(slab(1.5152, 3.77e-6, 0.004, 905).reflectance, 0.067, 2e-3);
}

// n - λ dn/dλ of Rubin's formula for clear soda-lime glass, λ in µm, by a difference.
TEST(Panes, OfGlassDelayAPulseByTheirGroupIndex) {
  const auto n = [](double um) { return 1.5130 - 0.003169 * um * um + 0.003962 / (um * um); };
  for (const auto& [wavelength, group_index] : findMaterial("glass_float_clear_4mm")->group_index) {
    const double um = wavelength / 1000, slope = (n(um + 1e-4) - n(um - 1e-4)) / 2e-4;
    EXPECT_NEAR(group_index, n(um) - um * slope, 1e-4) << wavelength;
  }
  EXPECT_EQ(findMaterial("glass_double_clear_4mm")->group_index.size(), 7U);
}

TEST(Panes, StandApartInABuildUp) {
  const auto* one = findMaterial("glass_float_clear_4mm");
  for (const auto& [id, panes, thickness_m] :
       {std::tuple{"glass_double_clear_4mm", 2, 0.024}, {"glass_triple_clear_4mm", 3, 0.036}}) {
    const auto* unit = findMaterial(id);
    ASSERT_NE(unit, nullptr) << id;
    EXPECT_EQ(unit->panes, panes);
    EXPECT_EQ(unit->transmittance, one->transmittance);  // of one pane: what passes all is the radiometry's
    EXPECT_NEAR(buildUpThickness(*unit), thickness_m, 1e-9);
  }
  EXPECT_NEAR(buildUpThickness(*one), 0.004, 1e-12);
}

TEST(Library, KeepsTheTrapsOfTheWavelengths) {
  const auto at = [](const char* id, double wavelength) {
    return atWavelength(findMaterial(id)->reflectance, wavelength);
  };
  EXPECT_LE(at("snow_medium", 1550), 0.03);                                         // V17
  EXPECT_NEAR(at("brick_red_bare", 1550) / at("brick_red_bare", 660), 2.76, 0.05);  // red brick brightens
  EXPECT_LT(at("leaf_tree_broad_and_needle", 1550), 0.6 * at("leaf_tree_broad_and_needle", 1064));
  EXPECT_GT(at("fabric_nylon_black_coated", 1550), 4 * at("fabric_nylon_black_coated", 532));
  EXPECT_LT(at("paint_gloss_black_on_aluminium", 905), 0.01);  // its DHR is its gloss
}

// The page's table is written by hand or script; it must not fall behind the library.
TEST(Library, IsTheTableOfItsPage) {
  std::ifstream stream(SOURCE_DIR "/docs/reference/materials.md");
  const std::string page{std::istreambuf_iterator<char>(stream), {}};
  for (const auto& material : shippedLibrary()) {
    if (isGap(material)) continue;
    std::ostringstream row;
    row.setf(std::ios::fixed);
    row.precision(3);
    row << "| `" << material.id << "` | " << material.label;
    for (const double wavelength : {532, 905, 1550}) row << " | " << atWavelength(material.reflectance, wavelength);
    EXPECT_NE(page.find(row.str() + " |"), std::string::npos) << row.str();
  }
}

TEST(Library, ComesSortedByIdWithoutRepetition) {
  const auto& library = shippedLibrary();
  for (std::size_t i = 1; i < library.size(); ++i) EXPECT_LT(library[i - 1].id, library[i].id);
}

}  // namespace
}  // namespace standpoint

// SPDX-License-Identifier: GPL-3.0-or-later
#include <filesystem>
#include <fstream>
#include <memory>

#include <gtest/gtest.h>
#include <valijson/adapters/nlohmann_json_adapter.hpp>
#include <valijson/schema.hpp>
#include <valijson/schema_parser.hpp>
#include <valijson/validator.hpp>

namespace standpoint {
namespace {

using nlohmann::json;
using Adapter = valijson::adapters::NlohmannJsonAdapter;
namespace fs = std::filesystem;

json readJson(const fs::path& file) {
  std::ifstream stream(file);
  return json::parse(stream);
}

const fs::path kFolder = SOURCE_DIR "/scanners/instruments";

bool accepts(const json& document) {
  static const auto schema = [] {
    static const json text = readJson(kFolder / "schema.json");
    auto parsed = std::make_unique<valijson::Schema>();
    valijson::SchemaParser().populateSchema(Adapter(text), *parsed);
    return parsed;
  }();
  return valijson::Validator().validate(*schema, Adapter(document), nullptr);
}

// One that is carried and one on a tripod; a change is a JSON patch.
bool accepts(const char* id, const char* patch) {
  return accepts(readJson((kFolder / id).concat(".json")).patch(json::parse(patch)));
}

TEST(InstrumentSchema, AcceptsEveryShippedFile) {
  std::size_t files = 0;
  for (const auto& entry : fs::directory_iterator(kFolder)) {
    if (entry.path().extension() != ".json" || entry.path().filename() == "schema.json") continue;
    EXPECT_TRUE(accepts(readJson(entry.path()))) << entry.path();
    ++files;
  }
  EXPECT_EQ(files, 27U);
}

TEST(InstrumentSchema, RefusesWhatTheReaderRefuses) {
  const char* rtc = "leica-rtc360";
  EXPECT_TRUE(accepts(rtc, "[]"));
  EXPECT_FALSE(accepts(rtc, R"([{"op": "add", "path": "/beam/colour", "value": 1}])"));
  EXPECT_FALSE(accepts(rtc, R"([{"op": "remove", "path": "/range/min_m"}])"));
  EXPECT_FALSE(accepts(rtc, R"([{"op": "remove", "path": "/range/min_m/source"}])"));
  EXPECT_FALSE(accepts(rtc, R"([{"op": "remove", "path": "/angles/min_elevation_deg"}])"));
  EXPECT_FALSE(accepts(rtc, R"([{"op": "remove", "path": "/stand"}])"));
  EXPECT_FALSE(accepts(rtc, R"([{"op": "remove", "path": "/waveform/pulse_width_ns"}])"));
  EXPECT_FALSE(accepts(rtc, R"([{"op": "add", "path": "/waveform/fine_wavelength_m", "value": 1.2}])"));
  EXPECT_FALSE(accepts(rtc, R"([{"op": "remove", "path": "/correlated_noise/hurst"}])"));
  EXPECT_FALSE(accepts(rtc, R"([{"op": "replace", "path": "/technology/value", "value": "radar"}])"));
  const char* vlp = "velodyne-vlp-16";
  EXPECT_TRUE(accepts(vlp, "[]"));
  EXPECT_FALSE(accepts(vlp, R"([{"op": "add", "path": "/stand", "value": {}}])"));
  EXPECT_FALSE(accepts(vlp, R"([{"op": "remove", "path": "/moving/heads"}])"));
  EXPECT_FALSE(accepts(vlp, R"([{"op": "replace", "path": "/moving/channel_elevations_deg/value", "value": []}])"));
  EXPECT_FALSE(accepts(vlp, R"([{"op": "replace", "path": "/moving/mount/value", "value": "mast"}])"));
}

}  // namespace
}  // namespace standpoint

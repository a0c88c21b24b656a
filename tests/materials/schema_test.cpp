// SPDX-License-Identifier: GPL-3.0-or-later
#include <valijson/adapters/nlohmann_json_adapter.hpp>
#include <valijson/schema.hpp>
#include <valijson/schema_parser.hpp>
#include <valijson/validator.hpp>

#include "tests/materials/bad_entries.h"
#include "tests/materials/fixtures.h"

namespace standpoint {
namespace {

using nlohmann::json;
using Adapter = valijson::adapters::NlohmannJsonAdapter;

json readJson(const std::filesystem::path& file) {
  std::ifstream stream(file);
  return json::parse(stream);
}

bool accepts(const json& document) {
  static const auto schema = [] {
    static const json text = readJson(SOURCE_DIR "/materials/schema.json");
    auto parsed = std::make_unique<valijson::Schema>();
    valijson::SchemaParser().populateSchema(Adapter(text), *parsed);
    return parsed;
  }();
  return valijson::Validator().validate(*schema, Adapter(document), nullptr);
}

TEST(Schema, AcceptsEveryShippedFile) {
  for (const auto& entry : std::filesystem::directory_iterator(SOURCE_DIR "/materials/library"))
    EXPECT_TRUE(accepts(readJson(entry.path()))) << entry.path();
}

// The reader refuses all of them (BadEntries): the schema does too, but for what no schema can see.
TEST(Schema, RefusesWhatTheReaderRefuses) {
  std::size_t refused = 0;
  for (const auto& bad : badEntries()) {
    const auto document = json::parse(libraryWith(bad), nullptr, false);
    if (document.is_discarded()) continue;
    EXPECT_EQ(accepts(document), kBeyondSchema.contains(bad.name)) << bad.name;
    ++refused;
  }
  EXPECT_GE(refused, 30U);
  EXPECT_FALSE(accepts(json::array()));
  EXPECT_FALSE(accepts(json::parse(R"({"sources": [{"id": "a", "text": "A"}]})")));
}

}  // namespace
}  // namespace standpoint

// SPDX-License-Identifier: GPL-3.0-or-later
#include <gtest/gtest.h>

#include "editor/model/table_text.h"

namespace standpoint {
namespace {

using nlohmann::json;

TEST(TableText, IsRowsWithTabsForASpreadsheet) {
  const json figures = {{"all", 12.5},
                        {"name", "a\tb\nc"},
                        {"stations", {{{"name", "K1"}, {"points", 7}}, {{"name", "K2"}, {"note", nullptr}}}}};
  EXPECT_EQ(tableText(figures), "all\t12.5\nname\ta b c\n\nstations\nname\tpoints\tnote\nK1\t7\t\nK2\t\t\n");
}

TEST(TableText, BearsWhatIsNoTable) {
  EXPECT_EQ(tableText(json::object()), "");
  EXPECT_EQ(tableText({{"bounds", {1, 2}}, {"none", json::array()}}), "bounds\t[1,2]\nnone\t[]\n");
}

TEST(TableText, OfRowsHasAFieldForEachCellWhateverIsInIt) {
  EXPECT_EQ(rowsText({{"Name", "X"}, {"S1\tnew", "1.5"}, {"two\nlines", ""}}), "Name\tX\nS1 new\t1.5\ntwo lines\t\n");
  EXPECT_EQ(rowsText({}), "");
}

}  // namespace
}  // namespace standpoint

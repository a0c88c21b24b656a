// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <string>
#include <string_view>
#include <vector>

namespace standpoint {

// How languages count and write numbers, by the rules of Unicode's CLDR. `language` is a code such as "uk"; one that
// is not in the table counts as English does.

// The form that a noun has beside a count: "one", "few", "many" or "other". Counts are not negative.
std::string_view pluralForm(std::string_view language, double count);
// Those that whole numbers below a million take: what a text with a count has to have.
std::vector<std::string_view> pluralForms(std::string_view language);

// In sentences. Figures in fields, in files and in what is typed have a point in every language.
char decimalSign(std::string_view language);
// "6.1 mm" as a sentence of the language has it: "6,1 mm"; "45 %", in Italian and Polish "45%".
std::string numberInSentence(std::string figure, std::string_view language);

// A part of a text that depends on a count, as it stands between braces: "setups|one=setup|other=setups".
struct CountedPart {
  std::string_view fact;  // whose value is the count
  struct Form {
    std::string_view name, text;
  };
  std::vector<Form> forms;  // none: the part is the fact itself
};
CountedPart countedPart(std::string_view between_braces);
// The form's text; "other", and then the last, stand in for one that is missing.
std::string_view formFor(const CountedPart& part, std::string_view language, double count);

}  // namespace standpoint

// SPDX-License-Identifier: GPL-3.0-or-later
#include "importers/ifc/writer/step_writer.h"

#include <charconv>
#include <cmath>
#include <utility>

#include <fmt/format.h>

#include "importers/files/utf8.h"

namespace standpoint::ifc {
namespace {

constexpr std::size_t kBlock = std::size_t{1} << 20U;
template <class T>
std::string realText(T number) {
  if (!std::isfinite(number)) return "0.";
  std::array<char, 32> buffer;
  std::string text(buffer.data(), std::to_chars(buffer.data(), buffer.data() + buffer.size(), number).ptr);
  return stepReal(std::move(text));
}

}  // namespace

std::string stepText(std::string_view utf8) {
  std::string text = "'";
  int digits = 0;  // of each character of the run that is open
  for (std::size_t at = 0; at < utf8.size();) {
    const auto [code, bytes] = utf8At(utf8, at).value_or(Utf8Character{kReplacementCharacter, 1});
    at += bytes;
    const int needed = code >= 0x20 && code < 0x7F ? 0 : code < 0x10000 ? 4 : 8;
    if (needed != digits) {
      if (digits > 0) text += "\\X0\\";
      if (needed > 0) text += needed == 4 ? "\\X2\\" : "\\X4\\";
      digits = needed;
    }
    if (needed > 0) {
      text += fmt::format("{:0{}X}", code, needed);
    } else {
      text += static_cast<char>(code);
      if (code == '\'' || code == '\\') text += static_cast<char>(code);
    }
  }
  if (digits > 0) text += "\\X0\\";
  return text + '\'';
}

std::string stepReal(std::string number) {
  const auto e = number.find_first_of("eE");
  if (number.find('.') == std::string::npos) number.insert(e == std::string::npos ? number.size() : e, ".");
  if (const auto at = number.find('e'); at != std::string::npos) number[at] = 'E';
  return number;
}

std::string stepReal(double number) { return realText(number); }
std::string stepReal(float number) { return realText(number); }

StepRecord& StepRecord::next() {
  if (!first_) text_ += ',';
  first_ = false;
  return *this;
}

StepRecord& StepRecord::none(int count) {
  for (int i = 0; i < count; ++i) next().text_ += '$';
  return *this;
}

StepRecord& StepRecord::text(std::string_view utf8) { return raw(utf8.empty() ? "$" : stepText(utf8)); }
StepRecord& StepRecord::real(double number) { return raw(stepReal(number)); }
StepRecord& StepRecord::integer(std::int64_t number) { return raw(std::to_string(number)); }

StepRecord& StepRecord::symbol(std::string_view word) {
  return raw(word.empty() ? "$" : "." + std::string(word) + ".");
}

StepRecord& StepRecord::ref(Ref ref) { return raw(ref == 0 ? "$" : "#" + std::to_string(ref)); }

StepRecord& StepRecord::refs(std::span<const Ref> list) {
  std::string all = "(";
  for (const Ref r : list) all += (all.size() > 1 ? ",#" : "#") + std::to_string(r);
  return raw(all + ')');
}

StepRecord& StepRecord::reals(std::span<const double> list) {
  std::string all = "(";
  for (const double x : list) all += (all.size() > 1 ? "," : "") + stepReal(x);
  return raw(all + ')');
}

StepRecord& StepRecord::raw(std::string_view argument) {
  next().text_ += argument;
  return *this;
}

std::string StepRecord::take() { return std::exchange(text_, {}) + ')'; }

Result<StepWriter> StepWriter::create(const std::filesystem::path& file) {
  TRY_ASSIGN(auto part, PartFile::create(file));
  return StepWriter(std::move(part));
}

void StepWriter::header(std::string_view description, std::string_view schema, std::string_view program) {
  const std::string name = stepText(file_.file().filename().string());
  // No time: the same model is the same bytes.
  buffer_ += fmt::format(
      "ISO-10303-21;\nHEADER;\nFILE_DESCRIPTION(({}),'2;1');\nFILE_NAME({},'1970-01-01T00:00:00',(''),(''),{},{},'');\n"
      "FILE_SCHEMA(({}));\nENDSEC;\nDATA;\n",
      stepText(description), name, stepText(program), stepText(program), stepText(schema));
}

Ref StepWriter::addText(const std::string& record) {
  buffer_ += '#';
  buffer_ += std::to_string(++last_);
  buffer_ += '=';
  buffer_ += record;
  buffer_ += ";\n";
  if (buffer_.size() >= kBlock) flush();
  return last_;
}

Ref StepWriter::shared(StepRecord& record) {
  std::string text = record.take();
  if (const auto it = known_.find(text); it != known_.end()) return it->second;
  const Ref ref = addText(text);
  known_.emplace(std::move(text), ref);
  return ref;
}

void StepWriter::flush() {
  if (!fault_)
    if (auto written = file_.append(buffer_); !written) fault_ = written.error();
  buffer_.clear();
}

Result<void> StepWriter::commit() {
  buffer_ += "ENDSEC;\nEND-ISO-10303-21;\n";
  flush();
  if (fault_) return tl::make_unexpected(*fault_);
  return file_.commit();
}

}  // namespace standpoint::ifc

// SPDX-License-Identifier: GPL-3.0-or-later
#include "cli/command_line.h"

#include <algorithm>
#include <atomic>
#include <chrono>
#include <map>
#include <ostream>
#include <thread>

#include <CLI/CLI.hpp>
#include <fmt/format.h>

#include "cli/option_words.h"
#include "core/alike_issues.h"
#include "project/answers.h"
#include "project/storage/session.h"

namespace standpoint {

namespace {

using nlohmann::json;

// What CLI11 fills in for one verb; turned into the JSON that a job file would have.
struct Words {
  const Verb* verb = nullptr;
  CLI::App* app = nullptr;
  std::string project;
  std::map<std::string, std::string> values;  // by parameter
  std::map<std::string, std::vector<std::string>> lists;
  std::map<std::string, bool> flags;
  bool print_json = false;
  bool allow_loss = false;
  bool all_issues = false;
};

std::string helpOf(const Parameter& p) {
  std::string help = fullHelp(p);
  const auto& value = p.default_value;
  if (value.is_null()) return help;
  help += fmt::format(" (default {})", value.is_string()         ? value.get<std::string>()
                                       : value.is_number_float() ? fmt::format("{}", value.get<double>())
                                                                 : value.dump());
  return help;
}

void describeVerb(Words& words) {
  CLI::App& app = *words.app;
  if (takesProject(*words.verb)) app.add_option("project", words.project, "project folder")->required();
  for (const auto& p : words.verb->parameters) {
    if (p.kind == ParameterKind::flag) {
      app.add_flag(fmt::format("--{}", p.name), words.flags[p.name], helpOf(p));
      continue;
    }
    std::string names = p.positional ? std::string(p.name) : fmt::format("--{}", p.name);
    if (std::string_view(p.name) == "output") names = "-o," + names;
    const bool many = p.kind == ParameterKind::list || p.kind == ParameterKind::pairs;
    auto* option = many ? app.add_option(names, words.lists[p.name], helpOf(p))
                        : app.add_option(names, words.values[p.name], helpOf(p));
    option->type_name(placeholder(p));
    if (p.required) option->required();
  }
  app.add_flag("--json", words.print_json, "print the result as one JSON object to standard output");
  app.add_flag("--allow-loss", words.allow_loss, "exit with code 0 even if data was lost");
  app.add_flag("--all-issues", words.all_issues, "list every issue, also where more than 20 are alike");
}

Result<json> valueOf(const Parameter& p, const std::string& text) {
  switch (p.kind) {
    case ParameterKind::triple: {
      auto numbers = parseNumbers(text);
      if (!numbers) return failure(ErrorKind::usage, numbers.error().message, fmt::format("--{}", p.name));
      return numbers;
    }
    case ParameterKind::number:
    case ParameterKind::integer: {
      const json number = json::parse(text, nullptr, false);
      if (!number.is_number())
        return failure(ErrorKind::usage, fmt::format("'{}' is not a number", text), fmt::format("--{}", p.name));
      return number;
    }
    default: return json(text);
  }
}

Result<json> optionsFrom(const Words& words) {
  json options = json::object();
  if (!words.project.empty()) options["project"] = words.project;
  for (const auto& p : words.verb->parameters) {
    if (const auto flag = words.flags.find(p.name); flag != words.flags.end()) {
      if (flag->second) options[p.name] = true;
      continue;
    }
    if (const auto list = words.lists.find(p.name); list != words.lists.end()) {
      if (!list->second.empty()) options[p.name] = list->second;
      continue;
    }
    if (words.app->count(p.positional ? std::string(p.name) : fmt::format("--{}", p.name)) == 0) continue;
    auto value = valueOf(p, words.values.at(p.name));
    if (!value) return value;
    options[p.name] = *std::move(value);
  }
  return options;
}

// A bar on a terminal, redrawn ten times a second from its own thread; nothing otherwise.
class Bar {
 public:
  Bar(const Streams& streams, const Progress& progress) : streams_(streams) {
    if (!streams.bar) return;
    thread_ = std::thread([this, &progress] {
      while (!stop_.load()) {
        const int done = static_cast<int>(progress.fraction() * 30);
        streams_.err << fmt::format("\r\033[K[{:<30}] {:3.0f} % {}", std::string(static_cast<std::size_t>(done), '#'),
                                    progress.fraction() * 100, progress.stageName())
                     << std::flush;
        std::this_thread::sleep_for(std::chrono::milliseconds(100));
      }
      streams_.err << "\r\033[K" << std::flush;
    });
  }
  ~Bar() {
    stop_.store(true);
    if (thread_.joinable()) thread_.join();
  }
  Bar(const Bar&) = delete;
  Bar& operator=(const Bar&) = delete;

 private:
  const Streams& streams_;
  std::atomic<bool> stop_{false};
  std::thread thread_;
};

// Names come from files, and not every file keeps to UTF-8.
std::string asText(const json& value) { return value.dump(-1, ' ', false, json::error_handler_t::replace); }

void printIssues(const Report& report, bool all, const Streams& streams) {
  const auto print = [&](const Issue& issue, const std::string& more) {
    streams.err << fmt::format("{}: {}{}{}{}\n", name(issue.severity), issue.source, issue.source.empty() ? "" : ": ",
                               issue.message, more);
  };
  if (all) {
    for (const auto& issue : report.issues) print(issue, "");
    return;
  }
  for (const auto& alike : alikeIssues(report)) {
    const auto more = fmt::format(" (the first of {} alike; list them with --all-issues)", alike.count());
    print(report.issues[alike.first], alike.others.empty() ? "" : more);
  }
}

void printText(const Outcome& outcome, bool all_issues, const Streams& streams) {
  printIssues(outcome.report, all_issues, streams);
  if (!outcome.description.empty()) streams.out << outcome.description << "\n";
  streams.out << outcome.text;
  if (!outcome.text.empty()) return;
  for (const auto& [key, value] : outcome.answer.items())
    if (value.is_primitive() && key != "seconds") streams.out << fmt::format("  {}: {}\n", key, asText(value));
}

int finish(const Words& words, const Result<Outcome>& outcome, const Streams& streams) {
  if (!outcome) {
    if (words.print_json)
      streams.out << asText({{"error", {{"message", outcome.error().message}, {"source", outcome.error().source}}}})
                  << "\n";
    streams.err << "standpoint " << words.verb->name << ": " << describe(outcome.error()) << "\n";
    return exitCode(outcome.error().kind);
  }
  if (words.print_json) {
    streams.out << asText(outcome->answer) << "\n";
  } else {
    printText(*outcome, words.all_issues, streams);
  }
  streams.out.flush();
  if (!streams.out) {
    streams.err << "standpoint: cannot write the answer to standard output\n";
    return kFileSystem;
  }
  return outcome->report.losses() > 0 && !words.allow_loss ? kLossOrUnusable : kDone;
}

}  // namespace

int exitCode(ErrorKind kind) {
  switch (kind) {
    case ErrorKind::usage: return kWrongUsage;
    case ErrorKind::unusable:
    case ErrorKind::internal: return kLossOrUnusable;
    case ErrorKind::file_system: return kFileSystem;
    case ErrorKind::cancelled: return kCancelled;
  }
  return kLossOrUnusable;
}

int runCommandLine(std::span<const Verb> table, const std::vector<std::string>& words, const Streams& streams,
                   Progress& progress) {
  CLI::App app("Standpoint turns building models into environments for rehearsing laser scanning.", "standpoint");
  app.set_version_flag("--version", "standpoint " STANDPOINT_VERSION);
  app.require_subcommand(1);
  app.set_help_all_flag("--help-all", "list all commands");
  std::vector<Words> all(table.size());
  for (std::size_t i = 0; i < table.size(); ++i) {
    all[i].verb = &table[i];
    all[i].app = app.add_subcommand(table[i].name, table[i].summary);
    describeVerb(all[i]);
  }
  std::string topic;
  auto* help = app.add_subcommand("help", "Show help for a command");
  help->add_option("verb", topic, "command");
  app.footer("standpoint edit [PROJECT] opens the editor.");

  try {
    std::vector<std::string> reversed(words.rbegin(), words.rend());
    app.parse(reversed);
  } catch (const CLI::ParseError& e) {
    return app.exit(e, streams.out, streams.err) == 0 ? kDone : kWrongUsage;
  }
  if (help->parsed()) {
    const CLI::App* asked = topic.empty() ? &app : nullptr;
    for (const auto& candidate : all)
      if (topic == candidate.verb->name) asked = candidate.app;
    if (asked == nullptr) {
      streams.err << fmt::format("standpoint: unknown command '{}'; see `standpoint help`\n", topic);
      return kWrongUsage;
    }
    // App::help() would answer with the help of the subcommand that was parsed: this one.
    streams.out << asked->get_formatter()->make_help(asked, asked == &app ? "standpoint" : "standpoint " + topic,
                                                     CLI::AppFormatMode::Normal);
    return kDone;
  }
  for (auto& parsed : all) {
    if (!parsed.app->parsed()) continue;
    auto options = optionsFrom(parsed);
    if (!options) return finish(parsed, failure(options.error()), streams);
    Result<Outcome> outcome = failure(ErrorKind::internal, "skipped");
    {
      const Bar bar(streams, progress);
      outcome = runOnDisk(*parsed.verb, *options, progress);
    }
    return finish(parsed, outcome, streams);
  }
  return kWrongUsage;
}

}  // namespace standpoint

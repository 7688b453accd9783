// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors

#include "treadmark/app/cli/command_frame.hpp"

#include <fmt/format.h>
#include <unistd.h>

#include <algorithm>
#include <csignal>
#include <cstdio>
#include <iostream>

#include "treadmark/app/cli/page_file.hpp"
#include "treadmark/app/cli/terminal.hpp"
#include "treadmark/app/surfaces/profile_check.hpp"
#include "treadmark/core/cancellation.hpp"
#include "treadmark/core/error.hpp"
#include "treadmark/core/output_file.hpp"
#include "treadmark/core/parts.hpp"
#include "treadmark/core/platform/ranges.hpp"
#include "treadmark/core/to_whole.hpp"
#include "treadmark/model/shape/body_name.hpp"
#include "treadmark/report/write_page.hpp"

namespace treadmark::cli {
namespace {

constexpr const char *kOutput = "output", *kTold = "told output";

bool is_marked(CLI::Option& option, const char* mark) {
  try {
    return option.get_validator(mark) != nullptr;
  } catch (const CLI::OptionNotFound&) {
    return false;
  }
}

}  // namespace

void add_case_files(CLI::App& verb, std::vector<std::string>& cases, std::vector<std::string>& overrides) {
  verb.add_option("CASE", cases, "Treadmark case (.toml) or CONTACT input file (.inp)")->required();
  add_overrides(verb, overrides);
}

void add_overrides(CLI::App& verb, std::vector<std::string>& overrides, const char* example) {
  verb.add_option("--set", overrides, fmt::format("Override a key of the file, for example --set {}", example))
      ->type_name(kSettingWord)
      ->allow_extra_args(false)
      ->multi_option_policy(CLI::MultiOptionPolicy::TakeAll);
}

void add_report_file(CLI::App& verb, std::string& file) {
  add_output(verb, "--report", file, "Write a report here that opens in any browser, offline; .pdf: as it is printed",
             "FILE.html")
      ->each([](const std::string& name) {
        require_part("report", "--report");
        check_page_name(name);
      });
}

std::optional<Body> body_asked(const std::string& word, const std::filesystem::path& file, bool quiet) {
  if (!word.empty()) return word == "wheel" ? Body::wheel : Body::rail;
  const std::optional<Body> body = app::body_by_shape(file);
  if (body)
    print_notes(
        {fmt::format("{}: taken for a {} by its shape: say --body if it is none", file.string(), body_name(*body))},
        quiet);
  return body;
}

CLI::Validator is_output(bool told) {
  return {[](std::string&) { return std::string(); }, "", told ? kTold : kOutput};
}

NamedFiles named_files(CLI::App& verb) {
  NamedFiles named;
  for (CLI::Option* option : verb.get_options()) {
    const auto& words = option->results();
    const bool untold = is_marked(*option, kOutput);
    auto& list = untold || is_marked(*option, kTold) ? named.outputs : named.others;
    list.insert(list.end(), words.begin(), words.end());
    if (untold) named.untold.insert(named.untold.end(), words.begin(), words.end());
  }
  return named;
}

Command add_left_out(CLI::App& verb) {
  verb.description(verb.get_description() + " (left out of this build)");
  verb.allow_extras();
  verb.fallthrough(false);
  const auto row = ranges::find(verbs(), verb.get_name(), [](const Verb& v) { return std::string(v.name); });
  return [row](const CommonOptions&) -> int { left_out(row->part, std::string("treadmark ") + row->name); };
}

void print_notes(const std::vector<std::string>& notes, bool quiet) {
  if (quiet) return;
  for (const std::string& note : notes) std::cerr << "note: " << note << '\n';
}

void print_results(const std::string& json_file, const std::function<std::string()>& json,
                   const std::function<std::string()>& text) {
  if (json_file == "-")
    std::cout << json();
  else
    print(text());
}

void write_json_file(const std::string& json_file, const std::function<std::string()>& json) {
  if (json_file.empty() || json_file == "-") return;
  const std::string text = json();
  catch_interrupt();  // from here on nothing is left half-written
  write_file(json_file, text);
}

void write_report_file(const std::filesystem::path& file, const std::function<report::Page()>& page) {
  if (file.empty()) return;
  const std::string html = report::to_html(page());
  catch_interrupt();
  write_page(file, html);
}

namespace {

std::atomic<bool> interrupt_flag{false};
static_assert(std::atomic<bool>::is_always_lock_free, "needed inside a signal handler");

extern "C" void on_interrupt(int signal_number) {
  interrupt_flag.store(true);
  std::signal(signal_number, SIG_DFL);
}

}  // namespace

int unless_interrupted(const std::function<int()>& work) {
  try {
    return work();
  } catch (const Cancelled& e) {
    std::cerr << "interrupted: " << e.what() << " before there was anything to write\n";
    return kFailed;
  }
}

const std::atomic<bool>& interrupted() { return interrupt_flag; }
void catch_interrupt() {
  if (interrupt_flag.load()) return;  // the next Ctrl-C ends the program
  std::signal(SIGINT, on_interrupt);
  std::signal(SIGTERM, on_interrupt);
}

ProgressLine::ProgressLine(bool quiet, Units units)
    : visible_(!quiet && isatty(STDERR_FILENO) == 1),
      units_(units),
      start_(std::chrono::steady_clock::now()),
      last_(start_) {}

ProgressLine::~ProgressLine() {
  if (clock_.joinable()) {
    {
      const std::lock_guard lock(mutex_);
      ended_ = true;
    }
    end_.notify_one();
    clock_.join();
  }
  if (drawn_) std::fputs("\r\x1b[K", stderr);
}

void ProgressLine::draw(const std::string& text) {
  drawn_ = true;
  const std::string_view shown = cut(text, terminal_columns(STDERR_FILENO) - 1);  // what breaks cannot be drawn over
  std::fputs(fmt::format("\r\x1b[K{}", shown).c_str(), stderr);
  std::fflush(stderr);
}

std::string time_left(double seconds) {
  constexpr double kMinute = 60.0, kHour = 3600.0;
  if (seconds < kMinute) return fmt::format("{:.1f} s", seconds);
  const auto whole = to_whole<long>(std::min(seconds, 1e9));
  if (seconds < kHour) return fmt::format("{} min {:02} s", whole / 60, whole % 60);
  return fmt::format("{} h {:02} min", whole / 3600, whole % 3600 / 60);
}

void ProgressLine::update(std::size_t finished, std::size_t total, const std::string& what) {
  using namespace std::chrono_literals;
  if (!visible_) return;
  const auto now = std::chrono::steady_clock::now();
  const auto seconds = [this] {
    return std::chrono::duration<double>(std::chrono::steady_clock::now() - start_).count();
  };
  if (units_ == Units::different) {
    const std::lock_guard lock(mutex_);
    step_ = fmt::format("step {} of {}: {}", std::min(finished + 1, total), total, what);
    draw(fmt::format("{}, {:.0f} s so far", step_, seconds()));
    if (!clock_.joinable())
      clock_ = std::thread([this, seconds] {
        std::unique_lock hold(mutex_);
        while (!end_.wait_for(hold, 1s, [this] { return ended_; }))
          draw(fmt::format("{}, {:.0f} s so far", step_, seconds()));
      });
    return;
  }
  if (what.empty()) found_ = finished, start_ = now;
  if (drawn_ && finished < total && now - last_ < 100ms) return;
  last_ = now;
  constexpr double kCells = 20.0;
  const double share = static_cast<double>(finished) / static_cast<double>(total);
  std::string line =
      fmt::format("[{:.<20}] {}/{} ({:.0f} %) {}", std::string(to_whole<std::size_t>(kCells * share), '#'), finished,
                  total, 100.0 * share, what);
  if (finished > found_)
    line += fmt::format(", {} left", time_left(seconds() / static_cast<double>(finished - found_) *
                                               static_cast<double>(total - finished)));
  draw(line);
}

}  // namespace treadmark::cli

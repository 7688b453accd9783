// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#pragma once

#include <CLI/CLI.hpp>

#include <atomic>
#include <chrono>
#include <condition_variable>
#include <cstddef>
#include <filesystem>
#include <functional>
#include <memory>
#include <mutex>
#include <optional>
#include <string>
#include <thread>
#include <vector>

#include "treadmark/app/cli/shell_words.hpp"
#include "treadmark/app/cli/verbs.hpp"
#include "treadmark/core/progress.hpp"
#include "treadmark/model/shape/profile.hpp"
#include "treadmark/report/page.hpp"

namespace treadmark::cli {

/// Set by Ctrl-C while it is caught: work stops at its next check point. A second Ctrl-C ends the program at once.
const std::atomic<bool>& interrupted();
/// To be called as often as wanted.
void catch_interrupt();

/// Whether units of work take about equally long, so that what is left can be told from what is done.
enum class Units { alike, different };

/// A time for people: "12.3 s", "4 min 05 s", "2 h 10 min".
std::string time_left(double seconds);

/// One line on stderr with count and estimated time left, redrawn at most ten times a second; of different units with
/// the time so far, redrawn every second. Silent off a terminal.
class ProgressLine {
 public:
  ProgressLine(bool quiet, Units units);
  ~ProgressLine();
  /// what: the unit; empty: so many were finished before the work began.
  void update(std::size_t finished, std::size_t total, const std::string& what);

 private:
  void draw(const std::string& text);

  bool visible_;
  Units units_;
  bool drawn_ = false;
  std::chrono::steady_clock::time_point start_, last_;
  std::size_t found_ = 0;  ///< units that were finished at the start: they say nothing of the time that others take
  std::mutex mutex_;
  std::string step_;  ///< of different units
  std::thread clock_;
  std::condition_variable end_;
  bool ended_ = false;
};

/// What several verbs have in common: options, and the frame round their work.

/// What work returns, or the exit status of what was interrupted before it had anything to write.
int unless_interrupted(const std::function<int()>& work);

/// The command of a verb: run(options, common).
template <class Options>
Command command(std::shared_ptr<Options> options, int (*run)(const Options&, const CommonOptions&)) {
  return
      [options, run](const CommonOptions& common) { return unless_interrupted([&] { return run(*options, common); }); };
}

/// CASE... and --set.
void add_case_files(CLI::App& verb, std::vector<std::string>& cases, std::vector<std::string>& overrides);
/// --set.
/// example: a key of the files that the verb reads, with a value.
void add_overrides(CLI::App& verb, std::vector<std::string>& overrides, const char* example = "wheelset.y_mm=3");
/// Marks an option that names what is written. told: the verb itself says so on standard output.
CLI::Validator is_output(bool told = false);
/// An option that names what is written.
template <class Value>
CLI::Option* add_output(CLI::App& verb, const char* name, Value& value, const std::string& text, const char* type) {
  return verb.add_option(name, value, text)->check(is_output())->type_name(type);
}
/// The words that options of a verb were given: names of outputs, those of them that the verb does not tell, and
/// others, files that are read among them.
struct NamedFiles {
  std::vector<std::string> outputs, untold, others;
};
NamedFiles named_files(CLI::App& verb);
/// --report of a file.
void add_report_file(CLI::App& verb, std::string& file);
/// The body that --body names; without it that of a profile by its shape, with a note.
std::optional<Body> body_asked(const std::string& word, const std::filesystem::path& file, bool quiet);
/// An option of several values with commas between them.
template <class Value>
CLI::Option* add_values(CLI::App& verb, const char* name, std::vector<Value>& values, const char* text,
                        const char* type) {
  return verb.add_option(name, values, text)->delimiter(',')->allow_extra_args(false)->type_name(type);
}

/// Does the work with a progress line on a terminal (unless quiet), and stops it at Ctrl-C.
template <class Work>
auto with_progress(bool quiet, Work work, Units units = Units::alike) {
  catch_interrupt();
  ProgressLine line(quiet, units);
  Progress progress;
  progress.stop = &interrupted();
  progress.report = [&](std::size_t finished, std::size_t total, const std::string& what) {
    line.update(finished, total, what);
  };
  return work(progress);
}

/// Notes to standard error, unless quiet.
void print_notes(const std::vector<std::string>& notes, bool quiet);

/// The results on standard output: as JSON where the name of the JSON file is "-", else as text.
void print_results(const std::string& json_file, const std::function<std::string()>& json,
                   const std::function<std::string()>& text);
/// The JSON file, if one was asked for and is not standard output.
void write_json_file(const std::string& json_file, const std::function<std::string()>& json);

/// Makes the page and writes it as a live report; an empty name: does nothing.
void write_report_file(const std::filesystem::path& file, const std::function<report::Page()>& page);

}  // namespace treadmark::cli

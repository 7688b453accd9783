// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#include <fcntl.h>
#include <fmt/format.h>
#include <unistd.h>
#include <CLI/CLI.hpp>

#include <algorithm>
#include <csignal>
#include <cstdlib>
#include <cstring>
#include <exception>
#include <filesystem>
#include <iostream>
#include <memory>
#include <new>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "treadmark/app/cli/command_frame.hpp"
#include "treadmark/app/cli/printable_stream.hpp"
#include "treadmark/app/cli/terminal.hpp"
#include "treadmark/app/cli/usage_faults.hpp"
#include "treadmark/app/cli/verbs.hpp"
#include "treadmark/app/plugins/plugin.hpp"
#include "treadmark/app/version.hpp"
#include "treadmark/core/error.hpp"
#include "treadmark/core/output_claim.hpp"
#include "treadmark/core/output_file.hpp"
#include "treadmark/core/platform/ranges.hpp"

namespace {

using namespace treadmark;

int exit_status(const Error& error) {
  switch (error.kind()) {
    case ErrorKind::configuration:
      return cli::kUsage;
    case ErrorKind::input_data:
      return cli::kInputData;
    case ErrorKind::numerical:
      return cli::kFailed;
  }
  return cli::kFailed;
}

/// A standard stream that is closed would become the next file that is opened, and take what is printed. Nothing can be
/// read from or written to what takes its place.
void hold_standard_streams() {
  for (const int stream : {STDIN_FILENO, STDOUT_FILENO, STDERR_FILENO})
    if (::fcntl(stream, F_GETFD) == -1) ::open("/dev/null", stream == STDIN_FILENO ? O_WRONLY : O_RDONLY);
}

constexpr const char* kNoMemory =
    "treadmark: not enough memory for this problem (use larger element sizes or fewer threads)\n";

/// Where memory fails while something is thrown or freed nothing can be caught, and within the standard library not
/// even be looked at; what is being written stays under its hidden name, as after a kill.
[[noreturn]] void leave_without_memory() {
  bool no_memory = std::uncaught_exceptions() > 0;
  try {
    if (const std::exception_ptr thrown = std::current_exception()) std::rethrow_exception(thrown);
  } catch (const std::bad_alloc&) {
    no_memory = true;
  } catch (...) {
    no_memory = false;
  }
  if (!no_memory) std::abort();
  [[maybe_unused]] const auto said = ::write(STDERR_FILENO, kNoMemory, std::strlen(kNoMemory));
  std::_Exit(cli::kFailed);
}

constexpr const char* kFirstSteps =
    "\nFirst steps:\n"
    "  treadmark new case                           a case file to start from (also study, vehicle, simulation ...)\n"
    "  treadmark run CASE.toml --report out.html    solve a case and look at it in a browser\n"
    "  treadmark check CASE.toml -o out             see what is understood, wheel over rail as a picture\n"
    "  treadmark import SCAN.ply -o wheel.slcw      a surface from a laser scan\n"
    "  treadmark VERB --help                        all options of a verb\n";

/// Verbs with a line each, whose beginning no option makes wide.
class Help final : public CLI::Formatter {
  std::string make_subcommand(const CLI::App* verb) const override {
    return fmt::format("  {:<11} {}\n", verb->get_name(), verb->get_description());
  }
};

void print_help(const std::string& text) {
  constexpr std::size_t kWidest = 100, kInFiles = 80;
  const std::size_t columns = cli::terminal_columns(STDOUT_FILENO);
  std::cout << cli::folded(text, columns == 0 ? kInFiles : std::min(columns, kWidest));
}

/// Everything but whether the standard output took what it was given.
int parse_and_run(int argc, char** argv) {
  CLI::App program{"Treadmark: wheel-rail contact on any 3D surface", "treadmark"};
  program.set_version_flag(
      "--version", "treadmark " + app::version() + " (" + app::git_revision() + ")\n" + app::build_description(),
      "Display version and parts of the program; with --json behind it also libraries and licences, for programs; with "
      "--spdx as a bill of materials (SPDX)");
  program.formatter(std::make_shared<Help>());
  program.require_subcommand(1);
  program.fallthrough();
  program.footer(
      "Exit status: 0 ok, 1 failed, 2 usage or configuration, 3 bad input data, 4 not converged (results still "
      "written).\n"
      "Results go to standard output, everything else to standard error.");

  cli::CommonOptions common;
  const CLI::Option* threads =
      program.add_option("--threads", common.threads, "Number of threads, 0 = all cores")->check(CLI::Range(0, 4096));
  program.add_flag("--quiet", common.quiet, "No progress and no notes");
  program
      .add_option("--plugin", common.plugins,
                  "Plug-in with backends or detectors (.so), beside those of $TREADMARK_PLUGINS; once for each")
      ->type_name("FILE")
      ->allow_extra_args(false)
      ->multi_option_policy(CLI::MultiOptionPolicy::TakeAll);

  std::vector<std::pair<CLI::App*, cli::Command>> commands;
  for (const cli::Verb& verb : cli::verbs()) {
    CLI::App* app = program.add_subcommand(verb.name, verb.summary)->group(verb.group);
    app->footer(fmt::format("Examples:\n{}\n{}", cli::example_lines(verb), program.get_footer()));
    commands.emplace_back(app, verb.add(*app));
  }
  if (argc == 1) {
    print_help(program.help() + kFirstSteps);
    return cli::kUsage;
  }
  using namespace std::string_literals;
  using namespace std::string_view_literals;
  if (argc == 3 && argv[1] == "--version"sv && argv[2] == "--json"sv) {
    std::cout << app::version_json();
    return cli::kOk;
  }
  if (argc == 3 && argv[1] == "--version"sv && argv[2] == "--spdx"sv) {
    std::cout << app::version_spdx();
    return cli::kOk;
  }
  std::vector<std::string> words = cli::with_help({argv + 1, argv + argc});
  cli::check_words(program, words);
  try {
    ranges::reverse(words);  // as the parser takes them
    program.parse(std::move(words));
  } catch (const CLI::ParseError& e) {
    if (e.get_exit_code() == 0) {
      print_help(dynamic_cast<const CLI::CallForVersion*>(&e) != nullptr ? e.what() + "\n"s : program.help());
      return cli::kOk;
    }
    std::cerr << cli::usage_fault(program, e);
    return cli::kUsage;
  }
  common.threads_given = threads->count() > 0;
  app::load_plugins(app::plugins_of_environment());
  app::load_plugins(common.plugins);
  for (const auto& [verb, command] : commands) {
    if (!verb->parsed()) continue;
    const cli::NamedFiles named = cli::named_files(*verb);
    const OutputClaim claim(named.outputs);
    for (const std::string& word : named.others) refuse_output_as_input(word);
    const int status = command(common);
    std::error_code unknown;
    for (const std::string& output : named.untold)
      if (!common.quiet && !cli::interrupted() && std::filesystem::exists(output, unknown) && !is_stream(output))
        std::cerr << "results: " << output << '\n';
    return status;
  }
  return cli::kUsage;
}

/// The same with every failure as a message and a status.
int run(int argc, char** argv) {
  try {
    return parse_and_run(argc, argv);
  } catch (const Error& e) {
    std::cerr << "treadmark: " << e.what() << '\n';
    return exit_status(e);
  } catch (const std::bad_alloc&) {
    std::cerr << kNoMemory;
    return cli::kFailed;
  } catch (const std::filesystem::filesystem_error& e) {
    std::cerr << "treadmark: " << e.path1().string() << ": " << e.code().message()
              << " (check the path and its permissions)\n";
    return cli::kUsage;
  } catch (const std::exception& e) {
    std::cerr << "treadmark: unexpected failure: " << e.what() << '\n';
    return cli::kFailed;
  }
}

}  // namespace

int main(int argc, char** argv) {
  hold_standard_streams();
  std::signal(SIGXFSZ, SIG_IGN);  // a file beyond the limit is an error of writing
  std::set_terminate(leave_without_memory);
  cli::PrintableStream out(std::cout, cli::has_colours(STDOUT_FILENO), 0),
      err(std::cerr, cli::has_colours(STDERR_FILENO), cli::terminal_columns(STDERR_FILENO));
  const int status = run(argc, argv);
  if (std::cout.flush()) return status;
  std::cerr << "treadmark: the results could not be written to standard output (is its disk full, or is it closed?)\n";
  return status == cli::kOk || status == cli::kNotConverged ? cli::kFailed : status;
}

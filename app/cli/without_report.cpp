// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#include "treadmark/app/assessment/pages/assessment_page.hpp"
#include "treadmark/app/bench/pages/bench_page.hpp"
#include "treadmark/app/cases/pages/run_page.hpp"
#include "treadmark/app/cli/verbs.hpp"
#include "treadmark/app/compare/pages/compare_page.hpp"
#include "treadmark/app/import/pages/import_page.hpp"
#include "treadmark/app/pages/plain_page.hpp"
#include "treadmark/app/pages/read_report.hpp"
#include "treadmark/app/simulation/pages/simulation_page.hpp"
#include "treadmark/app/surfaces/pages/check_page.hpp"
#include "treadmark/core/parts.hpp"
#include "treadmark/report/write_page.hpp"

namespace treadmark::cli {

Command add_report(CLI::App& verb) { return add_left_out(verb); }
Command add_plot(CLI::App& verb) { return add_left_out(verb); }
Command add_live(CLI::App& verb) { return add_left_out(verb); }

}  // namespace treadmark::cli

// Nobody gets as far: --report is refused before.
namespace treadmark::report {
namespace {

[[noreturn]] void without_report() { left_out("report", "reports"); }

}  // namespace

std::string to_html(const Page&, const PageOptions&) { without_report(); }

}  // namespace treadmark::report

namespace treadmark::app::pages {

using namespace report;

Page read_report(const std::filesystem::path&) { without_report(); }
Page plain_page(const std::string&, const std::string&, const std::string&, std::vector<Figure>) { without_report(); }
Page read_overlay(const std::vector<std::filesystem::path>&) { without_report(); }
Page run_page(const std::shared_ptr<const io::RunResult>&, std::string) { without_report(); }
Page check_page(const std::vector<CheckedInput>&) { without_report(); }
Page compare_page(const std::shared_ptr<const io::Comparison>&, std::string) { without_report(); }
Page bench_page(const BenchReport&, std::string) { without_report(); }
Page import_page(const io::ImportReport&, std::string, const std::filesystem::path&) { without_report(); }
Page simulation_page(const std::shared_ptr<const io::SimulationResult>&, std::string, const AssessedRun*) {
  without_report();
}
Page assessment_page(std::span<const AssessedRun>, std::span<const std::string>) { without_report(); }

}  // namespace treadmark::app::pages

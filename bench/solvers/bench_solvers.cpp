// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
// How the time of normal and tangential problem grows with the number of elements, on one thread.
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <exception>
#include <fstream>
#include <map>
#include <nlohmann/json.hpp>
#include <optional>
#include <string>
#include <string_view>

#include "treadmark/bench/solvers/solver_checks.hpp"
#include "treadmark/bench/solvers/solver_times.hpp"
#include "treadmark/core/parallel.hpp"

namespace {

using namespace treadmark;

constexpr int kGrids[] = {70, 142, 281, 557, 785};
constexpr int kReferenceGrid = 142;  ///< growth is relative to it: smaller problems live in the cache
constexpr int kRepetitions = 3;
constexpr const char* kUsage =
    "usage: bench_solvers [--largest N] [--json FILE]\n"
    "       --largest N   grids of at most N x N elements (70, 142, 281, 557, 785)\n"
    "       --json FILE   writes checks and times there, too\n";

struct Options {
  int largest = 785;
  std::string json;
};

std::optional<Options> parse(int argc, char** argv) {
  Options out;
  for (int i = 1; i < argc; i += 2) {
    const std::string_view name = argv[i];
    if (i + 1 == argc) return std::nullopt;
    if (name == "--json") {
      out.json = argv[i + 1];
    } else if (name == "--largest") {
      char* end = nullptr;
      const long n = std::strtol(argv[i + 1], &end, 10);
      if (*end != '\0' || n < kGrids[0] || n > 100000) return std::nullopt;
      out.largest = static_cast<int>(n);
    } else {
      return std::nullopt;
    }
  }
  return out;
}

double over_n_log_n(const bench::SolverTime& t) { return t.time.cpu / (t.elements * std::log2(t.elements)); }

bool print_checks(nlohmann::json& json) {
  bool passed = true;
  for (const bench::SolverCheck& check : bench::check_solvers()) {
    std::printf("%-6s %-85s %8.1e (at most %.0e)\n", check.passed() ? "agree" : "WRONG", check.what.c_str(),
                check.difference, check.allowed);
    json["checks"].push_back({{"what", check.what}, {"difference", check.difference}, {"allowed", check.allowed}});
    passed = passed && check.passed();
  }
  std::fflush(stdout);
  return passed;
}

void print(const bench::SolverTime& t, std::optional<double> growth) {
  std::printf("%-24s %4d %8d %9.4f %9.4f %6d %8.1f", t.problem.c_str(), t.n, t.elements, t.time.cpu, t.time.wall,
              t.iterations, t.nanoseconds_each());
  growth ? std::printf(" %7.2f", *growth) : std::printf(" %7s", "-");
  if (t.products > 0.0) std::printf(" %9.0f %11.2f %11.2f %6.3f", t.products, t.force_x, t.force_y, t.saturation);
  std::printf("%s\n", t.converged ? "" : "  not converged");
  std::fflush(stdout);
}

bool print_times(int largest, nlohmann::json& json) {
  std::printf("\n%-24s %4s %8s %9s %9s %6s %8s %7s %9s %11s %11s %6s\n", "problem", "n", "contact", "cpu s", "wall s",
              "iter.", "ns each", "growth", "products", "Fx N", "Fy N", "share");
  bool converged = true;
  std::map<std::string, double> reference;
  for (const int n : kGrids) {
    if (n > largest) break;
    for (const bench::SolverTime& t : bench::time_solvers(n, kRepetitions)) {
      if (n == kReferenceGrid) reference[t.problem] = over_n_log_n(t);
      std::optional<double> growth;
      if (reference.contains(t.problem)) growth = over_n_log_n(t) / reference[t.problem];
      print(t, growth);
      converged = converged && t.converged;
      json["times"].push_back({{"problem", t.problem},
                               {"n", t.n},
                               {"contact_elements", t.elements},
                               {"cpu_s", t.time.cpu},
                               {"wall_s", t.time.wall},
                               {"iterations", t.iterations},
                               {"ns_per_element_and_iteration", t.nanoseconds_each()},
                               {"force_x", t.force_x},
                               {"force_y", t.force_y},
                               {"saturation", t.saturation},
                               {"converged", t.converged}});
      if (growth) json["times"].back()["growth"] = *growth;
      if (t.products > 0.0) json["times"].back()["products"] = t.products;
    }
  }
  return converged;
}

int run(const Options& options) {
  const ThreadLimit one(1);
  nlohmann::json json;
  if (!print_checks(json)) {
    std::fputs("bench_solvers: answers disagree, nothing is measured\n", stderr);
    return 1;
  }
  const bool converged = print_times(options.largest, json);
  if (!options.json.empty()) {
    std::ofstream file(options.json);
    file << json.dump(1) << '\n';
    if (!file.flush()) {
      std::fprintf(stderr, "bench_solvers: cannot write %s\n", options.json.c_str());
      return 1;
    }
  }
  if (!converged) std::fputs("bench_solvers: not every problem was solved to its accuracy\n", stderr);
  return converged ? 0 : 1;
}

}  // namespace

int main(int argc, char** argv) {
  const std::optional<Options> options = parse(argc, argv);
  if (!options) return std::fputs(kUsage, stderr), 2;
  try {
    return run(*options);
  } catch (const std::exception& e) {
    std::fprintf(stderr, "bench_solvers: %s\n", e.what());
    return 1;
  }
}

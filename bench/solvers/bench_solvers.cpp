// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
// How the time of normal and tangential problem grows with the number of elements, on one thread, and what more threads
// bring.
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

constexpr int kGrids[] = {70, 142, 281, 557, 785, 1241};
constexpr int kReferenceGrid = 142;  ///< growth is relative to it: smaller problems live in the cache
constexpr int kRepetitions = 3;
constexpr const char* kUsage =
    "usage: bench_solvers [--largest N] [--threads N] [--json FILE]\n"
    "       --largest N   grids of at most N x N elements (70, 142, 281, 557, 785, 1241)\n"
    "       --threads N   instead: the largest grid on one thread and on N, in turns\n"
    "       --json FILE   writes checks and times there, too\n";

struct Options {
  int largest = 785, threads = 0;
  std::string json;
};

std::optional<Options> parse(int argc, char** argv) {
  Options out;
  for (int i = 1; i < argc; i += 2) {
    const std::string_view name = argv[i];
    if (i + 1 == argc) return std::nullopt;
    if (name == "--json") {
      out.json = argv[i + 1];
    } else if (name == "--largest" || name == "--threads") {
      const bool threads = name == "--threads";
      char* end = nullptr;
      const long n = std::strtol(argv[i + 1], &end, 10);
      if (*end != '\0' || n < (threads ? 2 : kGrids[0]) || n > 100000) return std::nullopt;
      (threads ? out.threads : out.largest) = static_cast<int>(n);
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

/// Whether all answers are the same on any number of threads.
bool print_gains(int largest, int threads, nlohmann::json& json) {
  constexpr int kPairs = 7;
  int n = kGrids[0];
  for (const int grid : kGrids)
    if (grid <= largest) n = grid;
  std::printf("\n%-24s %8s %12s %12s %6s\n", "problem", "contact", "1 thread s",
              (std::to_string(threads) + " s").c_str(), "gain");
  bool equal = true;
  for (const bench::ThreadGain& g : bench::gain_by_threads(n, threads, kPairs)) {
    equal = equal && g.equal;
    if (!g.equal) {
      std::printf("%-24s WRONG: the answer depends on the number of threads\n", g.problem.c_str());
      continue;
    }
    std::printf("%-24s %8d %12.4f %12.4f %6.2f\n", g.problem.c_str(), g.elements, g.one, g.several, g.one / g.several);
    json["threads"].push_back({{"problem", g.problem},
                               {"contact_elements", g.elements},
                               {"threads", threads},
                               {"wall_one_s", g.one},
                               {"wall_s", g.several}});
  }
  return equal;
}

int run(const Options& options) {
  nlohmann::json json;
  bool converged = true;
  {
    const ThreadLimit one(1);
    if (!print_checks(json)) {
      std::fputs("bench_solvers: answers disagree, nothing is measured\n", stderr);
      return 1;
    }
    if (options.threads == 0) converged = print_times(options.largest, json);
  }
  if (options.threads > 0 && !print_gains(options.largest, options.threads, json)) {
    std::fputs("bench_solvers: answers depend on the number of threads\n", stderr);
    return 1;
  }
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

// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
// The same instants by wheelrail::Pair and by the C interface, in turns: what a call costs more, whether memory grows,
// and how two threads with a pair each scale. Nothing is timed unless both give the same bits; memory that grows ends
// with status 1.
// usage: bench_c_interface [--calls N]
#include <unistd.h>

#include <algorithm>
#include <chrono>
#include <cstdio>
#include <cstdlib>
#include <ctime>
#include <fstream>
#include <limits>
#include <string>
#include <string_view>
#include <thread>
#include <vector>

#include "treadmark.h"
#include "treadmark/app/cases/wheelrail_case.hpp"
#include "treadmark/app/surfaces/surface_store.hpp"
#include "treadmark/io/cases/read_toml.hpp"
#include "treadmark/solvers/wheelrail/pair.hpp"

namespace {

using namespace treadmark;

/// Coarse, so that the interface is not lost in the noise of the solver.
const std::string kText =
    "rail.shape.standard = \"60E1\"\nwheel.shape.standard = \"S1002\"\n"
    "[case]\nregime = \"steady\"\n[track]\ngauge_mm = 1435.0\ncant = \"1:40\"\n"
    "[wheelset]\nnominal_radius_mm = 460\nz_mm = 0.2\nvelocity_m_s = 20\nvpitch_rad_s = -43.5\n"
    "[solver]\ntangential_model = \"fastsim\"\n"
    "[friction]\ncoefficient = 0.3\n[discretisation]\ndx_mm = 2.0\nds_mm = 2.0\n";

void require(tm_status status) {
  if (status <= TM_FAILED) return;
  std::fprintf(stderr, "bench_c_interface: %s\n", tm_message());
  std::exit(1);
}

double position(long i) { return 1e-5 * static_cast<double>(i % 400); }

class ByC {
 public:
  ByC() {
    require(tm_case_parse(kText.data(), kText.size(), nullptr, 1, &case_));
    require(tm_pair_of_case(case_, &pair_));
    require(tm_case_find_number("wheelset.y", &y_));
  }
  ~ByC() {
    tm_pair_free(pair_);
    tm_case_free(case_);
  }
  ByC(const ByC&) = delete;
  ByC& operator=(const ByC&) = delete;

  void set(long i) { require(tm_case_set_number_by_id(case_, y_, position(i))); }
  tm_solution* solve() {
    tm_solution* solution = nullptr;
    require(tm_pair_solve(pair_, case_, &solution));
    return solution;
  }

 private:
  tm_case* case_ = nullptr;
  tm_pair* pair_ = nullptr;
  int y_ = 0;
};

class ByCpp {
 public:
  ByCpp() : given_(io::parse_case_text(kText, "text").cases.front()), pair_(geometry()) {
    problem_ = app::to_problem(std::get<io::WheelRailCase>(given_.content), true);
  }
  wheelrail::PairSolution solve(long i) {
    problem_.state.position.y = position(i);
    return pair_.solve(problem_);
  }

 private:
  wheelrail::Geometry geometry() const {
    const auto& c = std::get<io::WheelRailCase>(given_.content);
    app::SurfaceStore store;
    return {store.get(c.rail, Body::rail, 0.0, {}).represented.surface,
            store.get(c.wheel, Body::wheel, c.wheelset.nominal_radius, {}).represented.surface, true, true};
  }
  io::Case given_;
  wheelrail::Pair pair_;
  wheelrail::Problem problem_;
};

bool agree() {
  ByC c;
  ByCpp cpp;
  for (long i = 0; i < 40; ++i) {
    c.set(10 * i);
    tm_solution* solution = c.solve();
    const wheelrail::PairSolution expected = cpp.solve(10 * i);
    double fz = 0.0;
    require(tm_solution_number(solution, "force_on_rail.fz_tr", &fz));
    const bool same = expected.status == Status::ok && fz == expected.load.track.force.z() && fz > 0.0 &&
                      tm_solution_patches(solution) == expected.patches.size();
    tm_solution_free(solution);
    if (!same) return false;
  }
  return true;
}

/// Processor time of this thread [us].
double now() {
  timespec t{};
  clock_gettime(CLOCK_THREAD_CPUTIME_ID, &t);
  return 1e6 * static_cast<double>(t.tv_sec) + 1e-3 * static_cast<double>(t.tv_nsec);
}

template <class Work>
double timed(Work&& work) {
  const double start = now();
  work();
  return now() - start;
}

double median(std::vector<double>& values) {
  const auto middle = values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2);
  std::nth_element(values.begin(), middle, values.end());
  return *middle;
}

void time_calls(long calls) {
  ByC c;
  ByCpp cpp;
  std::vector<double> by_cpp, by_c, difference, set, numbers;
  for (long i = 0; i < calls; ++i) {
    tm_solution* solution = nullptr;
    set.push_back(timed([&] { c.set(i); }));
    const auto solve_cpp = [&] { by_cpp.push_back(timed([&] { cpp.solve(i); })); };
    if (i % 2 == 0) solve_cpp();
    by_c.push_back(timed([&] {
      solution = c.solve();
      tm_solution_free(i % 4 < 2 ? solution : nullptr);
    }));
    if (i % 2 != 0) solve_cpp();
    difference.push_back(by_c.back() - by_cpp.back());
    if (i % 4 < 2) continue;
    double fz = 0.0;
    numbers.push_back(timed([&] { require(tm_solution_number(solution, "force_on_rail.fz_tr", &fz)); }));
    tm_solution_free(solution);
  }
  std::printf("a solution in C++            %8.2f us\n", median(by_cpp));
  std::printf("the same by tm_pair_solve    %8.2f us\n", median(by_c));
  std::printf("difference                   %8.2f us\n", median(difference));
  std::printf("tm_case_set_number_by_id     %8.3f us\n", median(set));
  std::printf("first tm_solution_number     %8.2f us\n", median(numbers));
}

double resident_mib() {
  std::ifstream statm("/proc/self/statm");
  long total = 0, resident = 0;
  statm >> total >> resident;
  return static_cast<double>(resident) * static_cast<double>(sysconf(_SC_PAGESIZE)) / (1024.0 * 1024.0);
}

/// All that a host does, again and again; false: memory grew.
bool endure(long calls) {
  const long first = std::max(200l, calls / 10);
  ByC c;
  double before = 0.0;
  for (long i = 0; i < first + calls; ++i) {
    if (i == first) before = resident_mib();
    c.set(i);
    tm_solution* solution = c.solve();
    double value = 0.0;
    const double* field = nullptr;
    require(tm_solution_number(solution, "force_on_rail.fz_tr", &value));
    require(tm_patch_field(solution, 0, "pressure", &field));
    if (tm_solution_number(solution, "nonsense", &value) != TM_BAD_ARGUMENT) return false;
    tm_solution_free(solution);
  }
  const double grown = resident_mib() - before;
  constexpr double kNoise = 4.0;  // of the allocator [MiB]
  std::printf("memory after %ld calls       %+8.2f MiB\n", calls, grown);
  return grown < kNoise;
}

/// What threads with a pair each get done: a second on the wall clock; and what one solution costs in processor time
/// [us], which does not depend on what else the machine does.
struct Done {
  double rate = 0.0, cost = 0.0;
};

Done work_beside_each_other(int threads, long calls) {
  std::vector<std::thread> all;
  timespec begin{};
  clock_gettime(CLOCK_PROCESS_CPUTIME_ID, &begin);
  const auto start = std::chrono::steady_clock::now();
  for (int t = 0; t < threads; ++t)
    all.emplace_back([calls] {
      ByC c;
      for (long i = 0; i < calls; ++i) {
        c.set(i);
        tm_solution_free(c.solve());
      }
    });
  for (std::thread& thread : all) thread.join();
  const double seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
  timespec end{};
  clock_gettime(CLOCK_PROCESS_CPUTIME_ID, &end);
  const double all_calls = threads * static_cast<double>(calls);
  const double spent =
      static_cast<double>(end.tv_sec - begin.tv_sec) + 1e-9 * static_cast<double>(end.tv_nsec - begin.tv_nsec);
  return {all_calls / seconds, 1e6 * spent / all_calls};
}

}  // namespace

int main(int argc, char** argv) {
  long calls = 100000;
  for (int i = 1; i < argc; ++i) {
    if (std::string_view(argv[i]) == "--calls" && i + 1 < argc)
      calls = std::atol(argv[++i]);
    else
      return std::fprintf(stderr, "usage: bench_c_interface [--calls N]\n"), 2;
  }
  require(tm_set_threads(1));
  if (!agree()) return std::fprintf(stderr, "bench_c_interface: C and C++ do not give the same bits\n"), 1;
  time_calls(std::clamp(calls, 100l, 20000l));
  const bool steady = endure(calls);
  require(tm_set_threads(0));
  const long some = std::clamp(calls, 100l, 20000l);
  double best = 0.0;
  Done one, two;
  for (int i = 0; i < 3; ++i) {
    one = work_beside_each_other(1, some);
    two = work_beside_each_other(2, some);
    best = std::max(best, two.rate / one.rate);
  }
  std::printf("two threads over one         %8.2f\n", best);
  std::printf("processor time of a solution %8.2f us alone, %.2f us beside another thread\n", one.cost, two.cost);
  if (!steady) return std::fprintf(stderr, "bench_c_interface: memory grew\n"), 1;
  return 0;
}

// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
// parallel_for that does a loop's tasks one after the other and measures each, so that one thread tells what many would
// do: the program linked with it behaves as with --threads N and ends by writing to the file named in TREADMARK_STRANDS
// what scripts/scaling-model.py reads. Work is the processor time of all, span that of the longest chain of parts which
// cannot be done beside each other.
#include "treadmark/bench/scaling/measured_loops.hpp"

#include <time.h>

#include <algorithm>
#include <cstdio>
#include <cstdlib>
#include <mutex>
#include <set>
#include <thread>

#include "treadmark/core/cancellation.hpp"
#include "treadmark/core/parallel.hpp"

namespace treadmark {
namespace {

using bench::Strand;

double clock_now() {
  timespec t{};
  ::clock_gettime(CLOCK_THREAD_CPUTIME_ID, &t);
  return static_cast<double>(t.tv_sec) + 1e-9 * static_cast<double>(t.tv_nsec);
}

double clock_cost() {
  double least = 1.0;
  for (int i = 0; i < 1000; ++i) {
    const double before = clock_now();
    least = std::min(least, clock_now() - before);
  }
  return least;
}

/// Of the thread that runs main().
class Measured {
 public:
  Measured() : cost_(clock_cost()) {}
  ~Measured() {
    const char* file = std::getenv("TREADMARK_STRANDS");
    if (!file) return;
    so_far();
    if (std::FILE* out = std::fopen(file, "w")) {
      std::fprintf(out, "{\"work_s\": %.9g, \"span_s\": %.9g, \"in_tasks_s\": %.9g, \"loops\": %ld, \"tasks\": %ld}\n",
                   now_.work, now_.span, now_.in_tasks, now_.loops, tasks_);
      std::fclose(out);
    }
  }

  const Strand& so_far() {
    read_clock();
    return now_;
  }

  void loop(std::size_t count, const std::function<void(std::size_t)>& body) {
    read_clock();
    Strand outer = now_, longest;
    const auto leave = [&] {
      now_ = outer;
      now_.span += longest.span;
      now_.in_tasks += longest.span;
      now_.loops += 1 + longest.loops;
    };
    try {
      for (std::size_t i = 0; i < count; ++i) {
        now_ = {};
        ++tasks_;
        check_cancelled();
        body(i);
        read_clock();
        outer.work += now_.work;
        if (now_.span > longest.span) longest = now_;
      }
    } catch (...) {
      leave();
      throw;
    }
    leave();
  }

 private:
  void read_clock() {
    const double now = clock_now(), passed = std::max(0.0, now - since_ - cost_);
    now_.work += passed;
    now_.span += passed;
    since_ = now;
  }

  double cost_, since_ = 0.0;  ///< since the thread began: loading counts
  Strand now_;
  long tasks_ = 0;
};

const std::thread::id main_thread = std::this_thread::get_id();
Measured measured;

std::mutex limits_mutex;
std::multiset<int> limits;

}  // namespace

Strand bench::measured_so_far() { return measured.so_far(); }

ThreadLimit::ThreadLimit(int threads) {
  const std::scoped_lock lock(limits_mutex);
  const int all = static_cast<int>(std::thread::hardware_concurrency());
  control_ = new std::multiset<int>::iterator(limits.insert(threads > 0 ? threads : all));
}

ThreadLimit::~ThreadLimit() {
  const std::scoped_lock lock(limits_mutex);
  auto* own = static_cast<std::multiset<int>::iterator*>(control_);
  limits.erase(*own);
  delete own;
}

int thread_count() {
  const std::scoped_lock lock(limits_mutex);
  return limits.empty() ? 1 : *limits.begin();
}

void parallel_for(std::size_t count, const std::function<void(std::size_t)>& body) {
  if (count > 1 && thread_count() > 1 && std::this_thread::get_id() == main_thread) return measured.loop(count, body);
  for (std::size_t i = 0; i < count; ++i) {
    check_cancelled();
    body(i);
  }
}

}  // namespace treadmark

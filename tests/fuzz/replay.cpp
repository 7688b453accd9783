// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
// The targets without libFuzzer: replays what the corpus holds of each, then feeds mutants of it for some time. Which
// of them go deep it does not know; that is what scripts/fuzz.sh is for. A find ends the program and is left in the
// current folder as crash-<target>.
#include <sys/resource.h>
#include <unistd.h>

#include <algorithm>
#include <chrono>
#include <csignal>
#include <cstdio>
#include <cstdlib>
#include <exception>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <random>
#include <string>
#include <vector>

#include "treadmark/tests/fuzz/fuzz_target.hpp"
#include "treadmark/tests/support/mutation.hpp"

/// Of the runtime of a sanitizer, where there is one: what to do before it ends the program.
extern "C" void __sanitizer_set_death_callback(void (*callback)()) __attribute__((weak));

namespace {

namespace fs = std::filesystem;
using Clock = std::chrono::steady_clock;
using treadmark::fuzz::Target;

constexpr double kLongest = 10.0;              // of one input [s]
constexpr unsigned kHanging = 60;              // after which it is stopped [s]
constexpr rlim_t kMostFile = rlim_t{1} << 28;  // that a reader may write [byte]

std::string input, file_of_find;

void keep_input() { std::ofstream(file_of_find, std::ios::binary) << input; }

void keep_and_leave(int signal) {
  keep_input();
  std::fprintf(stderr, "fuzz_replay: signal %d, the input is in %s\n", signal, file_of_find.c_str());
  std::_Exit(1);
}

/// Whether it was answered in time.
bool feed(const Target& target, std::string bytes) {
  input = std::move(bytes);
  const auto start = Clock::now();
  alarm(kHanging);
  target.run(reinterpret_cast<const std::uint8_t*>(input.data()), input.size());
  alarm(0);
  const double took = std::chrono::duration<double>(Clock::now() - start).count();
  if (took <= kLongest) return true;
  keep_input();
  std::fprintf(stderr, "fuzz_replay: %.1f s, the input is in %s\n", took, file_of_find.c_str());
  return false;
}

std::vector<std::string> contents(const fs::path& folder) {
  std::vector<fs::path> files;
  if (fs::is_directory(folder))
    for (const auto& entry : fs::directory_iterator(folder)) files.push_back(entry.path());
  std::sort(files.begin(), files.end());
  std::vector<std::string> texts;
  for (const fs::path& file : files) {
    std::ifstream in(file, std::ios::binary);
    texts.emplace_back(std::istreambuf_iterator<char>(in), std::istreambuf_iterator<char>());
  }
  return texts;
}

/// Replays and mutates one target; false: a find.
bool campaign(const Target& target, const fs::path& corpus, double seconds, std::mt19937& random) {
  file_of_find = std::string("crash-") + target.name;
  std::vector<std::string> seeds = contents(corpus / target.name);
  bool sound = feed(target, "");
  for (const std::string& seed : seeds) sound = feed(target, seed) && sound;
  if (seeds.empty()) seeds.emplace_back("\n");
  long mutants = 0;
  const auto end = Clock::now() + std::chrono::duration<double>(seconds);
  for (; sound && Clock::now() < end; ++mutants) {
    const std::string& seed = seeds[random() % seeds.size()];
    using namespace treadmark::testing;
    sound = feed(target, random() % 3 == 0   ? with_other_numbers(seed, random)
                         : random() % 3 == 0 ? with_other_lines(seed, random)
                                             : with_other_bytes(seed, random));
  }
  std::printf("%-24s %5zu of the corpus, %8ld mutants\n", target.name, seeds.size(), mutants);
  std::fflush(stdout);
  return sound;
}

}  // namespace

int main(int argc, char** argv) {
  double seconds = 0.0;
  fs::path corpus = fs::path(TREADMARK_SOURCE_DIR) / "tests" / "fuzz" / "corpus";
  unsigned seed = std::random_device()();
  std::vector<std::string> wanted;
  for (int i = 1; i < argc; ++i) {
    const std::string word = argv[i];
    if (word == "--seconds" && i + 1 < argc)
      seconds = std::atof(argv[++i]);
    else if (word == "--corpus" && i + 1 < argc)
      corpus = argv[++i];
    else if (word == "--seed" && i + 1 < argc)
      seed = static_cast<unsigned>(std::atol(argv[++i]));
    else if (word.starts_with("-"))
      return std::fprintf(stderr, "usage: fuzz_replay [--seconds S of all] [--corpus DIR] [--seed N] [TARGET...]\n"), 2;
    else
      wanted.push_back(word);
  }
  if (__sanitizer_set_death_callback != nullptr) __sanitizer_set_death_callback(keep_input);
  for (const int signal : {SIGABRT, SIGALRM}) std::signal(signal, keep_and_leave);
  const rlimit most{kMostFile, kMostFile};
  setrlimit(RLIMIT_FSIZE, &most);

  std::vector<Target> chosen;
  for (const Target& target : treadmark::fuzz::targets())
    if (wanted.empty() || std::find(wanted.begin(), wanted.end(), target.name) != wanted.end())
      chosen.push_back(target);
  if (chosen.empty()) return std::fprintf(stderr, "fuzz_replay: no such target\n"), 2;
  std::sort(chosen.begin(), chosen.end(),
            [](const Target& a, const Target& b) { return std::string(a.name) < b.name; });
  std::printf("seed %u\n", seed);
  std::mt19937 random(seed);
  bool sound = true;
  for (const Target& target : chosen) {
    try {
      sound = campaign(target, corpus, seconds / static_cast<double>(chosen.size()), random) && sound;
    } catch (const std::exception& error) {
      keep_input();
      std::fprintf(stderr, "fuzz_replay: %s: %s, the input is in %s\n", target.name, error.what(),
                   file_of_find.c_str());
      sound = false;
    }
  }
  return sound ? 0 : 1;
}

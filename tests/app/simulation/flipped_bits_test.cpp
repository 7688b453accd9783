// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors

// One bit flips in a binary file that the program wrote and reads again: an error, or the same content.
// TREADMARK_MUTANTS: how many bits of each file, TREADMARK_SEED: which.
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <signal.h>

#include <chrono>
#include <cstdlib>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <functional>
#include <map>
#include <random>
#include <set>
#include <span>
#include <string>
#include <thread>
#include <vector>

#include <fmt/format.h>

#include "treadmark/backends/analytic/make.hpp"
#include "treadmark/backends/offset/make.hpp"
#include "treadmark/core/byte_archive.hpp"
#include "treadmark/core/platform/ranges.hpp"
#include "treadmark/io/files/content_cache.hpp"
#include "treadmark/io/hdf5/hdf5_reader.hpp"
#include "treadmark/io/meshes/read_mesh.hpp"
#include "treadmark/io/profiles/read_slices.hpp"
#include "treadmark/solvers/wheelrail/pair_state.hpp"
#include "treadmark/tests/app/running_program.hpp"
#include "treadmark/tests/app/simulation/sample_simulation.hpp"
#include "treadmark/tests/app/standard_case.hpp"
#include "treadmark/tests/solvers/wheelrail/standard_pair.hpp"
#include "treadmark/tests/support/file_content.hpp"
#include "treadmark/tests/support/mutation.hpp"
#include "treadmark/tests/support/parts.hpp"

namespace treadmark::testing {
namespace {

namespace fs = std::filesystem;

constexpr int kUsual = 60;

std::mt19937& random_bits() {
  const char* seed = std::getenv("TREADMARK_SEED");
  static std::mt19937 random(seed != nullptr ? static_cast<unsigned>(std::atol(seed)) : 1u);
  return random;
}

enum class Answer { refused, same, other };

using Places = std::function<bool(std::size_t)>;

/// Flips bits of bytes one at a time; answer: how what holds them is taken. All are refused but those at places without
/// content, which are told to be the same.
void flip(const std::string& name, const std::string& bytes, const Places& without_content,
          const std::function<Answer()>& answer, const std::function<void(std::size_t, char)>& put) {
  ASSERT_FALSE(bytes.empty()) << name;
  ASSERT_EQ(answer(), Answer::same) << name;
  int refused = 0;
  const int count = mutants(kUsual);
  for (int k = 0; k < count; ++k) {
    const std::size_t at = random_bits()() % bytes.size(), bit = random_bits()() % 8;
    put(at, static_cast<char>(bytes[at] ^ 1 << bit));
    const Answer given = answer();
    put(at, bytes[at]);
    refused += given == Answer::refused;
    EXPECT_TRUE(given == Answer::refused || (given == Answer::same && without_content(at)))
        << name << ": bit " << bit << " of byte " << at << " of " << bytes.size() << " is silent";
  }
  fmt::print("{}: {} bits flipped, {} refused\n", name, count, refused);
}

void flip_in_file(const fs::path& file, const Places& without_content, const std::function<Answer()>& answer) {
  flip(file.filename().string(), content_of(file), without_content, answer, [&](std::size_t at, char byte) {
    std::fstream out(file, std::ios::in | std::ios::out | std::ios::binary);
    out.seekp(static_cast<std::streamoff>(at)).put(byte);
  });
}

bool no_place(std::size_t) { return false; }

Answer answer_of(const std::function<void()>& read) {
  try {
    read();
    return Answer::same;
  } catch (const Error& error) {
    EXPECT_EQ(error.kind(), ErrorKind::input_data) << error.what();
    return Answer::refused;
  }
}

/// What the verbs write into a folder.
class FlippedBits : public ::testing::Test {
 protected:
  void run(std::vector<std::string> words) const {
    words.insert(words.begin(), {"treadmark", "--quiet"});
    const ProgramResult r = RunningProgram(words).wait();
    ASSERT_LE(r.status, 1) << ::testing::PrintToString(words) << r.err;  // 1: with a warning
  }
  void stop_at_a_checkpoint() const {
    input_.edit("simulation.toml", "distance_m = 0.06", "distance_m = 5");
    const fs::path kept = input_.path("stopped/unfinished.h5");
    RunningProgram program(
        {"treadmark", "--quiet", "simulate", input_.path("simulation.toml"), "-o", input_.path("stopped")});
    while (program.running() && !fs::exists(kept)) std::this_thread::sleep_for(std::chrono::milliseconds(5));
    program.send(SIGINT);
    program.wait();
    ASSERT_TRUE(fs::exists(kept));
  }
  SampleSimulation input_;
};

TEST_F(FlippedBits, OfFilesAreRefused) {
  TREADMARK_NEEDS("openvdb");
  TREADMARK_NEEDS("nanovdb");
  input_.write("case.toml", standard_case("1.0"));
  input_.edit("study.toml", "values = [0.5, 0.9]", "values = [0.5]");
  input_.write("evolve.toml",
               "[evolve]\nbase = \"case.toml\"\ndistance_km = 100\nupdates = 1\n[evolve.wheel]\n[evolve.wheel.law]\n"
               "theory = \"archard\"\nsource = \"assumed\"\nhardness_GPa = 3.0\nk = [1e-4]\n");
  const auto path = [&](const char* name) { return input_.path(name); };
  run({"run", path("case.toml"), "-o", path("run")});
  run({"compare", path("case.toml"), "--resolutions", "8", "--bodies", "rail", "--backends", "spline", "-o",
       path("compare")});
  run({"simulate", path("simulation.toml"), "-o", path("simulate")});
  run({"sweep", path("study.toml"), "-o", path("sweep")});
  run({"evolve", path("evolve.toml"), "-o", path("evolve")});
  run({"measure", "wheel", "S1002", "1:40", "--hdf5", path("list.h5")});
  for (const char* name : {"rail.vdb", "rail.nvdb", "rail.ply", "rail.stl", "rail.slcs"})
    run({"convert", path("rail.prr"), path(name), "--resolution", "8", "--range-mm=-24,24"});
  stop_at_a_checkpoint();

  // Before the end stand the name of the check sum and the sum: without the name nothing is checked.
  constexpr std::size_t kSum = 24;
  const auto mesh = [](const fs::path& file) { io::read_mesh(file); };
  const std::map<std::string, std::function<void(const fs::path&)>> read{
      {".h5", [](const fs::path& file) { const io::Hdf5Reader opened(file); }},
      {".vdb", [](const fs::path& file) { offset::read_vdb(file); }},
      {".nvdb", [](const fs::path& file) { offset::read_vdb(file); }},
      {".ply", mesh},
      {".stl", mesh},
  };
  std::set<std::string> seen;
  for (const auto& entry : fs::recursive_directory_iterator(input_.folder())) {
    const fs::path& file = entry.path();
    if (!entry.is_regular_file()) continue;
    const std::string bytes = content_of(file);
    if (bytes.find('\0') == std::string::npos) continue;
    ASSERT_TRUE(read.contains(file.extension().string())) << file << " is a binary file that nothing here reads";
    const auto& reader = read.at(file.extension().string());
    seen.insert(file.filename().string());
    const bool foreign = file.extension() == ".ply" || file.extension() == ".stl";  // have no sum: only read or refused
    flip_in_file(
        file, [&](std::size_t at) { return foreign || at + kSum >= bytes.size(); },
        [&] { return answer_of([&] { reader(file); }); });
  }
  EXPECT_THAT(seen, ::testing::IsSupersetOf({"fields.h5", "simulation.h5", "sweep.h5", "unfinished.h5", "list.h5",
                                             "rail.vdb", "rail.nvdb", "rail.ply", "rail.stl"}));

  const fs::path index = path("rail.slcs");
  fs::path slice;
  for (const auto& entry : fs::recursive_directory_iterator(input_.folder()))
    if (entry.path().parent_path().filename().string().starts_with("rail.slcs-")) slice = entry.path();
  ASSERT_FALSE(slice.empty());
  const auto read_all = [&] { return answer_of([&] { io::read_slices(index, Body::rail, {}); }); };
  flip_in_file(slice, no_place, read_all);
  const std::size_t sum = content_of(index).find(": ", content_of(index).find("SHA-256"));
  flip_in_file(
      index, [&](std::size_t at) { return at < sum + 2; }, read_all);
}

TEST_F(FlippedBits, OfTablesThatAreKeptAreAsIfThereWereNone) {
  const io::ContentCache cache(input_.folder() / "cache");
  const std::string key = "what decides it", text(5000, 'x');
  const auto content = std::as_bytes(std::span(text));
  cache.keep(key, content);
  flip_in_file(cache.file_of(key), no_place, [&] {
    const auto found = cache.find(key);
    if (!found) return Answer::refused;
    return ranges::equal(*found, content) ? Answer::same : Answer::other;
  });
}

TEST(FlippedBitsOfStates, AreRefused) {
  wheelrail::Pair pair(wheelrail::standard_geometry());
  ASSERT_EQ(pair.solve(wheelrail::standard_problem()).status, Status::ok);
  ByteWriter saved;
  wheelrail::write(pair.save(), saved);
  std::vector<std::byte> bytes = saved.bytes();
  flip(
      "state of a pair", std::string(reinterpret_cast<const char*>(bytes.data()), bytes.size()), no_place,
      [&] {
        return answer_of([&] {
          ByteReader in(bytes);
          wheelrail::read_state(in);
          if (!in.at_end()) refuse_saved_state("it goes on");
        });
      },
      [&](std::size_t at, char byte) { bytes[at] = static_cast<std::byte>(byte); });
}

}  // namespace
}  // namespace treadmark::testing

// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#include "treadmark/tests/faults/output_rows.hpp"

#include <gtest/gtest.h>

#include <sstream>

#include "treadmark/core/parts.hpp"
#include "treadmark/tests/app/program.hpp"
#include "treadmark/tests/app/standard_case.hpp"

namespace treadmark::testing {
namespace {

const char* kShortStudy = R"([study]
title = "Two speeds"
base = "short.toml"

[[study.vary]]
key = "simulation.speed_m_s"
label = "speed [m/s]"
values = [20, 40]

[[study.figures]]
file = "force-by-speed.svg"
kind = "summary"
x = "simulation.speed_m_s"
y = ["q_max_N"]
)";

const char* kShortEvolution = R"([evolve]
base = "case.toml"
distance_km = 100
updates = 1

[evolve.wheel]

[evolve.wheel.law]
theory = "archard"
source = "assumed"
hardness_GPa = 3.0
k = [1e-4]

[evolve.wheel.fatigue]
measures = ["fi_surf", "subsurface"]
source = "assumed"
shear_yield_MPa = 300
depths_mm = [3]
)";

#define RESULTS "run $case.toml -o $first;run $case.toml -o $second --set wheelset.vertical_force_N=70e3"
#define SCANS "scan $case.toml -o $scan.ply --body rail --range-mm -40 60 --points 4000"
#define RAIL "--resolution 8 --range-mm=-16,16"
#define OTHER_RAIL "--resolution 8 --range-mm=-24,24"
#define WHEEL "--body wheel --nominal-radius 460 --resolution 8 --range-deg=-1,1"
#define OTHER_WHEEL "--body wheel --nominal-radius 460 --resolution 8 --range-deg=-2,2"
#define COMPARE "compare $case.toml --resolutions 8 --bodies rail --backends spline"
#define BENCH "bench $case.toml --resolutions 4 --backends spline --seconds-per-measure 0.0001"
#define PAIR "geometry --wheel S1002 --rail 60E1 --cant 1:40 --amplitudes-mm 3 --step-mm 0.5"
#define TRACK \
  "track " TREADMARK_SOURCE_DIR "/examples/tracks/gm-tt0088.toml -o @track --json @t.json --receptance @t.csv"
#define STABILITY                                            \
  "stability " TREADMARK_SOURCE_DIR                          \
  "/examples/flat-at-speed.toml --set simulation.wheels=[] " \
  "--set simulation.vehicle=vehicles/single-wheelset.toml --from 20 --count 2"
#define RESPONSE                                             \
  "response " TREADMARK_SOURCE_DIR                           \
  "/examples/flat-at-speed.toml --set simulation.wheels=[] " \
  "--set simulation.vehicle=vehicles/single-wheelset.toml"
#define TABLE                                                                            \
  "table $case.toml --lateral-range-mm 1 --step-mm 1 --element-mm 2 --roll-intervals 0 " \
  "--yaw-intervals 0 --creep-forces linear --check-points 1"
#define LESS " --set wheelset.vertical_force_N=70e3"

const std::vector<OutputRow> kRows{
    {"run", "", "", "run $case.toml -o @run --json @run.json", "run $case.toml -o @run --json @run.json" LESS, 2},
    {"run_json", "", "", "run $case.toml --json @run.json", "run $case.toml --json @run.json" LESS, 3},
    {"run_report", "report hdf5", "", "run $case.toml --report @run.html", "run $case.toml --report @run.html" LESS, 3},
    {"compare", "", "", COMPARE " -o @compare --json @compare.json", COMPARE " -o @compare --json @compare.json" LESS,
     0},
    {"bench", "", "", BENCH " -o @bench --json @bench.json", nullptr, 0},
    {"convert_slcs", "", "", "convert $rail.prr @rail.slcs " RAIL, "convert $rail.prr @rail.slcs " OTHER_RAIL, 4},
    {"convert_slcw", "", "", "convert $wheel.txt @wheel.slcw " WHEEL, "convert $wheel.txt @wheel.slcw " OTHER_WHEEL, 1},
    {"convert_ply", "", "", "convert $rail.prr @rail.ply " RAIL, "convert $rail.prr @rail.ply " OTHER_RAIL, 3},
    {"convert_stl", "", "", "convert $rail.prr @rail.stl " RAIL, "convert $rail.prr @rail.stl " OTHER_RAIL, 3},
    {"convert_obj", "", "", "convert $rail.prr @rail.obj " RAIL, "convert $rail.prr @rail.obj " OTHER_RAIL, 3},
    {"convert_off", "", "", "convert $rail.prr @rail.off " RAIL, "convert $rail.prr @rail.off " OTHER_RAIL, 3},
    {"convert_vdb", "openvdb", "", "convert $rail.prr @rail.vdb " RAIL, "convert $rail.prr @rail.vdb " OTHER_RAIL, 1},
    {"convert_nvdb", "nanovdb", "", "convert $rail.prr @rail.nvdb " RAIL, "convert $rail.prr @rail.nvdb " OTHER_RAIL,
     1},
    {"convert_prr", "", "", "convert $rail.prr @rail.prr", "convert $rail.prr @rail.prr --smooth 100", 3},
    {"convert_prw", "", "", "convert $wheel.txt @wheel.prw --body wheel",
     "convert $wheel.txt @wheel.prw --body wheel --smooth 100", 3},
    {"convert_csv", "", "", "convert $rail.prr @rail.csv", "convert $rail.prr @rail.csv --derivatives", 3},
    {"convert_toml", "", "", "convert $case.toml @case.toml", "convert $case.toml @case.toml" LESS, 3},
    {"convert_inp", "", "", "convert $case.inp @case.inp", "convert $case.inp @case.inp --set wheelset.y_mm=1", 3},
    {"scan", "scans", "", "scan $rail.prr -o @scan.xyz --range-mm -20 20 --points 300 --truth @truth.json",
     "scan $rail.prr -o @scan.xyz --range-mm -20 20 --points 200 --truth @truth.json", 0},
    {"scan_las", "scans", "", "scan $rail.prr -o @scan.las --range-mm -20 20 --points 300",
     "scan $rail.prr -o @scan.las --range-mm -20 20 --points 200", 0},
    {"import", "scans", SCANS,
     "import $scan.ply -o @rail.slcs --body rail --resolution 4 --set fit.written_um=500 --json @audit.json",
     "import $scan.ply -o @rail.slcs --body rail --resolution 5 --set fit.written_um=500 --json @audit.json", 0},
    {"import_report", "scans cgal report hdf5", SCANS,
     "import $scan.ply -o @rail.ply --body rail --resolution 4 --set fit.written_um=500 --report @audit", nullptr, 0},
    {"geometry", "report", "",
     PAIR " --gauge-mm 1435 -o @geometry --json @pair.json --csv @pair.csv --report @pair.html",
     PAIR " --gauge-mm 1437 -o @geometry --json @pair.json --csv @pair.csv --report @pair.html", 0},
    {"measure", "report hdf5", "", "measure wheel S1002 --json @wheel.json --csv @wheel.csv --report @wheel.html",
     "measure wheel S1002 --json @wheel.json --csv @wheel.csv --report @wheel.html --nominal S1002", 0},
    {"measure_list", "report hdf5", "", "measure wheel S1002 1:40 --csv @list.csv --hdf5 @list.h5 --report @list.html",
     "measure wheel S1002 1:40 --csv @list.csv --hdf5 @list.h5 --report @list.html --nominal S1002", 0},
    {"fmu", "fmu", "", "fmu $case.toml -o @wheel.fmu", nullptr, 0},
    {"report", "report hdf5", RESULTS, "report $first -o @report.html", "report $second -o @report.html", 3},
    {"plot", "report hdf5", RESULTS, "plot $first --what pressure -o @plot.svg",
     "plot $second --what pressure -o @plot.svg", 3},
    {"check", "report", "", "check $case.toml -o @check --report @check.html",
     "check $case.toml -o @check --report @check.html --set wheelset.y_mm=1", 3},
    {"simulate", "vehicle hdf5", "", "simulate $short.toml -o @simulation --json @simulation.json",
     "simulate $short.toml -o @simulation --json @simulation.json --set simulation.speed_m_s=30", 0, true},
    {"assess", "vehicle hdf5", "simulate $simulation.toml -o $simulated",
     "assess $simulated -o @assessed --json @assessed.json --csv @assessed.csv",
     "assess $simulated -o @assessed --json @assessed.json --csv @assessed.csv --vehicle freight", 2},
    {"sweep", "vehicle hdf5", "", "sweep $short-study.toml -o @sweep", nullptr, 0, true},
    {"evolve", "vehicle hdf5 openvdb", "", "evolve $short-evolution.toml -o @evolve --json @evolve.json", nullptr, 0,
     true},
    {"stability", "vehicle", "", STABILITY " --to 30 -o @stability", STABILITY " --to 25 -o @stability", 3},
    {"response", "vehicle", "", RESPONSE " --count 3 -o @response", RESPONSE " --count 4 -o @response", 3},
    {"table", "vehicle", "", TABLE " -o @table.json --json @told.json", nullptr, 0},
    {"track", "vehicle", "", TRACK " --fit 1 --count 20", TRACK " --fit 1 --count 30", 2},
};

std::vector<std::string> split(const std::string& text, char at) {
  std::vector<std::string> parts;
  std::istringstream in(text);
  for (std::string part; std::getline(in, part, at);)
    if (!part.empty()) parts.push_back(part);
  return parts;
}

}  // namespace

std::ostream& operator<<(std::ostream& out, const OutputRow& row) { return out << row.name; }

const std::vector<OutputRow>& output_rows() { return kRows; }

std::string missing_part(const std::string& parts) {
  for (const std::string& part : split(parts, ' '))
    if (!has_part(part)) return part;
  return {};
}

OutputScene::OutputScene() : out_(std::filesystem::canonical(input_.folder()) / "out") {
  std::filesystem::create_directories(out_);
  input_.write("case.toml", standard_case("2.0"));
  input_.write("short.toml", input_.read("simulation.toml"));
  input_.edit("short.toml", "distance_m = 0.06\ncheckpoint_s = 0.02", "distance_m = 0.01\ncheckpoint_s = 0.0002");
  input_.write("short-study.toml", kShortStudy);
  input_.write("short-evolution.toml", kShortEvolution);
}

std::vector<std::string> OutputScene::words(const std::string& command) const {
  std::vector<std::string> out = split(command, ' ');
  for (std::string& word : out)
    if (word.front() == '$')
      word = (input_.folder() / word.substr(1)).string();
    else if (word.front() == '@')
      word = (out_ / word.substr(1)).string();
  return out;
}

void OutputScene::prepare(const OutputRow& row) const {
  for (const std::string& command : split(row.prepare, ';')) {
    const ProgramResult made = run_program(words(command));
    ASSERT_EQ(made.status, 0) << command << ": " << made.err;
  }
}

}  // namespace treadmark::testing

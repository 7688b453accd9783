// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <filesystem>
#include <map>
#include <regex>
#include <sstream>

#include <nlohmann/json.hpp>

#include "treadmark/app/version.hpp"
#include "treadmark/core/platform/ranges.hpp"
#include "treadmark/model/shape/defects.hpp"
#include "treadmark/tests/app/program.hpp"
#include "treadmark/tests/app/running_program.hpp"
#include "treadmark/tests/app/sample_input.hpp"
#include "treadmark/tests/support/parts.hpp"

namespace treadmark::testing {
namespace {

using ::testing::ContainsRegex;
using ::testing::HasSubstr;
using ::testing::Not;

TEST(CommandLine, HelpAndVersion) {
  const ProgramResult help = run_program({"--help"});
  EXPECT_EQ(help.status, 0);
  for (const char* word : {"run", "check", "Exit status"}) EXPECT_THAT(help.out, HasSubstr(word));
  const ProgramResult version = run_program({"--version"});
  EXPECT_EQ(version.status, 0);
  EXPECT_THAT(version.out, HasSubstr("treadmark "));
  EXPECT_THAT(version.out, HasSubstr("binary is"));
}

TEST(CommandLine, VersionForProgramsNamesEveryLibraryThatIsLoaded) {
  const ProgramResult r = run_program({"--version", "--json"});
  ASSERT_EQ(r.status, 0) << r.err;
  const auto version = nlohmann::json::parse(r.out);
  EXPECT_EQ(version.at("parts").at("embree"), has_part("embree"));
  EXPECT_EQ(version.at("licence") == "Apache-2.0", !has_part("fftw") && !has_part("cgal"));
  std::vector<std::string> known{"linux-vdso", "ld-linux", "libc.",    "libm.",  "libgcc_s",
                                 "libstdc++",  "libasan",  "libubsan", "libtsan"};
  for (const app::LinkedLibrary& library : app::linked_libraries()) {
    EXPECT_NE(library.version, "unknown") << library.name;
    EXPECT_FALSE(library.licence.empty()) << library.name;
    if (!library.shared.empty()) known.push_back(library.shared);
  }
  EXPECT_EQ(version.at("libraries").size(), app::linked_libraries().size());
  const ProgramResult needed = RunningProgram({"readelf", "-d", TREADMARK_PROGRAM}).wait();
  ASSERT_EQ(needed.status, 0);
  const std::regex name(R"(\(NEEDED\).*\[(.*)\])");
  int found = 0;
  for (std::sregex_iterator it(needed.out.begin(), needed.out.end(), name), end; it != end; ++it, ++found)
    EXPECT_TRUE(ranges::any_of(known, [&](const std::string& one) { return (*it)[1].str().starts_with(one); }))
        << (*it)[1] << " is loaded, and cmake/TreadmarkDependencies.cmake does not say so";
  EXPECT_GT(found, 3);
}

TEST(CommandLine, LoadsNoLibrariesForNetworksAtItsStart) {
  const ProgramResult loaded = RunningProgram({"ldd", TREADMARK_PROGRAM}).wait();
  ASSERT_EQ(loaded.status, 0);
  EXPECT_THAT(loaded.out, HasSubstr("libstdc++"));
  for (const char* name : {"libhdf5", "libcurl", "libssl"}) EXPECT_THAT(loaded.out, Not(HasSubstr(name)));
}

TEST(CommandLine, BillOfMaterialsHoldsWhatTheVersionForProgramsTells) {
  const auto version = nlohmann::json::parse(run_program({"--version", "--json"}).out);
  const ProgramResult r = run_program({"--version", "--spdx"});
  ASSERT_EQ(r.status, 0) << r.err;
  const auto bill = nlohmann::json::parse(r.out);
  EXPECT_EQ(bill.at("spdxVersion"), "SPDX-2.3");
  EXPECT_TRUE(std::regex_match(bill.at("creationInfo").at("created").get<std::string>(),
                               std::regex(R"(\d{4}-\d\d-\d\dT\d\d:\d\d:\d\dZ)")));
  // By identifier: name, version and licence; each is of one package, and each but the document's is in one relation.
  std::map<std::string, nlohmann::json> packages;
  for (const auto& package : bill.at("packages")) {
    const auto id = package.at("SPDXID").get<std::string>();
    EXPECT_TRUE(std::regex_match(id, std::regex("SPDXRef-[a-zA-Z0-9.-]+"))) << id;
    EXPECT_TRUE(packages.emplace(id, package).second) << id;
    EXPECT_EQ(package.at("filesAnalyzed"), false);
    EXPECT_TRUE(package.contains("downloadLocation"));
  }
  EXPECT_EQ(packages.at("SPDXRef-treadmark").at("licenseConcluded"), version.at("licence"));
  const std::map<std::string, std::string> linked{
      {"shared", "DYNAMIC_LINK"}, {"headers", "STATIC_LINK"}, {"script", "CONTAINS"}};
  std::map<std::string, std::string> relations;
  for (const auto& relation : bill.at("relationships"))
    EXPECT_TRUE(relations.emplace(relation.at("relatedSpdxElement"), relation.at("relationshipType")).second);
  EXPECT_EQ(relations.at("SPDXRef-treadmark"), "DESCRIBES");
  EXPECT_EQ(packages.size(), version.at("libraries").size() + 1);
  EXPECT_EQ(relations.size(), packages.size());
  for (const auto& library : version.at("libraries")) {
    const auto found = ranges::find_if(packages, [&](const auto& p) { return p.second["name"] == library["name"]; });
    ASSERT_NE(found, packages.end()) << library;
    EXPECT_EQ(found->second.at("versionInfo"), library.at("version"));
    EXPECT_EQ(found->second.at("licenseDeclared"), library.at("licence"));
    EXPECT_EQ(relations.at(found->first), linked.at(library.at("linked")));
  }
  EXPECT_EQ(ranges::count(version.at("libraries"), "script", [](const auto& l) { return l["linked"]; }) > 0,
            has_part("report_scripts"));
}

TEST(CommandLine, WrongUsageEndsWithTwo) {
  EXPECT_EQ(run_program({}).status, 2);
  EXPECT_EQ(run_program({"dance"}).status, 2);
  EXPECT_EQ(run_program({"run"}).status, 2);
  EXPECT_EQ(run_program({"run", "--nonsense", "x.inp"}).status, 2);
  EXPECT_EQ(run_program({"run", "case.doc"}).status, 2);
  EXPECT_EQ(run_program({"list", "wishes"}).status, 2);
}

TEST(CommandLine, ListsAndSchema) {
  EXPECT_THAT(run_program({"list", "backends"}).out, HasSubstr("spline"));
  EXPECT_THAT(run_program({"list", "profiles"}).out, HasSubstr("S1002"));
  const std::string defects = run_program({"list", "defects"}).out;
  Defects::each(Defects{}, [&](const char* path, Body, const auto&) { EXPECT_THAT(defects, HasSubstr(path)); });
  EXPECT_THAT(defects, ContainsRegex("wheel.spalls .*\n.*edge_mm .required.*theta_center_deg"));
  const ProgramResult schema = run_program({"schema"});
  EXPECT_EQ(schema.status, 0);
  EXPECT_THAT(schema.out, HasSubstr("json-schema.org"));
  EXPECT_EQ(run_program({"schema", "case"}).out, schema.out);
  for (const char* result : {"result", "compare", "bench", "geometry", "measure"})
    EXPECT_TRUE(nlohmann::json::parse(run_program({"schema", result}).out).contains("required")) << result;
  if (has_part("scans")) {
    EXPECT_THAT(run_program({"schema", "import"}).out, HasSubstr("hole_limit_mm"));
    EXPECT_THAT(run_program({"schema", "import-report"}).out, HasSubstr("Treadmark import report"));
  }
  if (has_part("vehicle")) {
    EXPECT_THAT(run_program({"schema", "simulation"}).out, HasSubstr("max_step_elements"));
  }
  EXPECT_EQ(run_program({"schema", "wishes"}).status, 2);
  const auto verb = [](const std::string& name, const char* part) {
    return name + (has_part(part) ? "" : " - left out of this build: " + left_out_advice(part)) + '\n';
  };
  EXPECT_EQ(run_program({"list", "verbs"}).out,
            "run\ncheck\ngeometry\n" + verb("table", "vehicle") + "compare\ndiff\nbench\nconform\nmeasure\n" +
                verb("import", "scans") + verb("scan", "scans") + "convert\ntrace\n" + verb("simulate", "vehicle") +
                verb("assess", "vehicle") + verb("stability", "vehicle") + verb("response", "vehicle") +
                verb("track", "vehicle") + verb("fmu", "fmu") + verb("evolve", "vehicle") + verb("sweep", "vehicle") +
                verb("design", "nlopt") + verb("report", "report") + verb("plot", "report") +
                verb("live", "report_scripts") + "new\nlist\nschema\ncompletion\nman\n");
}

TEST(CommandLine, HelpFitsATerminalAndHasExamples) {
  const std::string all = run_program({"--help"}).out;
  EXPECT_THAT(all, ContainsRegex("Wheel on rail:\n  run  +Solve"));
  std::istringstream verbs("--help\n" + run_program({"list", "verbs"}).out);
  for (std::string verb; std::getline(verbs, verb);) {
    if (verb.find(' ') != std::string::npos) continue;  // left out
    const std::string help = run_program({verb, "--help"}).out;
    if (verb != "--help") {
      EXPECT_THAT(help, HasSubstr("Examples:\n  treadmark " + verb + ' '));
      EXPECT_THAT(all, ContainsRegex("\n  " + verb + " +[A-Z]"));
    }
    std::istringstream lines(help);
    for (std::string line; std::getline(lines, line);)
      if (!line.starts_with("  -")) {  // choices of an option are one word
        EXPECT_LE(line.size(), 80u) << line;
      }
  }
}

/// What bash would offer for the last of these words.
std::string completed(const std::string& words) {
  const std::string script = "eval \"$(" TREADMARK_PROGRAM " completion bash)\"; COMP_WORDS=(" + words +
                             "); COMP_CWORD=$((${#COMP_WORDS[@]} - 1)); _treadmark; echo ${COMPREPLY[*]}";
  return RunningProgram({"bash", "-c", script}).wait().out;
}

TEST(CommandLine, ShellsCompleteVerbsOptionsAndChoices) {
  EXPECT_EQ(completed("treadmark com"), "compare completion\n");
  EXPECT_EQ(completed("treadmark run --js"), "--json\n");
  EXPECT_EQ(completed("treadmark --quiet completion z"), "zsh\n");
  EXPECT_EQ(completed("treadmark geometry --wheel S10"), "S1002\n");
  EXPECT_EQ(completed("treadmark measure rail 60E2"), "60E2\n");
  EXPECT_EQ(completed("treadmark run --backend mesh-"), "mesh-flat\n");
  EXPECT_EQ(completed("treadmark run my.toml --set track.gauge_m"), "track.gauge_mm=\n");
  if (has_part("vehicle")) {
    EXPECT_EQ(completed("treadmark simulate my.toml --set simulation.speed_k"), "simulation.speed_km_h=\n");
  }
  EXPECT_EQ(completed("treadmark run examples/wheel"), "\n");  // files are the shell's own work
  EXPECT_THAT(run_program({"completion", "zsh"}).out, HasSubstr("'*--json["));
  EXPECT_THAT(run_program({"completion", "fish"}).out, HasSubstr("__fish_seen_subcommand_from run' -l json -r"));
  EXPECT_EQ(run_program({"completion", "csh"}).status, 2);
}

TEST(CommandLine, AWordThatIsNoVerbIsRefusedWithTheNearest) {
  const auto wrong = run_program({"--threads", "1", "simulat", "--help"});
  EXPECT_EQ(wrong.status, 2);
  EXPECT_THAT(wrong.err, HasSubstr("there is no verb 'simulat' (did you mean 'simulate'?)"));
  EXPECT_EQ(wrong.out, "");
  EXPECT_THAT(run_program({"xyzzy"}).err, HasSubstr("treadmark --help lists all"));
}

TEST(CommandLine, AloneItShowsFirstSteps) {
  const auto alone = run_program({});
  EXPECT_EQ(alone.status, 2);
  EXPECT_THAT(alone.out, HasSubstr("treadmark run CASE.toml"));
}

TEST(CommandLine, ManualPagesSayWhatHelpSays) {
  const std::string page = run_program({"man", "run"}).out;
  EXPECT_THAT(page, HasSubstr(".TH TREADMARK-RUN 1"));
  EXPECT_THAT(page, HasSubstr("\\fB\\-\\-json\\fR \\fIFILE\\fR"));
  EXPECT_THAT(page, HasSubstr(".SH EXAMPLES\n.nf\n  treadmark run "));
  const std::string all = run_program({"man"}).out;
  EXPECT_THAT(all, HasSubstr("\\fBtreadmark\\-check\\fR(1)"));
  EXPECT_THAT(all, HasSubstr(".SS Vehicle and track"));
  EXPECT_THAT(run_program({"man", "rum"}).err, HasSubstr("did you mean 'run'?"));
}

TEST(CommandLine, CheckReadsWithoutSolving) {
  SampleInput input;
  const ProgramResult r = run_program({"check", input.inp().string()});
  EXPECT_EQ(r.status, 0) << r.err;
  EXPECT_THAT(r.out, HasSubstr("2 cases"));
  input.edit("wheel.txt", "\n10 -0.5\n", "\n10 x\n");
  EXPECT_EQ(run_program({"check", input.inp().string()}).status, 3);
}

TEST(CommandLine, RunPrintsASummaryAndWritesEveryFile) {
  SampleInput input;
  const auto folder = input.folder() / "results";
  const ProgramResult r = run_program({"run", input.inp().string(), "-o", folder.string()});
  ASSERT_EQ(r.status, 0) << r.err;
  EXPECT_THAT(r.out, HasSubstr("MPa"));
  EXPECT_THAT(r.err, HasSubstr("results: " + folder.string() + "\n"));
  EXPECT_THAT(run_program({"run", input.inp().string()}).err, Not(HasSubstr("results:")));
  for (const char* file : {"result.json", "pressure.svg", "vtk"})
    EXPECT_TRUE(std::filesystem::exists(folder / file)) << file;
  EXPECT_EQ(std::filesystem::exists(folder / "fields.h5"), has_part("hdf5"));
  EXPECT_EQ(r.err.find("TREADMARK_WITH_HDF5=ON") == std::string::npos, has_part("hdf5"));
}

TEST(CommandLine, BackendByNameMustExist) {
  SampleInput input;
  EXPECT_EQ(run_program({"run", input.inp().string(), "--backend", "clay"}).status, 2);
  EXPECT_EQ(run_program({"run", input.inp().string(), "--backend", "spline"}).status, 0);
}

std::string without_times(const std::string& json) {
  return std::regex_replace(json, std::regex(R"re("(seconds|threads|[a-z]+_s)": *[-0-9.e+]+)re"), "");
}

TEST(CommandLine, AnyNumberOfThreadsGivesTheSameResultFile) {
  SampleInput input;
  const ProgramResult one = run_program({"run", input.inp().string(), "--json", "-", "--threads", "1"});
  const ProgramResult four = run_program({"run", input.inp().string(), "--json", "-", "--threads", "4"});
  ASSERT_EQ(one.status, 0) << one.err;
  EXPECT_EQ(without_times(one.out), without_times(four.out));
}

}  // namespace
}  // namespace treadmark::testing

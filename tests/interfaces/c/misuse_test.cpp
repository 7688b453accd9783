// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
// What callers do wrong: it has its status and its words, and changes nothing.
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <sys/resource.h>

#include <cmath>
#include <functional>
#include <limits>
#include <vector>

#include "treadmark/tests/interfaces/c/owned.hpp"

namespace treadmark::testing {
namespace {

using ::testing::HasSubstr;

constexpr double kNan = std::numeric_limits<double>::quiet_NaN(), kInf = std::numeric_limits<double>::infinity();
constexpr std::size_t kHuge = std::numeric_limits<std::size_t>::max();

class CMisuse : public ::testing::Test {
 protected:
  void SetUp() override {
    tm_surface *rail = nullptr, *wheel = nullptr;
    ASSERT_EQ(tm_surface_of_case(given_.get(), TM_RAIL, &rail), TM_OK) << tm_message();
    rail_.reset(rail);
    ASSERT_EQ(tm_surface_of_case(given_.get(), TM_WHEEL, &wheel), TM_OK) << tm_message();
    wheel_.reset(wheel);
    pair_ = pair_of(given_.get());
    solution_ = solved(pair_.get(), given_.get());
    tm_state* state = nullptr;
    ASSERT_EQ(tm_pair_save(pair_.get(), &state), TM_OK);
    state_.reset(state);
    tm_patch* patch = nullptr;
    ASSERT_EQ(tm_patch_create(&patch), TM_OK);
    patch_.reset(patch);
  }

  const CaseOf given_ = case_of(kText);
  SurfaceOf rail_, wheel_;
  PairOf pair_;
  SolutionOf solution_;
  StateOf state_;
  PatchOf patch_;
};

TEST_F(CMisuse, HasItsStatusAndItsWords) {
  tm_case* c = given_.get();
  tm_pair* p = pair_.get();
  tm_solution* s = solution_.get();
  const tm_surface *rail = rail_.get(), *wheel = wheel_.get();

  // every output begins as something else than what a failure leaves
  auto* const poison = reinterpret_cast<void*>(1);
  tm_case* new_case = nullptr;
  tm_surface* new_surface = nullptr;
  tm_pair* new_pair = nullptr;
  tm_solution* new_solution = nullptr;
  tm_state* new_state = nullptr;
  tm_patch* new_patch = nullptr;
  char *json = nullptr, *audit = nullptr;
  const char *name = nullptr, *text = nullptr;
  const double* field = nullptr;
  double value = 7.0;
  int id = 7, nx = 7;
  std::size_t size = 1;

  const double y[] = {0.0, 0.01, 0.02}, falling[] = {0.02, 0.01, 0.0}, bad[] = {0.0, kNan, 0.0},
               xyz[] = {0, 0, 0, 1, 0, 0, 0, 1, 0}, no_rotation[] = {2, 0, 0, 0, 1, 0, 0, 0, 1}, far[] = {kInf, 0, 0};
  const std::int32_t triangle[] = {0, 1, 2}, corners[] = {0, 1, 7}, negative[] = {0, 1, -1};
  double z[3];
  unsigned char bytes[64] = {};
  const char *files[] = {"/nowhere.ply"}, *none[] = {nullptr}, *wrong[] = {"clean.nonsense=1"};
  // what tm_geometry and tm_measure are told, and what they say to it
  const char *pair_of_names[] = {"wheel=S1002", "rail=60E1"}, *no_equals[] = {"gauge_mm"},
             *nan_gauge[] = {"wheel=S1002", "rail=60E1", "gauge_mm=nan"}, *misspelt[] = {"guage_mm=1435"},
             *turned[] = {"wheel=60E1", "rail=S1002", "gauge_mm=1435"},
             *missing[] = {"wheel=/nowhere.whl", "rail=60E1", "gauge_mm=1435"},
             *wide[] = {"wheel=S1002", "rail=60E1", "gauge_mm=1600"}, *some_roll[] = {"roll=some"},
             *of_no_case[] = {"wheel=S1002", "rail=60E1", "gauge_mm=1435", "wheelset.y_mm=1"},
             *stations[] = {"stations=1.5"}, *infinite[] = {"line_mm=inf"}, *for_rails[] = {"alignment=top"},
             *no_profile[] = {"nominal=S1003"};
  const auto flat_function = [](void*, double, const double*, std::size_t n, double* heights) {
    for (std::size_t k = 0; k < n; ++k) heights[k] = 0.0;
    return 0;
  };
  const auto nan_function = [](void*, double, const double*, std::size_t n, double* heights) {
    for (std::size_t k = 0; k < n; ++k) heights[k] = kNan;
    return 0;
  };
  const auto set = [&](const char* key, double x) { return [c, key, x] { return tm_case_set_number(c, key, x); }; };

  struct Misuse {
    const char* what;
    tm_status expected;
    const char* words;
    int outputs;  ///< that must become null
    std::function<tm_status()> call;
  };
  const Misuse all[] = {
      {"no output", TM_BAD_ARGUMENT, "out", 0, [&] { return tm_case_create(0, nullptr); }},
      {"kind", TM_BAD_ARGUMENT, "0 or 1", 1, [&] { return tm_case_create(2, &new_case); }},
      {"no text", TM_BAD_ARGUMENT, "text", 1, [&] { return tm_case_parse(nullptr, 3, nullptr, 1, &new_case); }},
      {"case 2 of 1", TM_BAD_ARGUMENT, "number", 1,
       [&] { return tm_case_parse(kText.data(), kText.size(), nullptr, 2, &new_case); }},
      {"case 0", TM_BAD_ARGUMENT, "number", 1,
       [&] { return tm_case_parse(kText.data(), kText.size(), nullptr, 0, &new_case); }},
      {"not TOML", TM_BAD_REQUEST, "text:1:", 1, [&] { return tm_case_parse("[[", 2, nullptr, 1, &new_case); }},
      {"no file name", TM_BAD_ARGUMENT, "file", 1, [&] { return tm_case_read(nullptr, 1, &new_case); }},
      {"no file", TM_BAD_REQUEST, "nowhere.toml", 1, [&] { return tm_case_read("/nowhere.toml", 1, &new_case); }},
      {"copy of nothing", TM_BAD_ARGUMENT, "from", 1, [&] { return tm_case_copy(nullptr, &new_case); }},
      {"text of nothing", TM_BAD_ARGUMENT, "case", 1, [&] { return tm_case_text(nullptr, &json); }},
      {"check of nothing", TM_BAD_ARGUMENT, "file", 1, [&] { return tm_check_profile(nullptr, nullptr, &json); }},
      {"check of no file", TM_BAD_INPUT, "nowhere.whl", 1,
       [&] { return tm_check_profile("/nowhere.whl", nullptr, &json); }},
      {"pose of nothing", TM_BAD_ARGUMENT, "solution", 0,
       [&] { return tm_solution_pose(nullptr, TM_WHEEL, nullptr, nullptr); }},
      {"pose of no patch", TM_BAD_ARGUMENT, "solution", 0, [&] { return tm_patch_pose(nullptr, 0, nullptr, nullptr); }},
      {"states of nothing", TM_BAD_ARGUMENT, "states", 0, [&] { return tm_patch_states(nullptr, 0, nullptr); }},
      {"no case", TM_BAD_ARGUMENT, "case", 0, [&] { return tm_case_set(nullptr, "wheelset.y_mm=1"); }},
      {"no assignment", TM_BAD_ARGUMENT, "assignment", 0, [&] { return tm_case_set(c, nullptr); }},
      {"nonsense", TM_BAD_REQUEST, "nonsense", 0, [&] { return tm_case_set(c, "nonsense"); }},
      {"unknown key", TM_BAD_REQUEST, "wheelset.x_mm", 0, [&] { return tm_case_set(c, "wheelset.x_mm=1"); }},
      {"number of no case", TM_BAD_ARGUMENT, "case", 0, [&] { return tm_case_set_number(nullptr, "wheelset.y", 1.0); }},
      {"no name", TM_BAD_ARGUMENT, "name", 0, set(nullptr, 1.0)},
      {"unknown name", TM_BAD_ARGUMENT, "tm_list", 0, set("wheelset.why", 1.0)},
      {"NaN", TM_BAD_REQUEST, "y_mm", 0, set("wheelset.y", kNan)},
      {"infinity", TM_BAD_REQUEST, "y_mm", 0, set("wheelset.y", -kInf)},
      {"more than a number holds", TM_BAD_REQUEST, "y_mm", 0, set("wheelset.y", 1e308)},
      {"no whole number", TM_BAD_REQUEST, "whole", 0, set("discretisation.max_elements", 10.5)},
      {"too large for one", TM_BAD_REQUEST, "whole", 0, set("discretisation.max_elements", 1e12)},
      {"too small for one", TM_BAD_REQUEST, "whole", 0, set("discretisation.max_elements", -1e12)},
      {"whole, too large by one", TM_BAD_REQUEST, "whole", 0, set("discretisation.max_elements", 2147483648.0)},
      {"whole, but negative", TM_BAD_REQUEST, "max_elements", 0, set("discretisation.max_elements", -2147483647.0)},
      {"of a patch", TM_BAD_REQUEST, "kind", 0, set("patch.normal_force", 1.0)},
      {"out of range", TM_BAD_REQUEST, "nominal_radius", 0, set("wheelset.nominal_radius", -1.0)},
      {"id", TM_BAD_ARGUMENT, "id", 0, [&] { return tm_case_set_number_by_id(c, 100000, 1.0); }},
      {"negative id", TM_BAD_ARGUMENT, "id", 0, [&] { return tm_case_set_number_by_id(c, -1, 1.0); }},
      {"nowhere to", TM_BAD_ARGUMENT, "value", 0, [&] { return tm_case_get_number(c, "wheelset.y", nullptr); }},
      {"nobody's name", TM_BAD_ARGUMENT, "tm_list", 0, [&] { return tm_case_get_number(c, "y", &value); }},
      {"id of nothing", TM_BAD_ARGUMENT, "name", 0, [&] { return tm_case_find_number(nullptr, &id); }},
      {"id of nobody", TM_BAD_ARGUMENT, "name", 0, [&] { return tm_case_find_number("why", &id); }},

      {"surface of no file", TM_BAD_ARGUMENT, "file", 1,
       [&] { return tm_surface_read(nullptr, TM_RAIL, 0, 1, &new_surface); }},
      {"surface not there", TM_BAD_INPUT, "nowhere.prr", 1,
       [&] { return tm_surface_read("/nowhere.prr", TM_RAIL, 0, 1, &new_surface); }},
      {"scale", TM_BAD_ARGUMENT, "scale", 1, [&] { return tm_surface_read("x.prr", TM_RAIL, 0, kNan, &new_surface); }},
      {"radius", TM_BAD_ARGUMENT, "radius", 1, [&] { return tm_surface_read("x.prw", TM_WHEEL, -1, 1, &new_surface); }},
      {"body", TM_BAD_ARGUMENT, "body", 1,
       [&] { return tm_surface_from_profile(static_cast<tm_body>(5), y, y, 3, 0.0, 0.0, &new_surface); }},
      {"one point", TM_BAD_ARGUMENT, "two points", 1,
       [&] { return tm_surface_from_profile(TM_RAIL, y, y, 1, 0, 0, &new_surface); }},
      {"NaN point", TM_BAD_ARGUMENT, "z must be", 1,
       [&] { return tm_surface_from_profile(TM_RAIL, y, bad, 3, 0, 0, &new_surface); }},
      {"no points", TM_BAD_ARGUMENT, "y must be", 1,
       [&] { return tm_surface_from_profile(TM_RAIL, nullptr, y, 3, 0, 0, &new_surface); }},
      {"no radius", TM_BAD_ARGUMENT, "radius", 1,
       [&] { return tm_surface_from_profile(TM_WHEEL, falling, y, 3, 0, 0, &new_surface); }},
      {"strength", TM_BAD_ARGUMENT, "strength", 1,
       [&] { return tm_surface_from_profile(TM_RAIL, y, y, 3, 0, -1, &new_surface); }},
      {"size", TM_BAD_ARGUMENT, "points", 1,
       [&] { return tm_surface_from_profile(TM_RAIL, y, y, kHuge, 0, 0, &new_surface); }},
      {"one slice", TM_BAD_ARGUMENT, "slices", 1,
       [&] { return tm_surface_from_slices(TM_RAIL, y, 1, y, y, 3, 0, &new_surface); }},
      {"slices of all memory", TM_BAD_ARGUMENT, "slices", 1,
       [&] { return tm_surface_from_slices(TM_RAIL, y, kHuge / 2, y, y, 4, 0, &new_surface); }},
      {"corner", TM_BAD_ARGUMENT, "corner", 1,
       [&] { return tm_surface_from_triangles(TM_RAIL, xyz, 3, corners, 1, 0, &new_surface); }},
      {"negative corner", TM_BAD_ARGUMENT, "corner", 1,
       [&] { return tm_surface_from_triangles(TM_RAIL, xyz, 3, negative, 1, 0, &new_surface); }},
      {"no triangles", TM_BAD_ARGUMENT, "triangle", 1,
       [&] { return tm_surface_from_triangles(TM_RAIL, xyz, 3, triangle, 0, 0, &new_surface); }},
      {"no function", TM_BAD_ARGUMENT, "function", 1,
       [&] { return tm_surface_from_function(TM_RAIL, nullptr, nullptr, 0, 1, 4, 0, 1, 4, 0, &new_surface); }},
      {"empty rectangle", TM_BAD_ARGUMENT, "rectangle", 1,
       [&] { return tm_surface_from_function(TM_RAIL, flat_function, nullptr, 1, 1, 4, 0, 1, 4, 0, &new_surface); }},
      {"function of NaN", TM_BAD_ARGUMENT, "not finite", 1,
       [&] { return tm_surface_from_function(TM_RAIL, nan_function, nullptr, 0, 1, 4, 0, 1, 4, 0, &new_surface); }},
      {"no scan", TM_BAD_ARGUMENT, "file", 2,
       [&] { return tm_surface_from_scan(files, 0, TM_RAIL, nullptr, 0, &audit, &new_surface); }},
      {"null scan", TM_BAD_ARGUMENT, "files", 2,
       [&] { return tm_surface_from_scan(none, 1, TM_RAIL, nullptr, 0, &audit, &new_surface); }},
      {"setting", TM_BAD_REQUEST, "nonsense", 2,
       [&] { return tm_surface_from_scan(files, 1, TM_RAIL, wrong, 1, &audit, &new_surface); }},
      {"scan not there", TM_BAD_INPUT, "nowhere.ply", 2,
       [&] { return tm_surface_from_scan(files, 1, TM_RAIL, nullptr, 0, &audit, &new_surface); }},
      {"backend", TM_BAD_REQUEST, "marble", 1, [&] { return tm_surface_represent(rail, "marble", 0, &new_surface); }},
      {"no backend", TM_BAD_ARGUMENT, "backend", 1,
       [&] { return tm_surface_represent(rail, nullptr, 0, &new_surface); }},
      {"resolution", TM_BAD_ARGUMENT, "resolution", 1,
       [&] { return tm_surface_represent(rail, "spline", kInf, &new_surface); }},
      {"heights of nothing", TM_BAD_ARGUMENT, "surface", 0,
       [&] { return tm_surface_heights(nullptr, nullptr, nullptr, y, y, 3, z, nullptr, nullptr); }},
      {"too many heights", TM_BAD_ARGUMENT, "too many", 0,
       [&] { return tm_surface_heights(rail, nullptr, nullptr, y, y, kHuge, z, nullptr, nullptr); }},
      {"no rotation", TM_BAD_ARGUMENT, "rotation", 0,
       [&] { return tm_surface_heights(rail, nullptr, no_rotation, y, y, 3, z, nullptr, nullptr); }},
      {"far origin", TM_BAD_ARGUMENT, "origin", 0,
       [&] { return tm_surface_heights(rail, far, nullptr, y, y, 3, z, nullptr, nullptr); }},
      {"heights at NaN", TM_BAD_ARGUMENT, "x must be", 0,
       [&] { return tm_surface_heights(rail, nullptr, nullptr, bad, y, 3, z, nullptr, nullptr); }},

      {"wheel and rail exchanged", TM_BAD_ARGUMENT, "in this order", 1,
       [&] { return tm_pair_create(wheel, rail, &new_pair); }},
      {"no wheel", TM_BAD_ARGUMENT, "wheel", 1, [&] { return tm_pair_create(rail, nullptr, &new_pair); }},
      {"pair of no case", TM_BAD_ARGUMENT, "case", 1, [&] { return tm_pair_of_case(nullptr, &new_pair); }},
      {"null case", TM_BAD_ARGUMENT, "case", 1, [&] { return tm_pair_solve(p, nullptr, &new_solution); }},
      {"null pair", TM_BAD_ARGUMENT, "pair", 1, [&] { return tm_pair_solve(nullptr, c, &new_solution); }},
      {"no solution wanted", TM_BAD_ARGUMENT, "out", 0, [&] { return tm_pair_solve(p, c, nullptr); }},
      {"reset of nothing", TM_BAD_ARGUMENT, "pair", 0, [&] { return tm_pair_reset(nullptr); }},
      {"state of nothing", TM_BAD_ARGUMENT, "pair", 1, [&] { return tm_pair_save(nullptr, &new_state); }},
      {"no state", TM_BAD_ARGUMENT, "state", 0, [&] { return tm_pair_restore(p, nullptr); }},
      {"bytes of nothing", TM_BAD_ARGUMENT, "state", 0, [&] { return tm_state_to_bytes(nullptr, bytes, &size); }},
      {"no bytes", TM_BAD_ARGUMENT, "bytes", 1, [&] { return tm_state_from_bytes(nullptr, 3, &new_state); }},
      {"other bytes", TM_BAD_INPUT, "state", 1, [&] { return tm_state_from_bytes(bytes, sizeof bytes, &new_state); }},
      {"no patch", TM_BAD_ARGUMENT, "out", 0, [&] { return tm_patch_create(nullptr); }},
      {"patch of a pair's case", TM_BAD_ARGUMENT, "wheel on a rail", 1,
       [&] { return tm_patch_solve(patch_.get(), c, &new_solution); }},

      {"status of nothing", TM_BAD_ARGUMENT, "solution", 0, [&] { return tm_solution_status(nullptr); }},
      {"remark 99", TM_BAD_ARGUMENT, "index", 2,
       [&] { return tm_solution_remark(s, 99, &name, &text, nullptr, nullptr); }},
      {"number of nothing", TM_BAD_ARGUMENT, "solution", 0,
       [&] { return tm_solution_number(nullptr, "wheelset.z", &value); }},
      {"no such number", TM_BAD_ARGUMENT, "tm_list", 0, [&] { return tm_solution_number(s, "z", &value); }},
      {"no patch 9", TM_BAD_ARGUMENT, "patch", 0, [&] { return tm_patch_number(s, 9, "fn", &value); }},
      {"no number of patches", TM_BAD_ARGUMENT, "tm_list", 0,
       [&] { return tm_patch_number(s, 0, "nonsense", &value); }},
      {"no grid 9", TM_BAD_ARGUMENT, "patch", 0,
       [&] { return tm_patch_grid(s, kHuge, &nx, nullptr, nullptr, nullptr, nullptr, nullptr); }},
      {"no field", TM_BAD_ARGUMENT, "field", 1, [&] { return tm_patch_field(s, 0, "nonsense", &field); }},
      {"nameless field", TM_BAD_ARGUMENT, "name", 1, [&] { return tm_patch_field(s, 0, nullptr, &field); }},
      {"table", TM_BAD_ARGUMENT, "table", 1,
       [&] { return tm_list(static_cast<tm_table>(9), 0, &name, nullptr, nullptr); }},
      {"row", TM_BAD_ARGUMENT, "row", 1, [&] { return tm_list(TM_PATCH_FIELDS, kHuge, &name, nullptr, nullptr); }},
      {"run of no file", TM_BAD_ARGUMENT, "file", 1, [&] { return tm_run(nullptr, nullptr, 0, &json); }},
      {"null assignment", TM_BAD_ARGUMENT, "assignments", 1, [&] { return tm_run("x.toml", none, 1, &json); }},
      {"run of nothing", TM_BAD_REQUEST, "nowhere.toml", 1, [&] { return tm_run("/nowhere.toml", nullptr, 0, &json); }},
      {"geometry of nothing", TM_BAD_REQUEST, "wheel is missing", 1, [&] { return tm_geometry(nullptr, 0, &json); }},
      {"settings that are not there", TM_BAD_ARGUMENT, "settings", 1, [&] { return tm_geometry(nullptr, 2, &json); }},
      {"null setting", TM_BAD_ARGUMENT, "settings", 1, [&] { return tm_geometry(none, 1, &json); }},
      {"no place for the rails", TM_BAD_REQUEST, "where the rails are", 1,
       [&] { return tm_geometry(pair_of_names, 2, &json); }},
      {"no equals sign", TM_BAD_REQUEST, "'='", 1, [&] { return tm_geometry(no_equals, 1, &json); }},
      {"gauge of NaN", TM_BAD_REQUEST, "gauge_mm must be finite", 1, [&] { return tm_geometry(nan_gauge, 3, &json); }},
      {"unknown setting", TM_BAD_REQUEST, "did you mean 'gauge_mm'", 1,
       [&] { return tm_geometry(misspelt, 1, &json); }},
      {"rail for a wheel", TM_BAD_INPUT, "60E1", 1, [&] { return tm_geometry(turned, 3, &json); }},
      {"wheel that is no file", TM_BAD_INPUT, "nowhere.whl", 1, [&] { return tm_geometry(missing, 3, &json); }},
      {"wheelset that falls", TM_NUMERICAL, "gauge", 1, [&] { return tm_geometry(wide, 3, &json); }},
      {"no such roll", TM_BAD_REQUEST, "roll", 1, [&] { return tm_geometry(some_roll, 1, &json); }},
      {"keys of no case", TM_BAD_REQUEST, "case", 1, [&] { return tm_geometry(of_no_case, 4, &json); }},
      {"measures of no file", TM_BAD_ARGUMENT, "file", 1,
       [&] { return tm_measure(TM_WHEEL, nullptr, nullptr, 0, &json); }},
      {"measures of no body", TM_BAD_ARGUMENT, "body", 1,
       [&] { return tm_measure(static_cast<tm_body>(5), "S1002", nullptr, 0, &json); }},
      {"measures of another body", TM_BAD_REQUEST, "not a rail", 1,
       [&] { return tm_measure(TM_RAIL, "S1002", nullptr, 0, &json); }},
      {"measures of nothing", TM_BAD_INPUT, "nowhere.whl", 1,
       [&] { return tm_measure(TM_WHEEL, "/nowhere.whl", nullptr, 0, &json); }},
      {"measures by a null setting", TM_BAD_ARGUMENT, "settings", 1,
       [&] { return tm_measure(TM_WHEEL, "S1002", none, 1, &json); }},
      {"stations", TM_BAD_REQUEST, "stations", 1, [&] { return tm_measure(TM_RAIL, "60E1", stations, 1, &json); }},
      {"infinite line", TM_BAD_REQUEST, "line_mm must be finite", 1,
       [&] { return tm_measure(TM_RAIL, "60E1", infinite, 1, &json); }},
      {"alignment of a wheel", TM_BAD_REQUEST, "belongs to rails", 1,
       [&] { return tm_measure(TM_WHEEL, "S1002", for_rails, 1, &json); }},
      {"nominal that is none", TM_BAD_REQUEST, "S1003", 1,
       [&] { return tm_measure(TM_WHEEL, "S1002", no_profile, 1, &json); }},
      {"threads", TM_BAD_ARGUMENT, "threads", 0, [&] { return tm_set_threads(-1); }},
      {"all threads of the world", TM_BAD_ARGUMENT, "threads", 0, [&] { return tm_set_threads(1 << 30); }},
  };
  ::testing::internal::CaptureStdout();
  ::testing::internal::CaptureStderr();
  for (const Misuse& misuse : all) {
    for (void* output : {static_cast<void*>(&new_case), static_cast<void*>(&new_surface), static_cast<void*>(&new_pair),
                         static_cast<void*>(&new_solution), static_cast<void*>(&new_state),
                         static_cast<void*>(&new_patch), static_cast<void*>(&json), static_cast<void*>(&audit),
                         static_cast<void*>(&name), static_cast<void*>(&text), static_cast<void*>(&field)})
      *static_cast<void**>(output) = poison;
    EXPECT_EQ(misuse.call(), misuse.expected) << misuse.what << ": " << tm_message();
    EXPECT_THAT(tm_message(), HasSubstr(misuse.words)) << misuse.what;
    int null = 0;
    for (const void* output :
         {static_cast<const void*>(new_case), static_cast<const void*>(new_surface), static_cast<const void*>(new_pair),
          static_cast<const void*>(new_solution), static_cast<const void*>(new_state),
          static_cast<const void*>(new_patch), static_cast<const void*>(json), static_cast<const void*>(audit),
          static_cast<const void*>(name), static_cast<const void*>(text), static_cast<const void*>(field)})
      null += output == nullptr ? 1 : 0;
    EXPECT_EQ(null, misuse.outputs) << misuse.what;
  }
  EXPECT_EQ(::testing::internal::GetCapturedStdout(), "");
  EXPECT_EQ(::testing::internal::GetCapturedStderr(), "");
  EXPECT_EQ(value, 7.0);
  EXPECT_EQ(id, 7);
  EXPECT_EQ(nx, 7);
  EXPECT_EQ(size, 1u);
  const SolutionOf after = solved(p, c);
  EXPECT_EQ(treadmark::testing::field(after.get(), 0, "traction_x"), treadmark::testing::field(s, 0, "traction_x"));
}

TEST_F(CMisuse, NullIsFreedAndNamedWithoutEffect) {
  tm_case_free(nullptr);
  tm_surface_free(nullptr);
  tm_pair_free(nullptr);
  tm_patch_free(nullptr);
  tm_state_free(nullptr);
  tm_solution_free(nullptr);
  tm_text_free(nullptr);
  EXPECT_EQ(tm_surface_backend(nullptr), nullptr);
  EXPECT_EQ(tm_solution_patches(nullptr), 0u);
  EXPECT_EQ(tm_solution_remarks(nullptr), 0u);
  EXPECT_STREQ(tm_solution_message(nullptr), "");
  EXPECT_STREQ(tm_status_name(static_cast<tm_status>(99)), "unknown");
  tm_version(nullptr, nullptr, nullptr);
}

TEST_F(CMisuse, OutputsThatAreNotWantedAreNull) {
  EXPECT_EQ(tm_patch_grid(solution_.get(), 0, nullptr, nullptr, nullptr, nullptr, nullptr, nullptr), TM_OK);
  EXPECT_EQ(tm_list(TM_CASE_NUMBERS, 0, nullptr, nullptr, nullptr), TM_OK);
  const double x[] = {0.0}, y[] = {0.0};
  EXPECT_EQ(tm_surface_heights(rail_.get(), nullptr, nullptr, x, y, 1, nullptr, nullptr, nullptr), TM_OK)
      << tm_message();
}

TEST_F(CMisuse, ACaseOfAnotherRadiusIsRefused) {
  ASSERT_EQ(tm_case_set_number(given_.get(), "wheelset.nominal_radius", 0.5), TM_OK);
  tm_solution* out = nullptr;
  EXPECT_EQ(tm_pair_solve(pair_.get(), given_.get(), &out), TM_BAD_REQUEST);
  EXPECT_THAT(tm_message(), HasSubstr("0.46"));
  ASSERT_EQ(tm_case_set_number(given_.get(), "wheelset.nominal_radius", 0.46), TM_OK);
  EXPECT_NE(solved(pair_.get(), given_.get()), nullptr);
}

TEST_F(CMisuse, ASavedStateWithMoreBehindItIsRefused) {
  std::size_t size = 0;
  ASSERT_EQ(tm_state_to_bytes(state_.get(), nullptr, &size), TM_OK);
  std::vector<unsigned char> bytes(size + 1);
  std::size_t room = bytes.size();
  ASSERT_EQ(tm_state_to_bytes(state_.get(), bytes.data(), &room), TM_OK);
  EXPECT_EQ(room, size);
  tm_state* out = nullptr;
  EXPECT_EQ(tm_state_from_bytes(bytes.data(), size + 1, &out), TM_BAD_INPUT);
  EXPECT_EQ(tm_state_from_bytes(bytes.data(), size, &out), TM_OK) << tm_message();
  tm_state_free(out);
}

TEST_F(CMisuse, TextsThatAreLentStayWhenNumbersAreAskedFor) {
  ASSERT_EQ(tm_case_set(given_.get(), "wheelset.z_mm=-20"), TM_OK) << tm_message();
  const SolutionOf s = solved(pair_.get(), given_.get(), TM_NO_CONTACT);
  const char* message = tm_solution_message(s.get());
  const std::string before = message;
  EXPECT_NE(before, "");
  number(s.get(), "wheelset.z");
  EXPECT_EQ(tm_solution_message(s.get()), message);
  EXPECT_EQ(message, before);
}

#if !defined(__SANITIZE_ADDRESS__) && !defined(__SANITIZE_THREAD__)
TEST_F(CMisuse, MemoryThatEndsIsAStatus) {
  const auto in_little_memory = [&] {
    const rlimit little{std::size_t{1} << 30, std::size_t{1} << 30};
    setrlimit(RLIMIT_AS, &little);
    constexpr std::size_t kPoints = std::size_t{1} << 14;  // each way: gigabytes
    tm_surface* made = nullptr;
    const auto flat = [](void*, double, const double*, std::size_t, double*) { return 0; };
    const tm_status status = tm_surface_from_function(TM_RAIL, flat, nullptr, 0, 1, kPoints, 0, 1, kPoints, 0, &made);
    const bool said =
        status == TM_OUT_OF_MEMORY && made == nullptr && std::string(tm_message()).find("memory") != std::string::npos;
    tm_solution* again = nullptr;
    std::_Exit(said && tm_pair_solve(pair_.get(), given_.get(), &again) == TM_OK ? 0 : 1);
  };
  GTEST_FLAG_SET(death_test_style, "threadsafe");
  EXPECT_EXIT(in_little_memory(), ::testing::ExitedWithCode(0), "");
}
#endif

}  // namespace
}  // namespace treadmark::testing

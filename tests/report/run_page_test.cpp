// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#include "treadmark/app/cases/pages/run_page.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>

#include "treadmark/report/field_catalogue.hpp"
#include "treadmark/report/frame_packer.hpp"
#include "treadmark/report/plot.hpp"
#include "treadmark/report/write_page.hpp"
#include "treadmark/tests/report/page_reader.hpp"

namespace treadmark::app::pages {

using namespace report;

namespace {

using ::testing::HasSubstr;
using ::testing::Not;
using namespace treadmark::testing;

/// A patch of nx by ny elements in contact within a grid with an empty frame, pressure 1 MPa times the number of the
/// element.
io::PatchResult sample_patch(int nx, int ny, int empty) {
  io::PatchResult patch;
  patch.has_reference = true;
  patch.fields.grid = Grid2{-1e-3, -2e-3, 5e-4, 5e-4, nx + 2 * empty, ny + 2 * empty};
  const std::size_t size = patch.fields.grid.size();
  patch.fields.pressure.assign(size, 0.0);
  patch.fields.traction_x.assign(size, 0.0);
  patch.fields.traction_s.assign(size, 0.0);
  patch.fields.gap.assign(size, 1e-4);
  patch.fields.state.assign(size, 0);
  for (int iy = 0; iy < ny; ++iy)
    for (int ix = 0; ix < nx; ++ix) {
      const std::size_t i = patch.fields.grid.index(empty + ix, empty + iy);
      patch.fields.pressure[i] = 1e6 * (1 + ix + nx * iy);
      patch.fields.traction_x[i] = -3e5;
      patch.fields.traction_s[i] = 4e5;
      patch.fields.state[i] = ix % 2 == 0 ? 1 : 2;
    }
  patch.ncon = nx * ny;
  patch.nslip = ny * (nx / 2);
  patch.fn = 1e3;
  patch.pmax = 1e6 * nx * ny;
  return patch;
}

std::shared_ptr<io::RunResult> sample(int cases) {
  auto run = std::make_shared<io::RunResult>();
  run->version = "0.1.0";
  run->input_file = "folder/flat.toml";
  run->cases_total = cases;
  for (int i = 0; i < cases; ++i) {
    io::CaseResult result;
    result.number = i + 1;
    result.has_wheelset = true;
    result.pitch = 0.1 * i;
    result.force_tr = {10.0, -20.0, 1e5 + i};
    result.patches.push_back(sample_patch(4 + i, 3, 6));
    run->cases.push_back(std::move(result));
  }
  return run;
}

TEST(RunPage, TablesHoldTheNumbers) {
  const Page page = run_page(sample(3), "");
  EXPECT_EQ(page.title, "flat");
  const auto titled = std::make_shared<io::RunResult>(*sample(3));
  titled->title = "Our wheel";
  EXPECT_EQ(run_page(titled, "").title, "Our wheel");
  EXPECT_THAT(banners_of(page), Not(HasSubstr("failed")));
  const Table& cases = table_of(page, "cases");
  EXPECT_THAT(numbers_in(cases, "p_max"),
              ::testing::Pointwise(::testing::DoubleNear(1e-9), std::vector<double>{12, 15, 18}));
  EXPECT_THAT(numbers_in(cases, "F_z"),
              ::testing::Pointwise(::testing::DoubleNear(1e-9), std::vector<double>{100, 100.001, 100.002}));
  EXPECT_THAT(numbers_in(cases, "area"),
              ::testing::Pointwise(::testing::DoubleNear(1e-9), std::vector<double>{3, 3.75, 4.5}));
  EXPECT_EQ(table_of(page, "patches").rows.size(), 3u);
  EXPECT_EQ(numbers_in(table_of(page, "patches"), "slip area")[0], 50.0);
  EXPECT_THAT(card_of(page, "Largest pressure"), HasSubstr("18 MPa"));
  EXPECT_THAT(card_of(page, "Largest pressure"), HasSubstr("case 3"));
}

TEST(RunPage, SaysWhatWasAskedForAndTheWear) {
  const auto run = sample(2);
  EXPECT_EQ(card_of(run_page(run, ""), "Largest wear number Tγ"), "no card Largest wear number Tγ");  // nothing rolls
  run->inputs = {{"track: gauge", "1435 mm"}};
  io::PatchResult& rolls = run->cases[1].patches[0];
  rolls.has_rolling = true, rolls.velocity = 20.0, rolls.frictional_power = -2400.0;
  const Page page = run_page(run, "");
  EXPECT_EQ(page.sections.at(1).title, "Inputs");
  EXPECT_EQ(fact_of(page, "track: gauge"), "1435 mm");
  EXPECT_THAT(card_of(page, "Largest wear number Tγ"), HasSubstr("120 N"));
  EXPECT_EQ(numbers_in(table_of(page, "patches"), "Tγ")[1], 120.0);
}

TEST(RunPage, StepsAreNamedByWhatVaries) {
  const Page page = run_page(sample(3), "");
  ASSERT_TRUE(page.timeline);
  EXPECT_EQ(page.timeline->count(), 3u);
  EXPECT_EQ(page.timeline->axes.front().label, "pitch angle");
  EXPECT_NEAR(page.timeline->axes.front().values[1], 5.729577951, 1e-8);
  EXPECT_THAT(page.timeline->names[1], HasSubstr("case 2, pitch angle 5.730°"));
  const Page one = run_page(sample(1), "");
  EXPECT_EQ(one.timeline->axes.front().label, "case");
}

TEST(RunPage, TheWorstCaseIsShownFirstAndTheOriginComesLast) {
  auto run = sample(3);
  run->cases[1].patches[0].pmax = 9e9;
  run->input_sha256 = std::string(64, 'a');
  const Page page = run_page(run, "");
  EXPECT_EQ(page.timeline->start, 1u);
  EXPECT_EQ(page.sections.back().id, "origin");
  const std::string html = to_html(page, {false});
  EXPECT_GT(html.find(run->input_sha256), html.find("table-patches"));
  EXPECT_THAT(html, HasSubstr("as in the input"));
  EXPECT_FALSE(has_figure(page, "section"));  // these have no surfaces
  for (const char* body : {"wheel", "rail"}) {
    io::SampledSurface& surface = run->sampled.emplace_back();
    surface.body = surface.name = body;
  }
  for (const char* figure : {"section", "scene"}) EXPECT_TRUE(has_figure(run_page(run, ""), figure)) << figure;
}

TEST(RunPage, WhatWentWrongComesFirst) {
  auto run = sample(4);
  run->complete = false;
  run->cases_total = 9;
  run->cases[1].status = Status::failed;
  run->cases[1].message = "the rail <ends> here";
  run->cases[1].patches.clear();
  run->cases[2].status = Status::not_converged;
  run->cases[3].status = Status::no_contact;
  run->cases[3].patches.clear();
  const Page page = run_page(run, "");
  const std::string banners = banners_of(page);
  EXPECT_THAT(banners, ::testing::StartsWith("failed: Interrupted. 4 of 9 cases"));
  EXPECT_THAT(banners, HasSubstr("failed: 1 case failed. Case 2. First message: the rail <ends> here"));
  EXPECT_THAT(banners, HasSubstr("warning: 1 case did not converge."));
  EXPECT_THAT(banners, HasSubstr("note: 1 case without contact: 4"));
  EXPECT_TRUE(std::holds_alternative<Banner>(page.sections.front().blocks.front()));
  EXPECT_THAT(to_html(page), HasSubstr("the rail &lt;ends&gt; here"));
}

TEST(RunPage, FieldsOfOneSignHaveNoScaleAboutZero) {
  for (const char* name : {"pressure", "traction", "gap", "slip"}) {
    ASSERT_NE(find_field(name), nullptr) << name;
    EXPECT_EQ(find_field(name)->kind, FieldInfo::Kind::sequential) << name;
  }
  EXPECT_EQ(find_field("traction_x")->kind, FieldInfo::Kind::diverging);
}

TEST(RunPage, NothingFinishedIsAPageToo) {
  auto run = sample(0);
  run->complete = false;
  run->cases_total = 5;
  const Page page = run_page(run, "");
  EXPECT_THAT(banners_of(page), HasSubstr("0 of 5 cases"));
  EXPECT_THAT(to_html(page), HasSubstr("Interrupted."));
  EXPECT_THAT(to_html(page, {false}), HasSubstr("Interrupted."));
}

TEST(RunPage, CasesWithoutFieldsHaveNoContactView) {
  auto run = sample(2);
  for (io::CaseResult& c : run->cases)
    for (io::PatchResult& patch : c.patches) patch.fields = {};
  const Page page = run_page(run, "");
  EXPECT_FALSE(has_figure(page, "patches-view"));
  EXPECT_TRUE(has_figure(page, "forces"));
}

TEST(FramePacker, KeepsTheContactAndItsSurroundings) {
  const io::PatchResult patch = sample_patch(5, 3, 10);
  const GridPart part = shown_part(patch.fields);
  EXPECT_EQ(part.ix0, 6);
  EXPECT_EQ(part.iy0, 6);
  EXPECT_EQ(part.nx, 13);
  EXPECT_EQ(part.ny, 11);
  io::PatchResult none = patch;
  std::fill(none.fields.state.begin(), none.fields.state.end(), std::uint8_t{0});
  EXPECT_EQ(shown_part(none.fields).nx, patch.fields.grid.nx);
}

TEST(FramePacker, LeavesOutWhatDoesNotFitAndSaysSo) {
  const auto run = sample(40);
  FrameSet set{"all"};
  for (const io::CaseResult& c : run->cases) set.frames.push_back({"", std::shared_ptr<const io::CaseResult>(run, &c)});
  BlobStore roomy, tight;
  const PackedSets whole = pack_frames({set}, roomy, 10'000'000);
  const PackedSets part = pack_frames({set}, tight, 3000);
  for (const PackedFrame& frame : whole[0]) EXPECT_TRUE(frame.trimmed.empty());
  std::size_t kept = 0;
  for (const PackedFrame& frame : part[0]) {
    if (!frame.patches.empty()) ++kept;
    EXPECT_FALSE(frame.trimmed.empty());
  }
  EXPECT_GT(kept, 0u);
  EXPECT_LT(kept, 40u);
  EXPECT_LE(tight.text_size(), 3000u);
  EXPECT_GT(roomy.text_size(), tight.text_size());
}

TEST(Plot, DrawsFieldsChartsAndNothingElse) {
  const Page page = run_page(sample(3), "");
  std::vector<std::string> names;
  for (const auto& [name, meaning] : plots_of(page)) names.push_back(name);
  EXPECT_THAT(names, ::testing::IsSupersetOf({"pressure", "traction", "state", "gap", "forces"}));
  EXPECT_THAT(names, Not(::testing::Contains("temperature_1")));
  const std::string traction = plot(page, "traction", {});
  EXPECT_THAT(traction, ::testing::StartsWith("<svg"));
  EXPECT_THAT(traction, HasSubstr(">0.5</text>"));  // of a 3-4-5 triangle, in MPa, at the top of the scale
  EXPECT_THAT(plot(page, "pressure", {2}), Not(HasSubstr("case 1")));
  EXPECT_THAT(plot(page, "pressure", {2}), HasSubstr("case 2"));
  EXPECT_THAT(plot(page, "forces", {}), HasSubstr("largest pressure [MPa]"));
  EXPECT_THAT(error_of([&] { plot(page, "wishes", {}); }), HasSubstr("no plot \"wishes\""));
  EXPECT_THAT(error_of([&] { plot(page, "temperature_1", {}); }), HasSubstr("no plot"));
  EXPECT_THAT(error_of([&] { plot(page, "pressure", {7}); }), HasSubstr("no case 7"));
  EXPECT_THAT(error_of([&] { plot(page, "forces", {1}); }), HasSubstr("cannot be chosen"));
}

}  // namespace
}  // namespace treadmark::app::pages

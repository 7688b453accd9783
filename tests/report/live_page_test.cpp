// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#include "treadmark/app/cases/pages/live_page.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <string>

#include <nlohmann/json.hpp>

#include "treadmark/core/version.hpp"
#include "treadmark/report/page_data.hpp"
#include "treadmark/report/write_page.hpp"
#include "treadmark/tests/report/page_reader.hpp"
#include "treadmark/tests/support/parts.hpp"

namespace treadmark::app::pages {
namespace {

using ::testing::Contains;
using ::testing::HasSubstr;
using ::testing::Not;
using namespace treadmark::testing;

report::Page sample_live_page(const std::string& loader) {
  auto run = std::make_shared<io::RunResult>();
  run->input_file = "my.toml";
  run->cases.emplace_back().number = 1;
  report::Solving solving;
  solving.toml = "# </script>\nwheel.shape.file = \"own.csv\"\n";
  solving.files["own.csv"] = "1,2";
  solving.module = std::string("\0asm", 4);
  solving.loader = loader;
  return live_page(run, std::move(solving));
}

TEST(LivePage, HoldsItsCaseAndWhatTheViewsAreCalledInC) {
  const auto data = nlohmann::json::parse(page_data(sample_live_page(""), 1'000'000));
  const auto& live = data.at("live");
  EXPECT_EQ(live.at("version"), version() + " (" + git_revision() + ")");
  EXPECT_EQ(live.at("toml"), "# </script>\nwheel.shape.file = \"own.csv\"\n");
  EXPECT_EQ(live.at("files").at("own.csv"), "MSwy");
  EXPECT_THAT(live.at("profiles").at("wheel"), Contains("S1002"));
  EXPECT_THAT(live.at("profiles").at("rail"), Contains("60E1"));
  EXPECT_THAT(live.at("backends"), Contains("spline"));
  EXPECT_THAT(live.at("backends"), Not(Contains("level-set")));  // needs OpenVDB
  // here and beside it, which the page fills
  ASSERT_EQ(data.at("sets").size(), 2U);
  EXPECT_EQ(data.at("sets").at(1).at("name"), "beside");
  EXPECT_THAT(live.at("fields"),
              Contains(nlohmann::json::parse(
                  R"({"name": "traction", "columns": ["traction_x", "traction_s"], "factor": 1e-6})")));
  // what has another unit in a shift
  EXPECT_THAT(live.at("fields"),
              Contains(nlohmann::json::parse(
                  R"({"name": "slip", "columns": ["slip_x", "slip_s"], "factor": 100, "shift": false})")));
  EXPECT_THAT(live.at("fields"),
              Contains(nlohmann::json::parse(
                  R"({"name": "slip_distance", "columns": ["slip_x", "slip_s"], "factor": 1e6, "shift": true})")));
  EXPECT_THAT(live.at("numbers"),
              Contains(nlohmann::json::parse(R"({"key": "pmax_MPa", "name": "pmax", "factor": 1e-6})")));
}

TEST(LivePage, AllowsNothingBesidesItsOwnProgram) {
  TREADMARK_NEEDS("report_scripts");
  const std::string html = to_html(sample_live_page("var createTreadmark;"));
  EXPECT_THAT(html, HasSubstr("default-src 'none'"));
  EXPECT_THAT(html, HasSubstr("'wasm-unsafe-eval'; worker-src blob:; img-src data: blob:;"));
  EXPECT_THAT(html, HasSubstr("<script type=\"text/plain\" id=\"treadmark-loader\">var createTreadmark;</script>"));
  EXPECT_THAT(error_of([] { to_html(sample_live_page("a</script>b")); }), HasSubstr("markup"));
  // other pages need no such rule
  report::Page other = sample_live_page("");
  other.solving.reset();
  EXPECT_THAT(to_html(other), Not(HasSubstr("wasm-unsafe-eval")));
}

}  // namespace
}  // namespace treadmark::app::pages

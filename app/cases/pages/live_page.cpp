// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#include "treadmark/app/cases/pages/live_page.hpp"

#include <utility>

#include "treadmark/app/cases/pages/case_figures.hpp"
#include "treadmark/app/pages/page_parts.hpp"
#include "treadmark/backends/profile_library.hpp"
#include "treadmark/backends/registry.hpp"

namespace treadmark::app::pages {

using namespace report;

namespace {

Series line_of_beside() { return {"beside", {}, {}, Series::Marks::line, true}; }

/// This one and the next are filled by the page itself, which knows their names and the order of their series.
ChartView rolling_radii() {
  ChartView view;
  view.x = Axis{"lateral place of the wheelset y", "mm"};
  view.panels = {{"rolling radius difference",
                  "mm",
                  false,
                  {{"right less left", {}}, {"here", {}, {}, Series::Marks::points}, line_of_beside()}},
                 {"place of contact, right side", "mm", false, {{"on the rail", {}}, {"on the wheel", {}}}}};
  return view;
}

ChartView conicity() {
  ChartView view;
  view.x = Axis{"amplitude", "mm"};
  view.panels = {{"equivalent conicity tan γe",
                  "",
                  false,
                  {{"here", {}}, {"amplitude 3 mm", {}, {}, Series::Marks::points}, line_of_beside()}}};
  return view;
}

/// What the page solves at the same place to compare with.
Section beside() {
  return {"beside",
          "Beside it",
          {Figure{"beside-patches", "The same place: here, and with what is chosen above", ContactView{{0, 1}},
                  "Difference shows what is beside less what is here."},
           Figure{"beside-section", "Both cut at the contact", SectionView{0, {1}},
                  "Dashed: wheel and rail of what is beside."}}};
}

}  // namespace

Page live_page(const std::shared_ptr<const io::RunResult>& run, Solving solving) {
  for (const LibraryProfile& row : profile_library())
    if (!row.family) (row.body == Body::wheel ? solving.wheels : solving.rails).push_back(row.name);
  for (const Backend* row : backends())
    if (row->part.empty()) solving.backends.push_back(row->name);
  Page page{"live", title_of(run->title, run->input_file), ""};
  page.lead =
      "Change something, or drop a profile or a case on the page: it is solved here, in this page; nothing leaves it.";
  page.timeline = case_timeline(*run);
  page.sets = {frames_of(run, "here"), frames_of(run, "beside")};
  page.surfaces = run->sampled;
  page.sections = {{"given", "Wheel on rail"},
                   {"contact", "Contact", {Figure{"patches-view", "Contact patches", ContactView{{0}}}}},
                   beside(),
                   {"places",
                    "Over the track",
                    {Figure{"rolling-radii", "Rolling radius difference and places of contact", rolling_radii(),
                            "Of rigid bodies, without roll: as treadmark geometry has it."},
                     Figure{"conicity", "Equivalent conicity", conicity()}}}};
  append(page.sections[1].blocks, body_figures("Wheel and rail"));
  Facts origin = origin_facts(*run);
  origin.entries.emplace_back("Program in this page",
                              "Treadmark with Eigen (MPL-2.0), fmt, JSON for Modern C++, toml++, musl and Emscripten's "
                              "runtime (MIT), LLVM's C++ library (Apache-2.0 with LLVM exceptions)");
  page.sections.push_back({"origin", "The case at the start", {Facts{run->inputs}, std::move(origin)}});
  page.solving = std::move(solving);
  return page;
}

}  // namespace treadmark::app::pages

// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#include "treadmark/app/cases/run_parts.hpp"

#include "treadmark/app/cases/data_ends.hpp"
#include "treadmark/app/cases/wheelrail_case.hpp"
#include "treadmark/app/version.hpp"
#include "treadmark/core/parallel.hpp"
#include "treadmark/io/cases/writing/write_cases.hpp"

namespace treadmark::app {

wheelrail::Geometry geometry_of(const io::WheelRailCase& input, SurfaceStore& store, const SampledRegions& all) {
  const SampledRegions regions = regions_of(input, all);
  const StoredSurface& rail = store.get(input.rail, Body::rail, profile_radius(input, Body::rail), regions.rail);
  const StoredSurface& wheel = store.get(input.wheel, Body::wheel, profile_radius(input, Body::wheel), regions.wheel);
  return {rail.represented.surface, wheel.represented.surface, rail.constant_profile() && !input.roller,
          wheel.constant_profile()};
}

io::RunResult head_of(const io::CaseFile& file) {
  io::RunResult run;
  run.version = version();
  run.git = git_revision();
  run.threads = thread_count();
  run.title = file.title;
  run.input_file = file.path.string();
  run.input_sha256 = file.sha256;
  run.inputs = io::inputs_of(file.cases, file.path.parent_path());
  run.cases_total = static_cast<int>(file.cases.size());
  run.complete = file.cases.empty();
  return run;
}

std::vector<const io::Case*> solved_cases(const io::CaseFile& file, const io::RunResult& run) {
  std::vector<const io::Case*> out;
  auto c = file.cases.begin();
  for (const io::CaseResult& result : run.cases) {
    while (c->number != result.number) ++c;
    out.push_back(&*c);
  }
  return out;
}

void ResultNotes::add(const io::Case& given, const io::Case& c, io::CaseResult& result) {
  const auto* input = std::get_if<io::WheelRailCase>(&c.content);
  if (input == nullptr) return;
  const NoiseOfResults* noise = nullptr;
  {
    const std::lock_guard lock(mutex_);
    add_profile_doubts(given, profiles_, store_, doubted_, result);
    doubt_contact_beyond_data(*input, store_, result);
    doubt_contact_between_sections(*input, store_, result);
    const auto rail = store_.natural(input->rail, Body::rail, profile_radius(*input, Body::rail));
    const auto wheel = store_.natural(input->wheel, Body::wheel, profile_radius(*input, Body::wheel));
    noise = &pairs_.try_emplace({rail.get(), wheel.get()}, *rail, *wheel).first->second;  // maps leave them in place
  }
  noise->add(*input, result);
}

}  // namespace treadmark::app

// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#include "treadmark/app/surfaces/contact_files.hpp"

#include <fmt/format.h>

#include <cmath>
#include <map>

#include "treadmark/app/cases/wheelrail_case.hpp"
#include "treadmark/app/surfaces/convert_profile.hpp"
#include "treadmark/app/surfaces/profile_check.hpp"
#include "treadmark/app/surfaces/sampled_surfaces.hpp"
#include "treadmark/io/profiles/read_slices.hpp"
#include "treadmark/model/shape/body_name.hpp"

namespace treadmark::app {
namespace {

bool is_plain_file(const io::SurfaceSource& source) {
  bool whole =
      source.parts.empty() && source.crossing.part == io::CrossingInput::Part::none && source.offsets.file.empty();
  Defects::each(source.defects, [&](const char*, Body, const auto& all) { whole = whole && all.empty(); });
  const auto* file = std::get_if<io::GeometryFile>(&source.geometry);
  return whole && file != nullptr && (is_profile_file(file->file) || io::is_slices_file(file->file));
}

io::GeometryFile as_file(const std::filesystem::path& name) {
  io::GeometryFile file{name, {}};
  file.options.placement = io::ProfileOptions::Placement::reference;
  file.options.smoothing = {};
  file.options.mirror_z = -1;
  return file;
}

}  // namespace

std::vector<std::function<std::string()>> put_contact_files(io::CaseFile& file, const std::filesystem::path& output) {
  SurfaceStore store;
  std::map<const NaturalSurface*, io::GeometryFile> known;
  std::vector<std::function<std::string()>> writes;
  const SampledRegions regions = sampled_regions(file);
  for (io::Case& c : file.cases) {
    auto* input = std::get_if<io::WheelRailCase>(&c.content);
    if (input == nullptr) continue;
    for (const Body body : {Body::rail, Body::wheel}) {
      io::SurfaceSource& source = body == Body::wheel ? input->wheel : input->rail;
      if (is_plain_file(source)) continue;
      const auto natural = store.natural(source, body, profile_radius(*input, body));
      const auto [place, fresh] = known.try_emplace(natural.get());
      if (fresh) {
        const bool wheel = body == Body::wheel, same = natural->constant_profile();
        const std::filesystem::path name =
            output.parent_path() / fmt::format("{}_{}_{}.{}", output.stem().string(), body_name(body), known.size(),
                                               same ? (wheel ? "prw" : "prr") : (wheel ? "slcw" : "slcs"));
        const sampling::Region& r = wheel ? regions.wheel : regions.rail;
        ConvertSettings settings;
        if (!same && std::isfinite(r.u_min) && std::isfinite(r.u_max))
          (wheel ? settings.range_theta : settings.range_x) = {r.u_min, r.u_max};
        writes.emplace_back([natural, name, same, settings] {
          return fmt::format("{}: {}", name.string(),
                             same ? write_section(*natural, name) : write_surface(*natural, name, settings).kind);
        });
        place->second = as_file(name);
      }
      source.geometry = place->second;
      source.defects = {};
      source.offsets = {};
      source.crossing = {};
      source.parts.clear();
    }
  }
  return writes;
}

}  // namespace treadmark::app

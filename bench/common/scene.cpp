// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#include "treadmark/bench/common/scene.hpp"

#include <cstdio>
#include <map>
#include <tuple>
#include <variant>

#include "treadmark/app/bench/bench_case.hpp"
#include "treadmark/app/bench/check_surface.hpp"

namespace treadmark::bench {
namespace {

app::BenchScene make(Scene which) {
  io::CaseFile file = app::bench_case();
  auto& input = std::get<io::WheelRailCase>(file.cases.front().content);
  if (which == Scene::round) input.wheel.defects = input.rail.defects = {};
  return app::make_bench_scene(file, {0.2e-3, 40000});
}

Subject make(Scene which, Body body, std::string_view backend, double resolution) {
  const app::BenchScene& s = scene(which);
  const Region& region = body == Body::rail ? s.regions.rail : s.regions.wheel;
  Subject out{label(backend, resolution),
              represent(s.natural(body), {std::string(backend), resolution, region}).surface,
              &s.view(body),
              {}};
  out.refusal = app::check_surface(*out.surface, *out.view, resolution).reason;
  return out;
}

}  // namespace

const app::BenchScene& scene(Scene which) {
  static std::map<Scene, app::BenchScene> known;
  const auto found = known.find(which);
  return found != known.end() ? found->second : known.emplace(which, make(which)).first->second;
}

const Subject& subject(Scene which, Body body, std::string_view backend, double resolution) {
  static std::map<std::tuple<Scene, Body, std::string, double>, Subject> known;
  const std::tuple key(which, body, std::string(backend), resolution);
  const auto found = known.find(key);
  return found != known.end() ? found->second
                              : known.emplace(key, make(which, body, backend, resolution)).first->second;
}

detection::BodyPair bodies(Scene which, std::string_view backend, double resolution) {
  detection::BodyPair pair = scene(which).bodies;
  pair.rail = subject(which, Body::rail, backend, resolution).surface.get();
  pair.wheel = subject(which, Body::wheel, backend, resolution).surface.get();
  return pair;
}

std::string label(std::string_view backend, double resolution) {
  char text[32] = "";
  if (resolution > 0.0) std::snprintf(text, sizeof text, "/%gmm", 1e3 * resolution);
  return std::string(backend) + text;
}

}  // namespace treadmark::bench

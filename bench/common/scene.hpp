// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#pragma once

#include <memory>
#include <string>
#include <string_view>

#include "treadmark/app/bench/bench_scene.hpp"

namespace treadmark::bench {

/// Where the benchmarks take place. Everything here is made when it is first asked for, and once.
enum class Scene {
  damaged,  ///< a wheel with a flat on a rail with a squat: the case of `treadmark bench`
  round,    ///< the same wheel and rail without damage
};
const app::BenchScene& scene(Scene which);

/// One body of a scene in one representation.
struct Subject {
  std::string name;  ///< "mesh/0.5mm"
  std::shared_ptr<const Surface> surface;
  const app::BenchView* view = nullptr;
  std::string refusal;  ///< why its heights must not be measured; empty if they agree
};

/// resolution [m]; 0 = as given. The heights have been checked, level and tilted.
const Subject& subject(Scene which, Body body, std::string_view backend, double resolution);

/// Both bodies in one representation, placed in contact.
detection::BodyPair bodies(Scene which, std::string_view backend, double resolution);

/// "mesh/0.5mm", "analytic".
std::string label(std::string_view backend, double resolution);

}  // namespace treadmark::bench

// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#pragma once

#include <span>
#include <vector>

#include "treadmark/app/surfaces/sample_body.hpp"
#include "treadmark/app/surfaces/surface_store.hpp"
#include "treadmark/backends/conformance/promises.hpp"
#include "treadmark/backends/sampling/region.hpp"
#include "treadmark/io/cases/case_model.hpp"
#include "treadmark/io/results/result_model.hpp"

namespace treadmark::app {

/// Wheel and rail of a case; surfaces are those of a right-hand pair.
struct UsedBodies {
  UsedBody wheel, rail;
  bool left = false;
};

/// Every distinct surface once, sampled where the cases have their contacts (see sample_body), as the mirror image for
/// left-hand pairs; the cases get its name. used: one a case. A surface that cannot be sampled is left out, and so are
/// cases without poses.
std::vector<io::SampledSurface> sample_surfaces(std::span<io::CaseResult> cases, std::span<const UsedBodies> used);

/// The bodies of the cases of a file that are in these results. The store must be the one that the cases were solved
/// with.
std::vector<UsedBodies> used_bodies(const io::CaseFile& file, std::span<const io::CaseResult> cases,
                                    SurfaceStore& store);

/// Adds what a report draws to the results of run_cases: run.sampled, and the names in its cases. Takes some 0.1 s a
/// surface.
void add_surfaces(io::RunResult& run, const io::CaseFile& file, SurfaceStore& store);

/// The parts of wheel and rail that the cases of a file can bring into contact: what has to be sampled.
struct SampledRegions {
  sampling::Region wheel, rail;
};

/// Of cases that come one by one.
class RegionsOfCases {
 public:
  void add(const io::WheelRailCase& input);
  SampledRegions regions() const;

 private:
  /// Grows to hold the interval round a value.
  struct Interval {
    double low = 0.0, high = 0.0;
    bool any = false;
    void include(double middle, double half);
  };
  Interval theta_, x_;
};

/// Whether a body is in a representation that is made from samples.
bool is_sampled(const io::SurfaceSource& source);

/// Wheel: angles round the lowest point of every case, as far as the contact search looks; from half a turn on the
/// whole wheel. Rail: positions along the track likewise. Without a wheel-rail case everything.
SampledRegions sampled_regions(const io::CaseFile& file);

/// What has to be sampled for one of the cases: as for all of them, but of a body in a representation that is made for
/// one place (Backend::one_place) only what this case needs.
SampledRegions regions_of(const io::WheelRailCase& input, const SampledRegions& all);

/// The wheel or rail of a case, which the store holds from then on, as it is held to promises in brief. region: what is
/// sampled of it. Errors: those of the store.
conformance::Subject seen_body(const io::WheelRailCase& input, SurfaceStore& store, Body body, const Region& region);

/// Wheel and rail of the first case of a file, held to every promise that needs no formula. Errors: those of the store;
/// Error(configuration) without such a case.
conformance::Record hold_case(const io::CaseFile& file);

/// Errors: Error(configuration) for a representation that is made for one place, where what says takes in many.
void refuse_one_place(const io::SurfaceSource& source, const char* what);

}  // namespace treadmark::app

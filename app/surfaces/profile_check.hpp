// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#pragma once

#include <filesystem>
#include <map>
#include <memory>
#include <optional>
#include <string>
#include <tuple>
#include <utility>
#include <vector>

#include "treadmark/analysis/measures/section.hpp"
#include "treadmark/app/surfaces/surface_store.hpp"
#include "treadmark/io/cases/case_model.hpp"
#include "treadmark/io/profiles/judge_profile.hpp"
#include "treadmark/io/results/result_model.hpp"
#include "treadmark/model/shape/slices.hpp"

namespace treadmark::app {

struct CheckedProfile {
  std::string name;  ///< "wheel profile FILE"
  Body body = Body::rail;
  io::ProfileJudgement judgement;
};

/// Whether the name is that of a profile file, not of a case.
bool is_profile_file(const std::filesystem::path& file);

/// Reads and judges one file. Without a body it is judged by extension, then by shape. Errors as read_profile;
/// Error(configuration) where the file could be either.
CheckedProfile check_profile(const std::filesystem::path& file, std::optional<Body> body,
                             const io::ProfileOptions& options = {}, const io::ExpectedProfile& expected = {});

/// As JSON: "body", "facts" and "warnings" as pairs of texts, "notes". Thread-safe.
std::string profile_check_json(const CheckedProfile& profile);

/// What is doubtful about a profile by itself, wherever it is to be placed. Never throws; thread-safe.
std::vector<io::ProfileRemark> doubts_of(const io::SourcedProfile& profile);

/// A standard profile beside a section: metal that is missing, and metal that should not be there [m^2].
struct FittingStandard {
  std::string name;
  double lost = 0.0, gained = 0.0;
  /// What no wear explains counts more.
  double badness() const { return lost + 20.0 * gained; }
};

/// The standard profile that a section fits best, laid upon it by what does not wear; as_new: only those that have its
/// head's width and crown, which is quick. Nothing where none can be laid upon it. Thread-safe.
std::optional<FittingStandard> fitting_standard(const measures::Section& section, bool as_new);

/// What a file of a profile is by its shape, where neither its name nor the library says so; nothing for files that
/// cannot be read so, and for all others.
std::optional<Body> body_by_shape(const std::filesystem::path& file);

/// The same for every profile file that the cases of a file use, each once. Errors as read_profile.
std::vector<CheckedProfile> check_profiles(const io::CaseFile& file);

/// Slices lie as they are in their file: what some of them agree in shows whether that is the place of a wheel or rail,
/// and whether their points scatter. Nothing where nothing is doubtful. Never throws; thread-safe.
std::optional<io::ProfileRemark> remark_on_slices(const SliceSet& slices, Body body,
                                                  const io::ExpectedProfile& expected);

/// The same in words, with the file; empty where nothing is doubtful.
std::string doubt_of_slices(const SliceSet& slices, const std::string& file, Body body,
                            const io::ExpectedProfile& expected);

/// What imports of scans doubted of the files that a wheel or rail, or its parts, are made from, in words, each once.
/// Errors: those of files of offsets.
std::vector<std::string> import_doubts(const io::SurfaceSource& source, Body body);
std::vector<std::string> import_doubts(const std::filesystem::path& file, Body body);
/// Of all wheels and rails of the cases.
std::vector<std::string> import_doubts(const io::CaseFile& file);

/// The doubts about the files of profiles, slices or imported scans behind a wheel or rail. Errors as read_profile and
/// read_slices, and as above.
std::vector<std::string> source_doubts(const io::SurfaceSource& source, Body body, const io::ExpectedProfile& expected);

/// One use of a file: the same file may be turned or scaled otherwise elsewhere.
struct ProfileUse {
  io::GeometryFile file;
  Body body;
  io::ExpectedProfile expected;
  SourcePosition where;
};

/// The profile files of a run, each use once, without their nearest standard profiles.
using ProfilesOfRun = std::vector<std::pair<ProfileUse, CheckedProfile>>;

/// Errors as read_profile.
ProfilesOfRun check_profiles_of_run(const io::CaseFile& file);

/// Their doubts and notes as notes of a run.
std::vector<std::string> profile_doubts(const ProfilesOfRun& profiles);

/// What slices and imported scans are doubted for, by surface, whether the track has a gauge, and cant.
using SurfaceDoubts =
    std::map<std::tuple<std::shared_ptr<const NaturalSurface>, bool, std::optional<double>>, std::vector<std::string>>;

/// The doubts of check_profiles and import_doubts as remarks on the result of a case; those that a contact has remarks
/// of its own for are left to it.
/// store: of the surfaces of the run; slices are judged by one in their middle. known: what was found before.
void add_profile_doubts(const io::Case& given, const ProfilesOfRun& profiles, SurfaceStore& store, SurfaceDoubts& known,
                        io::CaseResult& result);

}  // namespace treadmark::app

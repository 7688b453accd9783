// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#include "treadmark/app/simulation/run_study.hpp"

#include <atomic>
#include <chrono>
#include <cstdlib>
#include <exception>
#include <mutex>
#include <thread>

#include <fmt/format.h>

#include "treadmark/app/assessment/assessment_outputs.hpp"
#include "treadmark/app/simulation/case_run.hpp"
#include "treadmark/app/simulation/file_lock.hpp"
#include "treadmark/app/simulation/result_head.hpp"
#include "treadmark/app/simulation/run_simulation.hpp"
#include "treadmark/app/simulation/study_figures.hpp"
#include "treadmark/app/simulation/study_identity.hpp"
#include "treadmark/app/version.hpp"
#include "treadmark/core/cancellation.hpp"
#include "treadmark/core/error.hpp"
#include "treadmark/core/output_file.hpp"
#include "treadmark/core/platform/ranges.hpp"
#include "treadmark/io/files/text.hpp"
#include "treadmark/io/histories/simulation_store.hpp"
#include "treadmark/io/histories/study_store.hpp"
#include "treadmark/io/simulations/read_study.hpp"

namespace treadmark::app {
namespace {

namespace fs = std::filesystem;

constexpr const char* kIdentityFile = "study.id";
constexpr const char* kLockFile = "lock";
constexpr auto kPoll = std::chrono::milliseconds(200);

constexpr const char* kStore = "simulation.h5";
constexpr const char* kCheckpoint = "unfinished.h5";

fs::path folder_of(const fs::path& folder, const io::StudyRun& run) {
  return folder / "runs" / fmt::format("run_{:04}", run.number);
}

/// The HDF5 library is for one thread at a time.
std::mutex& store_mutex() {
  static std::mutex mutex;
  return mutex;
}

class Workers {
 public:
  Workers(const io::StudyFile& study, const StudyOptions& options, const Progress& progress)
      : study_(study), options_(options), progress_(progress), tables_(options.cache), finished_(study.runs.size(), 0) {
    for (std::size_t i = 0; i < study.runs.size(); ++i)
      if (found_finished(i)) finished_[i] = 1;
    found_ = static_cast<std::size_t>(ranges::count(finished_, 1));
  }

  std::size_t found() const { return found_; }
  bool complete() const { return ranges::count(finished_, 1) == static_cast<std::ptrdiff_t>(finished_.size()); }

  void work() {
    if (options_.workers < 1) return;
    std::vector<std::thread> threads;
    const auto guarded = [this] {
      try {
        work_through();
      } catch (...) {
        const std::lock_guard lock(mutex_);
        if (!error_) error_ = std::current_exception();
        stop_ = true;
      }
    };
    for (int i = 1; i < options_.workers; ++i) threads.emplace_back(guarded);
    guarded();
    for (std::thread& t : threads) t.join();
    if (error_) std::rethrow_exception(error_);
  }

 private:
  fs::path store_of(std::size_t i) const { return folder_of(options_.folder, study_.runs[i]) / kStore; }
  fs::path checkpoint_of(std::size_t i) const { return folder_of(options_.folder, study_.runs[i]) / kCheckpoint; }
  bool is_finished(std::size_t i) const { return fs::exists(store_of(i)); }
  /// The same, and removes the checkpoint if whoever finished it could not.
  bool found_finished(std::size_t i) const {
    if (!is_finished(i)) return false;
    std::error_code ignored;
    fs::remove(checkpoint_of(i), ignored);
    return true;
  }
  bool stopped() const { return stop_ || progress_.stop_requested(); }

  void work_through() {
    SurfaceStore surfaces;
    while (!stopped()) {
      bool worked = false, left = false;
      for (std::size_t i = 0; i < study_.runs.size() && !stopped(); ++i) {
        if (known_finished(i)) continue;
        left = true;
        worked = solve(i, surfaces) || worked;
      }
      if (!left) return;
      // Others work on the rest; they may die.
      if (!worked) std::this_thread::sleep_for(kPoll);
    }
  }

  bool known_finished(std::size_t i) {
    const std::lock_guard lock(mutex_);
    if (!finished_[i] && found_finished(i)) note_finished(i);
    return finished_[i] != 0;
  }

  void note_finished(std::size_t i) {
    finished_[i] = 1;
    if (progress_.report)
      progress_.report(static_cast<std::size_t>(ranges::count(finished_, 1)), finished_.size(),
                       label_of(study_, study_.runs[i]));
  }

  /// False: somebody else is at it.
  bool solve(std::size_t i, SurfaceStore& surfaces) {
    const io::StudyRun& run = study_.runs[i];
    const fs::path folder = folder_of(options_.folder, run);
    make_folder(folder);
    const auto lock = FileLock::attempt(folder / kLockFile);
    if (!lock) return false;
    if (is_finished(i)) return true;
    remove_leftovers(folder);
    const auto input = io::read_study_run(study_, run);
    SimulationOptions wanted;
    wanted.settings = run.overrides;
    wanted.swept = swept_of(study_, run);
    wanted.checkpoint_file = checkpoint_of(i);
    wanted.store_mutex = &store_mutex();
    wanted.tables = &tables_;
    Progress inner;
    inner.stop = progress_.stop;
    io::SimulationResult result;
    if (const auto* simulation = std::get_if<io::SimulationFile>(&input)) {
      try {
        result = run_simulation(*simulation, surfaces, wanted, inner);
      } catch (const Cancelled&) {
        return true;
      } catch (const Error& e) {
        if (e.kind() != ErrorKind::numerical) throw;
        result = result_head(*simulation, wanted);
        result.status = "failed";
        result.message = e.what();
      }
    } else {
      result = run_case_file(std::get<io::CaseFile>(input), surfaces, wanted, inner);
    }
    if (result.status == "interrupted") return true;
    if (const auto* simulation = std::get_if<io::SimulationFile>(&input))
      if (const auto assessed = assess_own(std::make_shared<io::SimulationResult>(result), simulation->assessment))
        write_assessment_folder(folder, std::span(&*assessed, 1), {});
    {
      const std::lock_guard store(store_mutex());
      io::write_simulation(store_of(i), result);
    }
    std::error_code ignored;
    fs::remove(wanted.checkpoint_file, ignored);
    const std::lock_guard guard(mutex_);
    if (!finished_[i]) note_finished(i);
    return true;
  }

  const io::StudyFile& study_;
  const StudyOptions& options_;
  const Progress& progress_;
  std::mutex mutex_;
  ContactTables tables_;
  std::vector<char> finished_;
  std::size_t found_ = 0;
  std::atomic<bool> stop_{false};
  std::exception_ptr error_;
};

/// The folder belongs to this study from here on.
void claim_folder(const io::StudyFile& study, const StudyOptions& options) {
  const fs::path file = options.folder / kIdentityFile;
  if (options.must_exist && !fs::exists(file))
    throw Error(ErrorKind::configuration, options.folder.string() + " holds no study to go on with", {},
                "leave --resume out to begin one");
  make_folder(options.folder / "runs");
  const FileLock lock = FileLock::wait(options.folder / kLockFile);
  if (!fs::exists(file))
    write_file(file, study_identity(study));
  else if (!same_study(io::profiles::read_text(file, "study", {}), study_identity(study, options.share), options.share))
    throw Error(ErrorKind::configuration, options.folder.string() + " holds the results of another study", {},
                "choose another folder, or remove this one; runs, files, settings and build of Treadmark must be the "
                "same to go on");
}

io::StudyResult gather(const io::StudyFile& study, const StudyOptions& options) {
  io::StudyResult result;
  result.version = version();
  result.git = git_revision();
  result.input_file = study.path.filename().string();
  result.input_sha256 = study.sha256;
  result.inputs = io::inputs_of(study);
  result.title = study.title;
  result.settings = options.settings;
  for (const io::Variation& v : study.variations)
    if (!v.key.empty() && !v.label.empty()) result.labels.emplace_back(v.key, v.label);
  for (const io::StudyRun& run : study.runs) {
    const fs::path store = folder_of(options.folder, run) / kStore;
    if (!fs::exists(store)) continue;
    const std::lock_guard lock(store_mutex());
    const io::SimulationResult simulation = io::read_simulation_head(store);
    result.runs.push_back({run.number, swept_of(study, run), label_of(study, run), simulation.status,
                           simulation.message, simulation.summary, store});
  }
  return result;
}

}  // namespace

StudyOutcome run_study(const io::StudyFile& study, const StudyOptions& options, const Progress& progress) {
  check_study_figures(study);
  io::StudyFile share = study;
  std::erase_if(share.runs, [&](const io::StudyRun& run) { return !options.share.has(run); });
  if (share.runs.empty())
    throw Error(ErrorKind::configuration,
                fmt::format("the study has no run {}: its runs are 1 to {}", options.share.first, study.runs.size()));
  claim_folder(study, options);
  StudyOutcome outcome;
  outcome.runs_total = share.runs.size();
  Workers workers(share, options, progress);
  outcome.found_finished = workers.found();
  workers.work();
  outcome.complete = workers.complete();
  outcome.study = gather(share, options);
  return outcome;
}

StudyState study_state(const io::StudyFile& study, const fs::path& folder) {
  StudyState state;
  state.written = fs::exists(folder / "sweep.csv") && fs::exists(folder / "sweep.h5");
  for (const io::StudyRun& run : study.runs) {
    const fs::path place = folder_of(folder, run);
    auto& runs = fs::exists(place / kStore)                                               ? state.finished
                 : fs::exists(place / kLockFile) && !FileLock::attempt(place / kLockFile) ? state.solved_now
                 : fs::exists(place / kCheckpoint)                                        ? state.interrupted
                                                                                          : state.not_begun;
    runs.push_back(run.number);
  }
  return state;
}

void write_study_folder(const io::StudyFile& file, const StudyOptions& options, const io::StudyResult& study) {
  const FileLock lock = FileLock::wait(options.folder / kLockFile);
  // The runs are those of this study file; what was written of them may belong to an earlier version of its figures and
  // titles.
  const fs::path marker = options.folder / "written.id";
  std::string written = file.sha256;
  for (const std::string& setting : options.settings) written += '\n' + setting;
  std::vector<fs::path> outputs{"sweep.csv", "sweep.h5"};
  for (const io::StudyFigure& figure : file.figures) outputs.push_back(figure.file);
  const bool all_there =
      ranges::all_of(outputs, [&](const fs::path& name) { return fs::exists(options.folder / name); });
  if (all_there && fs::exists(marker) && io::profiles::read_text(marker, "study", {}) == written) return;
  remove_leftovers(options.folder);
  io::write_sweep_csv(options.folder / "sweep.csv", study);
  io::write_study_store(options.folder / "sweep.h5", study);
  write_study_figures(file, options.folder, study);
  write_file(marker, written);
}

ProcessPlace process_place() {
  const auto number = [](std::initializer_list<const char*> names, int otherwise) {
    for (const char* name : names)
      if (const char* text = std::getenv(name)) return std::atoi(text);
    return otherwise;
  };
  ProcessPlace place;
  place.count = number({"OMPI_COMM_WORLD_SIZE", "PMI_SIZE", "SLURM_STEP_NUM_TASKS"}, 1);
  place.rank = number({"OMPI_COMM_WORLD_RANK", "PMI_RANK", "SLURM_PROCID"}, 0);
  return place;
}

}  // namespace treadmark::app

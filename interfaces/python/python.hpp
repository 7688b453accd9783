// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#pragma once

#include <pybind11/pybind11.h>
#include <pybind11/stl.h>
#include <pybind11/stl/filesystem.h>

#include <atomic>
#include <exception>
#include <filesystem>
#include <memory>
#include <mutex>
#include <optional>
#include <string>
#include <utility>
#include <variant>
#include <vector>

#include "treadmark/app/surfaces/surface_store.hpp"
#include "treadmark/core/cancellation.hpp"
#include "treadmark/core/parallel.hpp"
#include "treadmark/core/progress.hpp"
#include "treadmark/interfaces/c/calls.hpp"
#include "treadmark/interfaces/c/handles.hpp"
#include "treadmark/io/cases/case_model.hpp"
#include "treadmark/io/results/result_model.hpp"

/// Texts may hold bytes of file names and files that are no UTF-8.
template <>
struct pybind11::detail::type_caster<std::string> : string_caster<std::string> {
  static handle cast(const std::string& text, return_value_policy, handle) {
    const handle made = PyUnicode_DecodeUTF8(text.data(), static_cast<ssize_t>(text.size()), "replace");
    if (!made) throw error_already_set();
    return made;
  }
};

// What stands behind the module _treadmark: the functions of treadmark.h and of app/ with Python's objects around them.
// What is said for users of Python stands in the package treadmark.

namespace treadmark::python {

namespace py = pybind11;
using Strings = std::vector<std::string>;

/// Does a call of treadmark.h. Errors: what that caught, as it was.
template <class Call>
void check(Call&& call) {
  struct Keeper {
    std::exception_ptr caught;
    std::exception_ptr* before = c::keep_caught(&caught);
    ~Keeper() { c::keep_caught(before); }
  } keeper;
  if (call() > TM_FAILED) std::rethrow_exception(std::move(keeper.caught));
}

/// Deletes what a call of treadmark.h made.
struct Free {
  void operator()(tm_case* c) const { tm_case_free(c); }
  void operator()(tm_surface* s) const { tm_surface_free(s); }
  void operator()(tm_pair* p) const { tm_pair_free(p); }
  void operator()(tm_state* s) const { tm_state_free(s); }
  void operator()(tm_patch* p) const { tm_patch_free(p); }
  void operator()(tm_solution* s) const { tm_solution_free(s); }
  void operator()(tm_contact_table* t) const { tm_table_free(t); }
};
template <class Handle>
using Owned = std::unique_ptr<Handle, Free>;

/// What make(Handle** out) -> tm_status makes.
template <class Handle, class Make>
Owned<Handle> made(Make&& make) {
  Handle* out = nullptr;
  check([&] { return make(&out); });
  return Owned<Handle>(out);
}

/// While it lives Ctrl-C ends the work of Python's main thread at its next check point; Python's own handler is called,
/// too. On other threads it does nothing. Innermost first, with the GIL.
class CatchInterrupt {
 public:
  /// stop: set, beside the flag of calls of treadmark.h.
  explicit CatchInterrupt(std::atomic<bool>& stop);
  ~CatchInterrupt();
  CatchInterrupt(const CatchInterrupt&) = delete;
  CatchInterrupt& operator=(const CatchInterrupt&) = delete;

 private:
  struct Kept;
  std::unique_ptr<Kept> kept_;
};

/// Does work(stop) without the GIL, so that other threads of Python go on. Errors: those of the work; Python's
/// KeyboardInterrupt (or what its handler throws) in place of Cancelled.
template <class Work>
auto released(std::atomic<bool>& stop, Work&& work) {
  try {
    const CatchInterrupt guard(stop);
    const py::gil_scoped_release free;
    const CancellationScope scope(&stop);
    return work();
  } catch (const Cancelled&) {
    if (PyErr_CheckSignals() != 0) throw py::error_already_set();
    throw;
  }
}
template <class Work>
auto released(Work&& work) {
  std::atomic<bool> stop{false};
  return released(stop, std::forward<Work>(work));
}

/// Does work(Progress) so, on so many threads (0: all). progress: None or callable(finished, total, what); where that
/// returns False the work ends early, and where it raises, its exception is what the call ends with.
template <class Work>
auto with_progress(const py::object& progress, int threads, Work&& work) {
  std::atomic<bool> stop{false};
  std::exception_ptr raised;
  Progress report;
  report.stop = &stop;
  if (!progress.is_none())
    report.report = [&](std::size_t finished, std::size_t total, const std::string& what) {
      const py::gil_scoped_acquire held;
      try {
        if (progress(finished, total, what).is(py::bool_(false))) stop = true;
      } catch (...) {
        if (!raised) raised = std::current_exception();
        stop = true;
      }
    };
  const auto raise = [&] {
    if (raised) std::rethrow_exception(std::exchange(raised, nullptr));
    if (PyErr_CheckSignals() != 0) throw py::error_already_set();
  };
  try {
    const CatchInterrupt guard(stop);
    auto result = [&] {
      const py::gil_scoped_release free;
      const ThreadLimit limit(threads);
      return work(report);
    }();
    raise();
    return result;
  } catch (const Cancelled&) {
    raise();
    throw;
  }
}

/// Held while files of HDF5 are read and written: its library may not be thread-safe. Without the GIL.
std::mutex& file_mutex();
template <class Work>
auto with_files(Work&& work) {
  const py::gil_scoped_release free;
  const std::lock_guard lock(file_mutex());
  return work();
}

/// A read-only array over numbers that owner keeps alive; strides in bytes. item: 'd', 'B' or 'f' as in NumPy.
py::object view(const void* data, char item, const std::vector<py::ssize_t>& shape,
                const std::vector<py::ssize_t>& strides, const py::object& owner);
/// The same over a whole vector; C order.
template <class Number>
py::object view(const std::vector<Number>& values, char item, const std::vector<py::ssize_t>& shape,
                const py::object& owner) {
  std::vector<py::ssize_t> strides(shape.size());
  py::ssize_t step = sizeof(Number);
  for (std::size_t i = shape.size(); i-- > 0; step *= shape[i]) strides[i] = step;
  return view(values.data(), item, shape, strides, owner);
}

/// Something in C++ that lives as long as views of it.
template <class T>
py::object owner_of(std::shared_ptr<T> owned) {
  return py::capsule(new std::shared_ptr<T>(std::move(owned)),
                     [](void* kept) { delete static_cast<std::shared_ptr<T>*>(kept); });
}

/// A case in C++, which lives as long as views of it.
struct Solved {
  std::shared_ptr<const io::CaseResult> result;
};
/// A case as the package's records take it apart: its numbers by name in SI, its patches with their fields as views.
py::dict to_python(std::shared_ptr<const io::CaseResult> shared);
/// Cases that live as long as holder.
py::list to_python(const std::shared_ptr<const void>& holder, const std::vector<io::CaseResult>& results);

/// What a verb is given: a file, or the text of one in a folder.
struct Source {
  std::filesystem::path file;  ///< of a text: a name in its folder, for messages
  std::optional<std::string> text;
  Strings overrides;
};
/// Errors: Error(configuration) for other kinds of files.
io::CaseFile cases_of(const Source& source);

/// What differs between cases: a name and a value a case. Numbers are in SI by their names, else TOML by the key.
using Varied = std::vector<std::pair<std::string, std::vector<std::variant<double, std::string>>>>;

/// A run, for files and pictures of it.
struct Run {
  std::shared_ptr<io::RunResult> result;
  Strings notes;
  /// What it was made from, until surfaces for pictures are sampled; null: they are as they are.
  std::shared_ptr<std::pair<io::CaseFile, app::SurfaceStore>> made_from;
  Varied varied = {};

  /// The result with the surfaces that pictures show.
  io::RunResult& whole();
};

/// Of other sources of this folder, or of without_<part>.cpp: what they add to the module.
void add_handles(py::module_& module);
void add_results(py::module_& module);
void add_verbs(py::module_& module);
void add_requests(py::module_& module);
void add_backends(py::module_& module);
void add_simulations(py::module_& module);
void add_tables(py::module_& module);
void add_scans(py::module_& module);
void add_pages(py::module_& module);

}  // namespace treadmark::python

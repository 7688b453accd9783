// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <new>
#include <optional>
#include <shared_mutex>
#include <thread>

#include "treadmark/app/version.hpp"
#include "treadmark/core/cancellation.hpp"
#include "treadmark/core/parallel.hpp"
#include "treadmark/interfaces/contact/calls.hpp"
#include "treadmark/interfaces/contact/input_file.hpp"
#include "treadmark/interfaces/contact/log.hpp"

namespace treadmark::contact {
namespace {

constexpr int kInterfaceVersion = 2520;  // that callers ask for
constexpr int kHighestElement = 999, kMostPatches = 9;
constexpr std::size_t kMostElements = 100;

struct Element {
  int module = 0;
  std::map<int, std::shared_ptr<Problem>> problems;  ///< by number; of module 1 one, -1
};

struct Library {
  std::shared_mutex mutex;
  bool started = false;
  Folders folders;
  int detail = 0, threads = 1;
  std::optional<ThreadLimit> limit;
  std::map<int, Element> elements;
};

Library& library() {
  static Library& one = *new Library;  // lives as long as threads that may still call
  return one;
}

int cores() { return std::max(1, static_cast<int>(std::thread::hardware_concurrency())); }

void limit_threads(Library& l) {
  l.limit.reset();
  l.limit.emplace(l.threads < 0 ? 0 : std::clamp(l.threads, 1, cores()));
}

std::string as_folder(std::string name) {
  std::replace(name.begin(), name.end(), '\\', '/');
  if (name.size() > 1 && name.back() != '/') name += '/';
  return name;
}

void start(Library& l, bool screen, const std::string& work, const std::string& out, std::string name) {
  std::replace(name.begin(), name.end(), '\\', '/');
  std::string before;
  if (const std::size_t slash = name.rfind('/'); slash != std::string::npos) {
    before = name.substr(0, slash + 1);
    name = name.substr(slash + 1);
  }
  l.folders = {work.empty() ? before : as_folder(work), as_folder(out), name.empty() ? "contact_addon" : name};
  l.started = true;
  open_log(l.folders.out + l.folders.name + ".out", screen);
  set_log_detail(l.detail);
  limit_threads(l);
  warn(fmt::format("Treadmark {} ({}) in place of CONTACT's library version, interface {}", app::version(),
                   app::git_revision(), kInterfaceVersion));
}

void stop(Library& l) {
  l.elements.clear();
  l.started = false;
  l.folders = {};
  l.limit.reset();
  l.detail = 0;
  l.threads = 1;
  close_input();
  close_log();
}

int module_of(const Library& l, int ire, int icp) {
  const auto found = l.elements.find(ire);
  return found != l.elements.end() ? found->second.module : icp <= 0 ? 1 : 3;
}

void check_use(int module, int icp, For what) {
  const bool for_basic = what == For::basic,
             for_rail = what == For::rail || what == For::rail_patch || what == For::rail_any;
  if (module == 3) {
    if (icp < 1 || icp > kMostPatches)
      throw Refusal{bad_patch, fmt::format("there is no contact problem {}, they are 1 to {}", icp, kMostPatches)};
    if (for_rail) throw Refusal{not_for_basic, "the function is not for basic contact (module 3)"};
    return;
  }
  if (for_basic) throw Refusal{not_for_rail, "the function is not for a wheel on a rail (module 1)"};
  if (icp != kWholeWheel && (icp < 1 || icp > kMostPatches))
    throw Refusal{bad_patch, fmt::format("there is no patch {}, they are 1 to {}, or -1", icp, kMostPatches)};
  if (icp == kWholeWheel && (what == For::rail_patch || what == For::patch))
    throw Refusal{no_patch, "the number of a patch is needed, -1 was given"};
  if (icp != kWholeWheel && (what == For::rail || what == For::whole))
    throw Refusal{not_of_patch, "for a wheel on a rail (module 1) the function takes -1 only"};
}

std::shared_ptr<Problem> find(Library& l, int ire, int module, int number) {
  const auto element = l.elements.find(ire);
  if (element == l.elements.end() || element->second.module != module) return nullptr;
  const auto problem = element->second.problems.find(number);
  return problem == element->second.problems.end() ? nullptr : problem->second;
}

/// The mutex is held.
std::shared_ptr<Problem> find_or_make(Library& l, int ire, int module, int number) {
  if (!l.elements.contains(ire) && l.elements.size() >= kMostElements)
    throw Refusal{CNTC_err_icp, fmt::format("there are {} result elements already", kMostElements)};
  Element& element = l.elements[ire];
  element.module = module;
  auto& problem = element.problems[number];
  if (!problem) problem = std::make_shared<Problem>(ire, number, module);
  return problem;
}

}  // namespace

Folders folders() {
  Library& l = library();
  const std::shared_lock lock(l.mutex);
  return l.folders;
}

void start_if_needed() {
  Library& l = library();
  {
    const std::shared_lock lock(l.mutex);
    if (l.started) return;
  }
  const std::unique_lock lock(l.mutex);
  if (!l.started) start(l, false, {}, {}, {});
}

Active activate(const int* ire, const int* icp, For what, bool wanted_lock) {
  start_if_needed();
  const int element = need(ire, "ire"), number = what == For::rail ? kWholeWheel : need(icp, "icp");
  if (element < 1 || element > kHighestElement)
    throw Refusal{bad_element,
                  fmt::format("there is no result element {}, they are 1 to {}", element, kHighestElement)};
  Library& l = library();
  int module = 0;
  std::shared_ptr<Problem> problem;
  {
    const std::shared_lock lock(l.mutex);
    module = module_of(l, element, number);
    check_use(module, number, what);
    problem = find(l, element, module, module == 1 ? kWholeWheel : number);
  }
  if (!problem) {
    const std::unique_lock lock(l.mutex);
    module = module_of(l, element, number);
    check_use(module, number, what);
    problem = find_or_make(l, element, module, module == 1 ? kWholeWheel : number);
  }
  std::unique_lock<std::mutex> held(problem->mutex, std::defer_lock);
  if (wanted_lock) held.lock();
  Problem& same = *problem;
  return {std::move(problem), std::move(held), same, module == 3 ? 0 : number < 1 ? -1 : number - 1};
}

const io::PatchResult* patch_result(const Problem& problem, int patch) {
  if (!problem.result || patch < 0 || static_cast<std::size_t>(patch) >= problem.result->patches.size()) return nullptr;
  return &problem.result->patches[static_cast<std::size_t>(patch)];
}

const io::PatchResult& Active::result() const {
  if (const io::PatchResult* found = patch_result(problem, patch)) return *found;
  throw Refusal{CNTC_err_icp, fmt::format("there are no results of patch {}", patch + 1)};
}

int caught(const char* function) noexcept {
  const auto said = [&](int code, const char* what) {
    try {
      warn(fmt::format("ERROR {} in {}: {}", code, function, what));
    } catch (...) {
      warn("ERROR: there is not enough memory for a message");
    }
    return code;
  };
  try {
    throw;
  } catch (const Refusal& refusal) {
    return said(refusal.code, refusal.message.c_str());
  } catch (const std::bad_alloc&) {
    return said(CNTC_err_other, "there is not enough memory");
  } catch (const std::exception& error) {
    return said(CNTC_err_other, error.what());
  } catch (...) {
    return said(CNTC_err_other, "an unknown error");
  }
}

double number(const double* given, const char* name) {
  const double value = need(given, name);
  require_finite({&value, 1}, name);
  return value;
}

void require_finite(std::span<const double> values, const char* name) {
  for (const double value : values)
    if (!std::isfinite(value)) throw Refusal{CNTC_err_icp, fmt::format("{} is not finite", name)};
}

std::string text(const char* bytes, const int* length, const char* name) {
  const std::span<const char> given = array(bytes, length, name);
  std::string out(given.begin(), std::find(given.begin(), given.end(), '\0'));
  out.erase(out.find_last_not_of(' ') + 1);
  return out;
}

void set_global_flags(std::span<const int> codes, std::span<const int> values) {
  Library& l = library();
  const std::unique_lock lock(l.mutex);
  for (std::size_t i = 0; i < codes.size() && i < values.size(); ++i) switch (codes[i]) {
      case 0:
      case CNTC_if_licdbg:
        break;
      case CNTC_if_idebug:
        l.detail = values[i];
        set_log_detail(l.detail);
        break;
      case CNTC_if_openmp:
        l.threads = values[i];
        if (l.started) limit_threads(l);
        break;
      default:
        warn(fmt::format("WARNING: {} is no global flag", codes[i]));
    }
}

namespace {

/// What is asked once only: folders and name of the log.
void first(int* ifcver, int* ierror, const int* ioutput, const std::string& work, const std::string& out,
           const std::string& name) {
  Library& l = library();
  const std::unique_lock lock(l.mutex);
  if (!l.started) start(l, ioutput != nullptr && *ioutput == 1, work, out, name);
  put(ifcver, kInterfaceVersion);
  put(ierror, 0);
}

void initialize(int ire, int module) {
  Library& l = library();
  const std::unique_lock lock(l.mutex);
  if (ire < 1 || ire > kHighestElement) throw Refusal{CNTC_err_icp, fmt::format("there is no result element {}", ire)};
  if (module != 1 && module != 3) throw Refusal{CNTC_err_icp, fmt::format("there is no module {}", module)};
  if (const auto found = l.elements.find(ire); found != l.elements.end()) {
    warn(fmt::format("WARNING: result element {} is there already, for module {}", ire, found->second.module));
    return;
  }
  if (module == 1) {
    find_or_make(l, ire, module, kWholeWheel);
    return;
  }
  if (l.elements.size() >= kMostElements)
    throw Refusal{CNTC_err_icp, fmt::format("there are {} result elements already", kMostElements)};
  l.elements[ire].module = module;
}

void finalize(int ire) {
  Library& l = library();
  const std::unique_lock lock(l.mutex);
  if (l.elements.erase(ire) == 0) {
    warn(fmt::format("WARNING: there is no result element {} to finalise", ire));
    return;
  }
  if (l.elements.empty()) stop(l);
}

}  // namespace
}  // namespace treadmark::contact

namespace contact = treadmark::contact;

void cntc_setfileunits(int*, int*) {}  // of Fortran, which has no part in this

void cntc_initializefirst(int* ifcver, int* ierror, int* ioutput, const char* wrkdir, const char* outdir,
                          const char* expnam, int* len_wrkdir, int* len_outdir, int* len_expnam) {
  contact::guarded("cntc_initializefirst", ierror, [&] {
    using contact::text;
    contact::first(ifcver, ierror, ioutput, text(wrkdir, len_wrkdir, "wrkdir"), text(outdir, len_outdir, "outdir"),
                   text(expnam, len_expnam, "expnam"));
  });
}

void cntc_initializefirst_new(int* ifcver, int* ierror, int* ioutput, const char* wrkdir, const char* outdir,
                              const char* expnam, int* len_wrkdir, int* len_outdir, int* len_expnam) {
  cntc_initializefirst(ifcver, ierror, ioutput, wrkdir, outdir, expnam, len_wrkdir, len_outdir, len_expnam);
}

void cntc_initialize(int* ire, int* imodul, int* ifcver, int* ierror, const char* outdir, int* len_outdir) {
  contact::guarded("cntc_initialize", ierror, [&] {
    contact::first(ifcver, nullptr, nullptr, {}, contact::text(outdir, len_outdir, "outdir"), {});
    contact::initialize(contact::need(ire, "ire"), contact::need(imodul, "imodul"));
    contact::put(ierror, 0);
  });
}

void cntc_setglobalflags(int* lenflg, int* params, int* values) {
  contact::guarded("cntc_setglobalflags", nullptr, [&] {
    contact::set_global_flags(contact::array(params, lenflg, "params"), contact::array(values, lenflg, "values"));
  });
}

void cntc_getmaxnumthreads(int* mxthrd) {
  contact::guarded("cntc_getmaxnumthreads", nullptr,
                   [&] { contact::put(mxthrd, std::min(contact::kHighestElement, contact::cores())); });
}

void cntc_finalize(int* ire) {
  contact::guarded("cntc_finalize", nullptr, [&] { contact::finalize(contact::need(ire, "ire")); });
}

void cntc_finalizelast(void) {
  contact::guarded("cntc_finalizelast", nullptr, [] {
    const std::unique_lock lock(contact::library().mutex);
    contact::stop(contact::library());
  });
}

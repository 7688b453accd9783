// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#include <csignal>
#include <utility>

#include "treadmark/app/version.hpp"
#include "treadmark/core/error.hpp"
#include "treadmark/core/missing_file.hpp"
#include "treadmark/core/parts.hpp"
#include "treadmark/interfaces/c/numbers.hpp"
#include "treadmark/interfaces/python/python.hpp"
#include "treadmark/io/results/field_table.hpp"

namespace treadmark::python {
namespace {

/// What Ctrl-C sets: the innermost work of the main thread.
std::atomic<std::atomic<bool>*> at_work{nullptr};
volatile int interrupted = 0;
struct sigaction pythons_handler {};
unsigned long main_thread = 0;

void on_interrupt(int number) {
  if (std::atomic<bool>* stop = at_work.load()) *stop = true;
  interrupted = 1;
  pythons_handler.sa_handler(number);
}

void raise(const char* name, const std::string& message, const SourcePosition& where, const std::string& advice) {
  const py::object type = py::module_::import("treadmark._errors").attr(name);
  PyErr_SetObject(type.ptr(), type(message, where.file, where.line, where.column, advice).ptr());
}

void translate(std::exception_ptr thrown) {  // NOLINT(performance-unnecessary-value-param): pybind11 has it so
  try {
    if (thrown) std::rethrow_exception(thrown);
  } catch (const MissingFile& missing) {
    raise("MissingFileError", missing.message(), missing.where(), missing.advice());
  } catch (const Error& error) {
    raise(error.kind() == ErrorKind::numerical ? "NumericalError" : "InputError", error.message(), error.where(),
          error.advice());
  } catch (const c::BadArgument& wrong) {
    raise("InputError", wrong.what, {}, "");
  } catch (const Cancelled& end) {
    raise("Cancelled", end.what(), {}, "");
  } catch (const std::filesystem::filesystem_error& error) {
    const py::object made = py::reinterpret_borrow<py::object>(PyExc_OSError)(
        error.code().value(), error.code().message(), error.path1().string());
    PyErr_SetObject(py::type::handle_of(made).ptr(), made.ptr());
  } catch (const py::builtin_exception&) {
    throw;  // Python's own
  } catch (const std::runtime_error& error) {
    raise("TreadmarkError", error.what(), {}, "");
  }
}

template <class Result>
py::list number_table() {
  py::list rows;
  for (const auto& number : c::result_numbers<Result>())
    rows.append(py::make_tuple(number.name, number.unit, number.meaning, std::string(number.row->object),
                               std::string(number.row->key), number.row->unit.in_file(1.0),
                               number.row->unit_in(true).in_file(1.0)));
  return rows;
}

/// The tables of the library: names, units, meanings.
py::dict tables() {
  py::list numbers, keys, fields;
  for (const c::CaseNumber& number : c::case_numbers())
    numbers.append(py::make_tuple(number.name, number.unit, number.meaning, static_cast<int>(number.key->info.scope)));
  for (const io::CaseKey& key : io::case_keys()) {
    const io::KeyUnit unit = io::unit_at_end(key.info.path);  // of numbers: their name without it
    keys.append(py::make_tuple(key.info.path, key.info.doc, key.info.default_text, static_cast<int>(key.info.scope),
                               key.info.path.substr(0, key.info.path.size() - unit.ending.size()), unit.si));
  }
  for (const io::FieldColumn& field : io::kFieldColumns)
    fields.append(py::make_tuple(std::string(field.name), std::string(field.unit), std::string(field.meaning)));
  const auto named = [](std::span<const c::NamedNumber> all) {
    py::list rows;
    for (const c::NamedNumber& number : all) rows.append(py::make_tuple(number.name, number.unit, number.meaning));
    return rows;
  };
  using namespace py::literals;
  return py::dict("motion"_a = named(c::motion_numbers()), "forces"_a = named(c::force_numbers()),
                  "case_numbers"_a = numbers, "case_keys"_a = keys, "case"_a = number_table<io::CaseResult>(),
                  "patch"_a = number_table<io::PatchResult>(), "fields"_a = fields);
}

py::dict built_parts() {
  py::dict built;
  for (const Part& part : parts()) built[py::str(std::string(part.key))] = part.built;
  return built;
}

}  // namespace

struct CatchInterrupt::Kept {
  std::atomic<bool>* before;
  bool installed = false;
};

CatchInterrupt::CatchInterrupt(std::atomic<bool>& stop) {
  if (PyThread_get_thread_ident() != main_thread) return;
  kept_ = std::make_unique<Kept>(Kept{at_work.exchange(&stop)});
  tm_set_cancel_flag(&interrupted);
  if (kept_->before != nullptr) return;
  interrupted = 0;
  if (sigaction(SIGINT, nullptr, &pythons_handler) != 0 || pythons_handler.sa_handler == SIG_DFL ||
      pythons_handler.sa_handler == SIG_IGN || (pythons_handler.sa_flags & SA_SIGINFO) != 0)
    return;
  struct sigaction ours = pythons_handler;
  ours.sa_handler = on_interrupt;
  kept_->installed = sigaction(SIGINT, &ours, nullptr) == 0;
}

CatchInterrupt::~CatchInterrupt() {
  if (!kept_) return;
  at_work = kept_->before;
  if (kept_->before == nullptr) tm_set_cancel_flag(nullptr);
  // What Python set meanwhile, in a callback, stays.
  struct sigaction now {};
  if (kept_->installed && sigaction(SIGINT, nullptr, &now) == 0 && now.sa_handler == on_interrupt)
    sigaction(SIGINT, &pythons_handler, nullptr);
}

std::mutex& file_mutex() {
  static std::mutex mutex;
  return mutex;
}

}  // namespace treadmark::python

PYBIND11_MODULE(_treadmark, module) {
  using namespace treadmark;
  using namespace treadmark::python;
  main_thread = py::module_::import("threading").attr("main_thread")().attr("ident").cast<unsigned long>();
  py::register_local_exception_translator(translate);
  module.doc() = "What the package treadmark is made of; programs use that.";
  module.def("version", [] { return app::version(); });
  module.def("version_text", [] { return std::string(tm_version_text()); });
  module.def("parts", built_parts);
  module.def("tables", tables);
  module.def("set_threads", [](int count) { check([&] { return tm_set_threads(count); }); });
  add_handles(module);
  add_results(module);
  add_verbs(module);
  add_requests(module);
  add_backends(module);
  add_simulations(module);
  add_tables(module);
  add_scans(module);
  add_pages(module);
}

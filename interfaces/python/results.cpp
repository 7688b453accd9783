// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#include <utility>

#include "treadmark/app/cases/output_files.hpp"
#include "treadmark/app/surfaces/sampled_surfaces.hpp"
#include "treadmark/app/version.hpp"
#include "treadmark/interfaces/c/numbers.hpp"
#include "treadmark/interfaces/python/python.hpp"
#include "treadmark/io/results/field_table.hpp"
#include "treadmark/io/results/read_hdf5.hpp"
#include "treadmark/io/results/summary.hpp"
#include "treadmark/io/results/write_hdf5.hpp"
#include "treadmark/io/results/write_json.hpp"
#include "treadmark/io/results/write_vtk.hpp"
#include "treadmark/report/pictures/pressure_svg.hpp"

namespace treadmark::python {
namespace {

constexpr py::ssize_t kNumber = sizeof(double);

/// Kept for ever: keys of dictionaries are made once. As long as the module.
template <class Result>
const std::vector<PyObject*>& keys_of() {
  static const std::vector<PyObject*> keys = [] {
    std::vector<PyObject*> all;
    for (const auto& number : c::result_numbers<Result>())
      all.push_back(PyUnicode_InternFromString(number.name.c_str()));
    return all;
  }();
  return keys;
}

/// What is known, by name in SI; of names that stand twice the first.
template <class Result>
py::dict numbers_of(const Result& result) {
  py::dict numbers;
  const auto rows = c::result_numbers<Result>();
  const auto& keys = keys_of<Result>();
  for (std::size_t i = rows.size(); i-- > 0;) {
    const io::Quantity<Result>& row = *rows[i].row;
    if (io::has_block(result, row.block) && row.has(result))
      PyDict_SetItem(numbers.ptr(), keys[i], py::float_(row.access.get(result)).ptr());
  }
  return numbers;
}

py::dict fields_of(const io::PatchFields& fields, const py::object& owner) {
  py::dict views;
  const std::vector<py::ssize_t> shape{fields.grid.ny, fields.grid.nx};
  for (const io::FieldColumn& column : io::kFieldColumns)
    if (const auto& values = fields.*column.values; !values.empty())
      views[py::str(column.name.data(), column.name.size())] = view(values, 'd', shape, owner);
  if (!fields.state.empty()) views["state"] = view(fields.state, 'B', shape, owner);
  return views;
}

py::dict block_of(const io::SubsurfaceBlock& block, const py::object& owner) {
  constexpr py::ssize_t kStep = sizeof(io::SubsurfaceValue);
  const py::ssize_t nx = block.nx, ny = block.ny, nz = block.nz;
  const std::vector<py::ssize_t> shape{nz, ny, nx}, strides{nx * ny * kStep, nx * kStep, kStep};
  const auto member = [&](const void* data, const std::vector<py::ssize_t>& more) {
    auto all = shape, steps = strides;
    for (std::size_t i = 0; i < more.size(); ++i) {
      all.push_back(more[i]);
      steps.push_back(i + 1 < more.size() ? 3 * kNumber : kNumber);
    }
    return view(data, 'd', all, steps, owner);
  };
  py::dict values;
  if (block.values.empty()) return values;
  const io::SubsurfaceValue& first = block.values.front();
  values["point"] = member(&first.point, {3});
  values["displacement"] = member(&first.displacement, {3});
  values["stress"] = member(&first.stress, {3, 3});
  values["hydrostatic"] = member(&first.hydrostatic, {});
  values["von_mises"] = member(&first.von_mises, {});
  values["tresca"] = member(&first.tresca, {});
  values["principal"] = member(&first.principal, {3});
  return values;
}

py::dict patch_to_python(const io::PatchResult& patch, const py::object& owner) {
  const Grid2& grid = patch.fields.grid;
  py::list blocks;
  for (const io::SubsurfaceBlock& block : patch.subsurface) blocks.append(block_of(block, owner));
  py::dict d;
  d["numbers"] = numbers_of(patch);
  d["fields"] = fields_of(patch.fields, owner);
  d["grid"] = py::make_tuple(grid.nx, grid.ny, grid.x0, grid.y0, grid.dx, grid.dy);
  d["origin"] = view(&patch.fields.X_TC.origin, 'd', {3}, {kNumber}, owner);
  d["rotation"] = view(&patch.fields.X_TC.rotation, 'd', {3, 3}, {kNumber, 3 * kNumber}, owner);
  d["id"] = patch.id;
  d["came_from"] = patch.came_from;
  d["shift"] = patch.shift;
  d["row_angle"] = view(patch.fields.row_angle, 'd', {static_cast<py::ssize_t>(patch.fields.row_angle.size())}, owner);
  d["subsurface"] = blocks;
  if (patch.sensitivities) {
    d["by_creepage"] = view(&patch.sensitivities->by_creepage, 'd', {3, 2}, {2 * kNumber, kNumber}, owner);
    d["by_approach"] = view(&patch.sensitivities->by_approach, 'd', {3}, {kNumber}, owner);
  }
  return d;
}

/// As result.json has it.
py::object uncertainty_of(const io::CaseResult& result) {
  if (!result.uncertainty) return py::none();
  const io::CaseUncertainty& u = *result.uncertainty;
  py::list sources, numbers;
  for (const io::CaseUncertainty::Source& s : u.sources) {
    py::dict one;
    one["name"] = s.name;
    one["sigma"] = s.sigma;
    sources.append(one);
  }
  for (const io::CaseUncertainty::Number& n : u.numbers) {
    py::dict one;
    one["name"] = n.name;
    one["value"] = n.value;
    one["sigma"] = n.sigma;
    one["sampled"] = n.sampled;
    one["shares"] = n.shares;
    numbers.append(one);
  }
  py::dict d;
  d["message"] = u.message;
  d["sources"] = sources;
  d["numbers"] = numbers;
  d["checked"] = u.checked;
  d["samples"] = u.samples;
  d["others"] = u.others;
  d["why"] = u.why;
  return d;
}

py::dict head_of(const io::RunResult& run) {
  py::list surfaces;
  for (const io::SurfaceUse& use : run.surfaces) {
    py::dict d;
    d["body"] = use.body;
    d["backend"] = use.backend;
    d["resolution"] = use.resolution;
    d["build_seconds"] = use.build_seconds;
    d["memory_bytes"] = use.memory_bytes;
    d["note"] = use.note;
    surfaces.append(d);
  }
  py::dict d;
  d["version"] = run.version;
  d["git"] = run.git;
  d["threads"] = run.threads;
  d["seconds"] = run.seconds;
  d["title"] = run.title;
  d["input_file"] = run.input_file;
  d["input_sha256"] = run.input_sha256;
  d["geometry_sha256"] = run.geometry_sha256;
  d["settings"] = run.settings;
  d["complete"] = run.complete;
  d["cases_total"] = run.cases_total;
  d["surfaces"] = surfaces;
  return d;
}

}  // namespace

py::dict to_python(std::shared_ptr<const io::CaseResult> shared) {
  const io::CaseResult& result = *shared;
  const py::object owner = py::cast(Solved{std::move(shared)});
  py::list remarks, patches;
  for (const Remark& remark : result.remarks)
    remarks.append(py::make_tuple(std::string(remark.row().name), remark.text, remark.patch, remark.grave()));
  for (const io::PatchResult& patch : result.patches) patches.append(patch_to_python(patch, owner));
  py::dict d;
  d["number"] = result.number;
  d["status"] = std::string(io::status_word(result));
  d["message"] = result.message;
  d["remarks"] = remarks;
  d["uncertainty"] = uncertainty_of(result);
  d["seconds"] = result.seconds;
  d["numbers"] = numbers_of(result);
  d["patches"] = patches;
  d["force_iterations"] = result.force_iterations;
  d["_handle"] = owner;
  return d;
}

py::list to_python(const std::shared_ptr<const void>& holder, const std::vector<io::CaseResult>& results) {
  py::list list;
  for (const io::CaseResult& result : results)
    list.append(to_python(std::shared_ptr<const io::CaseResult>(holder, &result)));
  return list;
}

io::RunResult& Run::whole() {
  if (const auto from = std::exchange(made_from, nullptr)) app::add_surfaces(*result, from->first, from->second);
  return *result;
}

void add_results(py::module_& module) {
  py::class_<Solved>(module, "Solved")
      .def("summary", [](const Solved& solved) { return io::summary(*solved.result); })
      .def("run", [](const Solved& solved) {
        auto run = std::make_shared<io::RunResult>();
        run->version = app::version();
        run->git = app::git_revision();
        run->threads = thread_count();
        run->cases_total = 1;
        run->cases = {*solved.result};
        return Run{std::move(run), {}, nullptr};
      });
  py::class_<Run>(module, "Run")
      .def_static(
          "read_hdf5",
          [](const std::filesystem::path& file) {
            return Run{with_files([&] { return std::make_shared<io::RunResult>(io::read_hdf5(file)); }), {}, nullptr};
          })
      .def_property_readonly("head", [](const Run& run) { return head_of(*run.result); })
      .def_property_readonly("notes", [](const Run& run) { return run.notes; })
      .def_property_readonly("varied", [](const Run& run) { return run.varied; })
      .def("cases", [](const Run& run) { return to_python(run.result, run.result->cases); })
      .def("json", [](const Run& run) { return io::to_json(*run.result); })
      .def("summary",
           [](const Run& run) {
             std::string text;
             for (const io::CaseResult& c : run.result->cases) text += io::summary(c) + '\n';
             return text;
           })
      .def("svg", [](const Run& run) { return pictures::pressure_svg(*run.result); })
      .def("write_json", [](const Run& run, const std::filesystem::path& file) { io::write_json(file, *run.result); })
      .def("write_hdf5",
           [](Run& run, const std::filesystem::path& file) { with_files([&] { io::write_hdf5(file, run.whole()); }); })
      .def("write_vtk", [](Run& run, const std::filesystem::path& folder) { io::write_vtk(folder, run.whole()); })
      .def("write_folder", [](Run& run, const std::filesystem::path& folder) {
        return with_files([&] { return app::write_result_folder(folder, run.whole()); });
      });
}

}  // namespace treadmark::python

// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#include <pybind11/numpy.h>

#include <utility>

#include "treadmark/interfaces/python/python.hpp"

namespace treadmark::python {
namespace {

using Numbers = py::array_t<double, py::array::c_style | py::array::forcecast>;

/// What stands behind tm_contact_table is known to its functions only.
struct ForceTable {
  Owned<tm_contact_table> table;
};

template <class Make>
ForceTable table_made(Make&& make) {
  return released([&] { return ForceTable{made<tm_contact_table>(std::forward<Make>(make))}; });
}

ForceTable create_table(const tm_pair& pair, const tm_case& given, const Strings& settings) {
  std::vector<const char*> texts;
  texts.reserve(settings.size());
  for (const std::string& text : settings) texts.push_back(text.c_str());
  return table_made([&](auto out) { return tm_table_create(&pair, &given, texts.data(), texts.size(), out); });
}

/// Rows of motions to rows of forces, with the status and, where it is not ok, the message of each.
py::tuple evaluate_table(const ForceTable& t, const Numbers& motions, std::size_t wanted) {
  const auto rows = static_cast<std::size_t>(motions.shape(0)), given = static_cast<std::size_t>(motions.shape(1));
  Numbers forces({static_cast<py::ssize_t>(rows), static_cast<py::ssize_t>(wanted)});
  const double* from = motions.data();
  double* to = forces.mutable_data();
  Strings status(rows), messages(rows);
  released([&] {
    for (std::size_t i = 0; i < rows; ++i) {
      check([&] {
        const tm_status end = tm_table_evaluate(t.table.get(), from + i * given, given, to + i * wanted, wanted);
        status[i] = tm_status_name(end);
        return end;
      });
      messages[i] = tm_table_message(t.table.get());
    }
  });
  return py::make_tuple(forces, status, messages);
}

}  // namespace

void add_tables(py::module_& module) {
  py::class_<ForceTable>(module, "ForceTable")
      .def_static("create", create_table)
      .def_static(
          "read",
          [](const std::filesystem::path& file) {
            return with_files([&] {
              return ForceTable{made<tm_contact_table>([&](auto out) { return tm_table_read(file.c_str(), out); })};
            });
          })
      .def("write",
           [](const ForceTable& t, const std::filesystem::path& file) {
             with_files([&] { check([&] { return tm_table_write(t.table.get(), file.c_str()); }); });
           })
      .def("evaluate", evaluate_table)
      .def("error", [](const ForceTable& t, const std::string& number) {
        double worst = 0.0, rms = 0.0;
        check([&] { return tm_table_error(t.table.get(), number.c_str(), &worst, &rms); });
        return py::make_tuple(worst, rms);
      });
}

}  // namespace treadmark::python

// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#include "treadmark/app/cli/verbs.hpp"

namespace treadmark::cli {
namespace {

constexpr Verb kVerbs[] = {
    {"run", "Solve the contact problems of one or more case files", add_run},
    {"compare", "Solve the same cases through several surface representations", add_compare},
    {"bench", "Cost of heights and contact search in every backend, agreement checked first", add_bench},
    {"convert", "Write a wheel or rail as triangles, slices or offsets", add_convert},
    {"import", "From a raw scan to a surface: units, placement, cleaning, fit, with an audit", add_import, "scans"},
    {"scan", "Scan a wheel or rail virtually: points with the faults of a laser scanner, and the truth about them",
     add_scan, "scans"},
    {"simulate", "A vehicle on its track in time, with contact at its wheels", add_simulate, "vehicle"},
    {"sweep", "Runs of a simulation or case with varied keys, on all cores; goes on where it was stopped", add_sweep,
     "vehicle"},
    {"report", "One HTML file of a result folder, to be opened in any browser, offline", add_report, "report"},
    {"plot", "One picture (SVG) of a result folder", add_plot, "report"},
    {"check", "Read and validate case files and their geometry without solving", add_check},
    {"list", "List what this build offers", add_list},
    {"schema", "Print the JSON schema of Treadmark's case files", add_schema},
};

}  // namespace

std::span<const Verb> verbs() { return kVerbs; }

}  // namespace treadmark::cli

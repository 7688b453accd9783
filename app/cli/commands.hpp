// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#pragma once

#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

namespace treadmark::cli {

/// Exit statuses of the program.
enum ExitStatus : int { kOk = 0, kFailed = 1, kUsage = 2, kInputData = 3, kNotConverged = 4 };

struct CommonOptions {
  int threads = 0;     ///< 0 = all cores
  bool quiet = false;  ///< no progress
};

struct RunOptions {
  std::vector<std::string> cases;
  std::string output_folder;  ///< empty = no files
  std::string json_file;      ///< "-" = stdout, empty = none
  std::string backend, wheel_backend, rail_backend;
  double resolution_mm = 0.0;          ///< of re-represented surfaces, 0 = their default
  std::vector<std::string> overrides;  ///< key=value
  std::string report_file;             ///< HTML; empty = none
};

struct CompareOptions {
  std::string case_file;
  std::string output_folder, json_file;
  std::vector<std::string> backends, wheel_backends, rail_backends;
  std::vector<double> resolutions_mm;
  std::string bodies = "auto";
  std::vector<std::string> overrides;
  std::string report_file;  ///< HTML; empty = none
};

struct BenchOptions {
  std::string case_file;  ///< empty = the built-in case
  std::string output_folder, json_file;
  std::vector<std::string> backends;
  std::vector<double> resolutions_mm;
  double seconds_per_measure = 0.2;
  bool markdown = false;
  bool threads_given = false;  ///< else one thread
  std::vector<std::string> overrides;
  std::string report_file;  ///< HTML; empty = none
};

struct ConvertOptions {
  std::string input, output;  ///< geometry or case file; surface file
  std::string body;           ///< "wheel", "rail" or empty
  double resolution_mm = 0.0;
  double nominal_radius_mm = 0.0;
  double scale_to_mm = 1.0;
  std::vector<double> range_mm, range_deg;  ///< along the track, round the wheel: two numbers or none
  std::vector<std::string> overrides;
};

struct ScanOptions {
  std::string surface, cloud;  ///< geometry or case file; file of points
  std::string truth_file;      ///< "-" = stdout, empty = none
  std::string body;            ///< "wheel", "rail" or empty
  std::size_t points = 1'000'000;
  double spacing_mm = 0.0;  ///< 0 = by the number of points
  double noise_mm = 0.0, noise_lateral_mm = 0.0;
  double outliers = 0.0, holes = 0.0, hole_size_mm = 4.0, drop_outs = 0.0;
  double most_incidence_deg = 0.0;
  int passes = 1;
  double registration_mm = 0.0;
  std::string frame = "identity", unit = "mm";
  std::vector<double> range_mm, range_deg, range_y_mm;  ///< two numbers or none
  double nominal_radius_mm = 0.0;
  double scale_to_mm = 1.0;
  std::uint64_t seed = 1;
  std::vector<std::string> overrides;
};

struct ImportOptions {
  std::vector<std::string> scans, outputs;
  std::string report_folder, json_file, settings_file;  ///< empty = none; JSON "-" = stdout
  std::string body, unit, nominal;                      ///< empty = as the settings say
  double nominal_radius_mm = 0.0, resolution_mm = 0.0;  ///< 0 = as the settings say
  bool list_settings = false;
  std::vector<std::string> overrides;  ///< table.key=value
};

struct SimulateOptions {
  std::string file;
  std::string output_folder, json_file;  ///< empty = none; JSON "-" = stdout
  std::string wheel_backend, rail_backend;
  bool resume = false;
  bool modes_only = false;  ///< print eigenfrequencies, do not integrate
  std::vector<std::string> overrides;
  std::string report_file;  ///< HTML; empty = none
};

struct SweepOptions {
  std::string file;
  std::string output_folder;
  bool resume = false;
  bool threads_given = false;  ///< else one for each process that was started together with others
  std::vector<std::string> overrides;
  std::string report_file;  ///< HTML; empty = none
};

struct ReportOptions {
  std::string folder;
  std::string output_file;       ///< empty = report.html in the folder
  bool static_pictures = false;  ///< in place of live views
};

struct PlotOptions {
  std::string folder, output_file;  ///< "-" = stdout
  std::string what;                 ///< empty: list what can be drawn
  std::vector<int> cases;           ///< numbers; empty = all
};

// Each command returns an exit status or throws treadmark::Error.
int run_command(const RunOptions& options, const CommonOptions& common);
int compare_command(const CompareOptions& options, const CommonOptions& common);
int bench_command(const BenchOptions& options, const CommonOptions& common);
int convert_command(const ConvertOptions& options, const CommonOptions& common);
int scan_command(const ScanOptions& options, const CommonOptions& common);
int import_command(const ImportOptions& options, const CommonOptions& common);
int simulate_command(const SimulateOptions& options, const CommonOptions& common);
int sweep_command(const SweepOptions& options, const CommonOptions& common);
int report_command(const ReportOptions& options, const CommonOptions& common);
int plot_command(const PlotOptions& options, const CommonOptions& common);
int check_command(const RunOptions& options);
int list_command(const std::string& what);
int schema_command();

}  // namespace treadmark::cli

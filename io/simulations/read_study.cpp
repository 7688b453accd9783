// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors

#include "treadmark/io/simulations/read_study.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <numeric>

#include "treadmark/core/missing_file.hpp"
#include "treadmark/io/cases/file_kind.hpp"
#include "treadmark/io/cases/read_case.hpp"
#include "treadmark/io/cases/read_toml.hpp"
#include "treadmark/io/cases/writing/write_cases.hpp"
#include "treadmark/io/files/sha256.hpp"
#include "treadmark/io/simulations/change_value.hpp"
#include "treadmark/io/simulations/read_simulation.hpp"
#include "treadmark/io/simulations/simulation_keys.hpp"
#include "treadmark/io/simulations/study_keys.hpp"

namespace treadmark::io {

namespace {

using Base = std::variant<SimulationFile, CaseFile>;

/// The file that all runs start from, parsed once.
struct BaseTables {
  std::filesystem::path path;
  CaseTable tables;
  std::string sha256;
  bool simulation = false;

  Base read(std::span<const std::string> overrides) const {
    if (simulation) {
      SimulationFile file = simulation_of(tables, path, overrides);
      file.sha256 = sha256;
      return file;
    }
    CaseFile file = case_file_of(tables, path, overrides);
    file.sha256 = sha256;
    return file;
  }
};

/// The tables of a file without [study], [evolve] or [design].
BaseTables base_of(CaseTable tables, const std::filesystem::path& path, std::string sha256) {
  BaseTables base{path, std::move(tables), std::move(sha256), false};
  std::erase_if(base.tables, [](const CaseEntry& entry) {
    return entry.key == "study" || entry.key == "evolve" || entry.key == "design";
  });
  base.simulation = find_entry(base.tables, "simulation") != nullptr;
  return base;
}

BaseTables read_base(const std::filesystem::path& path) {
  const std::string text = read_text(path);
  return base_of(parse_toml(text, path.string()), path, sha256_hex(text));
}

BaseTables named_base(const TableOf<StudyFile>& study, const CaseTable& document, const std::filesystem::path& folder) {
  const std::string base = study.path_of(&StudyFile::base);
  for (const CaseEntry& entry : document)
    if (entry.key != study.path() && entry.key != "title")
      throw Error(ErrorKind::configuration, fmt::format("{} stands beside {}, which says it all", entry.key, base),
                  entry.key_where,
                  fmt::format("change keys of the base in [[{}]], or leave {} out",
                              study.path_of(&StudyFile::variations), base));
  std::string name = study.text(study.key(&StudyFile::base));
  std::replace(name.begin(), name.end(), '\\', '/');
  const std::filesystem::path path = (folder / name).lexically_normal();
  const SourcePosition& where = study.need(&StudyFile::base).where;
  std::error_code code;
  if (!std::filesystem::is_regular_file(path, code))
    throw MissingFile(ErrorKind::configuration, fmt::format("{}: there is no file {}", base, path.string()), where,
                      advice_on_missing(path, "names count from the folder of the study file"));
  if (path.extension() != ".toml")
    throw Error(ErrorKind::configuration, fmt::format("{} must be a .toml file", base), where);
  if (is_study_file(path))
    throw Error(ErrorKind::configuration, fmt::format("{} is a study itself", base), where,
                "name a simulation or case file");
  return read_base(path);
}

/// Overrides of the study, below this table, change its tables, the others are returned.
std::vector<std::string> apply_to_study(CaseTable& document, std::string_view table,
                                        std::span<const std::string> overrides) {
  std::vector<std::string> others;
  for (const std::string& one : overrides) {
    const CaseOverride change = parse_override(one);
    if (change.path == "title" || change.path.starts_with(fmt::format("{}.", table)))
      change_value(document, change.path, change);
    else
      others.push_back(one);
  }
  return others;
}

void check_not_varied(const std::vector<Variation>& variations, const std::vector<std::string>& common) {
  for (const std::string& one : common) {
    const CaseOverride change = parse_override(one);
    for (const Variation& variation : variations)
      for (const VariedValue& value : variation.values)
        for (const std::string& varied : value.overrides)
          if (parse_override(varied).path == change.path)
            throw Error(ErrorKind::configuration, fmt::format("the study varies {} itself", change.path),
                        change.value.where);
  }
}

std::string described(const StudyFile& study, const StudyRun& run) {
  std::string text;
  for (std::size_t v = 0; v < study.variations.size(); ++v) {
    const Variation& variation = study.variations[v];
    const std::string& name = variation.label.empty() ? variation.key : variation.label;
    text += fmt::format("{}{}{}{}", text.empty() ? "" : ", ", name, name.empty() ? "" : " = ",
                        variation.values[run.values[v]].label);
  }
  return text;
}

/// The place in the study file of an override that is to blame.
SourcePosition place_of(const SourcePosition& where, const StudyFile& study, const StudyRun& run) {
  for (std::size_t v = 0; v < study.variations.size(); ++v) {
    const VariedValue& value = study.variations[v].values[run.values[v]];
    for (const std::string& one : value.overrides)
      if (parse_override(one).value.where.file == where.file) return value.where;
  }
  return where;
}

/// Reads the base as every run will; what is wrong is told at the place of the error, with the run.
void check_runs(const StudyFile& study, const BaseTables& base, const RunRange& checked) {
  for (const StudyRun& run : study.runs) {
    if (!checked.has(run)) continue;
    try {
      base.read(run.overrides);
    } catch (const Error& e) {
      if (study.variations.empty()) throw;
      throw Error(e.kind(), fmt::format("run {} ({}): {}", run.number, described(study, run), e.message()),
                  place_of(e.where(), study, run), e.advice());
    }
  }
}

std::string title_of(const CaseTable& document, const TableOf<StudyFile>& study, const std::filesystem::path& file) {
  std::string title = study.text_or(study.key(&StudyFile::title), file.stem().string());
  const CaseEntry* top = find_entry(document, "title");
  if (top == nullptr || study.find(&StudyFile::title) != nullptr) return title;
  if (!std::holds_alternative<std::string>(top->value.data))
    throw Error(ErrorKind::configuration, fmt::format("title must be text, found {}", top->value.kind()),
                top->value.where);
  return top->value.text();
}

}  // namespace

StudyTables::StudyTables(const std::filesystem::path& file, std::string_view name,
                         std::span<const std::string> overrides) {
  const std::string text = read_text(file);
  CaseTable parsed = parse_toml(text, file.string());
  document.swap(parsed);
  study.path = file;
  study.sha256 = sha256_hex(text);
  common_ = apply_to_study(document, name, overrides);
  table = find_entry(document, name);
  if (table == nullptr || !table->value.is_table())
    throw Error(ErrorKind::configuration, fmt::format("[{}] is missing", name),
                table == nullptr ? SourcePosition{file.string(), 1, 1} : table->value.where,
                "see docs/simulation-files.md for studies, docs/evolve.md for evolutions, docs/design.md for designs");
}

void StudyTables::read_runs(const TableReader& all, const RunRange& checked) {
  const TableOf<StudyFile> reader(all, study_keys());
  study.title = title_of(document, reader, study.path);
  study.variations = read_variations(reader);
  check_not_varied(study.variations, common_);
  study.runs = runs_of(study.variations, common_);
  const bool named = reader.find(&StudyFile::base) != nullptr;
  if (!named && document.size() == 1)
    reader.fail(fmt::format("{} is missing", reader.path_of(&StudyFile::base)),
                fmt::format("name a simulation or case file, or give its tables beside [{}]", reader.path()));
  const BaseTables base =
      named ? named_base(reader, document, study.path.parent_path()) : base_of(document, study.path, study.sha256);
  study.base = base.path;
  study.base_is_simulation = base.simulation;
  check_runs(study, base, checked);
}

std::vector<double> shares_of_runs(std::vector<double> weights, std::size_t runs, const TableReader& table,
                                   std::string_view key) {
  const std::string path = table.path_of(key);
  const auto refuse = [&](std::string message, std::string advice = {}) {
    throw Error(ErrorKind::configuration, std::move(message), table.need(key).where, std::move(advice));
  };
  if (weights.empty()) weights.assign(runs, 1.0);
  if (weights.size() != runs)
    refuse(fmt::format("{} has {} values for {} positions", path, weights.size(), runs),
           fmt::format("one for each position, in the order of the product of {}.vary", table.path()));
  const double sum = std::accumulate(weights.begin(), weights.end(), 0.0);
  if (!(sum > 0.0)) refuse(fmt::format("{} are all zero", path));
  for (double& weight : weights) weight /= sum;
  return weights;
}

StudyFile read_study_file(const std::filesystem::path& file, std::span<const std::string> overrides,
                          const RunRange& checked) {
  StudyTables tables(file, "study", overrides);
  const TableOf reader(tables.table->value, "study", study_keys());
  tables.read_runs(reader, checked);
  tables.study.figures = read_figures(reader, tables.study.variations);
  return std::move(tables.study);
}

Base read_study_run(const StudyFile& study, const StudyRun& run) { return read_base(study.base).read(run.overrides); }

Inputs inputs_of(const StudyFile& study) {
  if (study.runs.empty()) return {};
  const Base first = read_study_run(study, study.runs.front());
  const auto* cases = std::get_if<CaseFile>(&first);
  Inputs out = cases != nullptr ? inputs_of(cases->cases, cases->path.parent_path())
                                : inputs_of(std::get<SimulationFile>(first));
  for (const Variation& varied : study.variations) {
    std::vector<std::string> values;
    for (const VariedValue& value : varied.values) values.push_back(value.label);
    InputList list;
    list.add({}, varied.key.empty() ? varied.label : varied.key, values);
    for (auto& [name, value] : list.words()) {
      std::erase_if(out, [&](const auto& one) { return one.first == name; });
      out.emplace(out.begin(), "varied: " + name, value);
    }
  }
  return out;
}

namespace {

/// Which variation makes the lines, by its key or its label.
void check_series(const TableOf<StudyFigure>& figure, const std::vector<Variation>& variations,
                  const StudyFigure& out) {
  if (out.series.empty()) return;
  std::vector<std::string> known;
  const Variation* lines = nullptr;
  for (const Variation& variation : variations)
    for (const std::string& name : {variation.key, variation.label}) {
      if (name.empty()) continue;
      known.push_back(name);
      if (name == out.series) lines = &variation;
    }
  check_name(fmt::format("{}: the variation", figure.path_of(&StudyFigure::series)), out.series, known,
             figure.need(&StudyFigure::series).where);
  if (!out.labels.empty() && out.labels.size() != lines->values.size())
    figure.refuse(&StudyFigure::labels,
                  fmt::format("{} has {} texts for {} values of {}", figure.path_of(&StudyFigure::labels),
                              out.labels.size(), lines->values.size(), out.series));
}

/// Which value of a variation a text means: its label, or its number.
std::size_t value_of(const Variation& variation, const std::string& text, const SourcePosition& where) {
  const auto named = std::find_if(variation.values.begin(), variation.values.end(), [&](const VariedValue& value) {
    return value.label == text || (value.number && fmt::format("{:.15g}", *value.number) == text);
  });
  if (named == variation.values.end())
    throw Error(ErrorKind::configuration, fmt::format("{} has no value '{}'", variation.label, text), where,
                "the values are those of study.vary, as they stand there");
  return static_cast<std::size_t>(named - variation.values.begin());
}

/// "key=value" texts: of each variation named only these values are drawn.
void read_only(const TableOf<StudyFigure>& figure, const std::vector<Variation>& variations, StudyFigure& out) {
  out.only.assign(variations.size(), {});
  const std::vector<std::string> texts = figure.words(figure.key(&StudyFigure::only));
  std::vector<std::string> known;
  for (const Variation& variation : variations)
    for (const std::string& name : {variation.key, variation.label})
      if (!name.empty()) known.push_back(name);
  for (std::size_t i = 0; i < texts.size(); ++i) {
    const SourcePosition& where = figure.need(&StudyFigure::only).list()[i].where;
    const auto sign = texts[i].find('=');
    if (sign == std::string::npos)
      throw Error(ErrorKind::configuration,
                  fmt::format("{}: '{}' is not \"key=value\"", figure.path_of(&StudyFigure::only), texts[i]), where);
    const std::string name = texts[i].substr(0, sign);
    check_name(fmt::format("{}: the variation", figure.path_of(&StudyFigure::only)), name, known, where);
    const auto variation = std::find_if(variations.begin(), variations.end(),
                                        [&](const Variation& v) { return v.key == name || v.label == name; });
    out.only[static_cast<std::size_t>(variation - variations.begin())].push_back(
        value_of(*variation, texts[i].substr(sign + 1), where));
  }
}

StudyFigure read_figure(const TableOf<StudyFigure>& table, const std::vector<Variation>& variations) {
  using F = StudyFigure;
  F figure = table.read();
  const std::string file = fmt::format("{} = '{}'", table.path_of(&F::file), figure.file.string());
  if (figure.file.extension() != ".svg") table.refuse(&F::file, file + " must end with .svg");
  if (figure.file != figure.file.filename() || figure.file == "sweep.svg")
    table.refuse(&F::file, file + " is no name for a figure",
                 "figures lie in the folder of results: give a name without folders");
  if (figure.kind != F::Kind::patches) {
    table.need(&F::x);
    table.need(&F::y);
  }
  if (const CaseValue* x = table.find(&F::x)) figure.x_where = x->where;
  for (std::size_t i = 0; i < figure.y.size(); ++i) figure.y_where.push_back(table.need(&F::y).list()[i].where);
  if (figure.kind != F::Kind::patches && figure.y.empty())
    table.refuse(&F::y, fmt::format("{} is empty", table.path_of(&F::y)));
  if (table.find(&F::x_range) != nullptr && !figure.x_range)
    table.refuse(&F::x_range, fmt::format("{} must be two increasing numbers", table.path_of(&F::x_range)));
  check_series(table, variations, figure);
  read_only(table, variations, figure);
  for (const CaseValue* one : table.tables(&F::marks))
    figure.marks.push_back(TableOf(*one, table.path_of(&F::marks), mark_keys()).read());
  return figure;
}

}  // namespace

std::vector<StudyFigure> read_figures(const TableOf<StudyFile>& study, const std::vector<Variation>& variations) {
  std::vector<StudyFigure> figures;
  for (const CaseValue* one : study.tables(&StudyFile::figures)) {
    const TableOf table(*one, study.path_of(&StudyFile::figures), figure_keys());
    figures.push_back(read_figure(table, variations));
    const auto same = [&](const StudyFigure& figure) { return figure.file == figures.back().file; };
    if (std::count_if(figures.begin(), figures.end(), same) > 1)
      table.refuse(&StudyFigure::file, fmt::format("two figures would be written to {}", figures.back().file.string()));
  }
  return figures;
}

}  // namespace treadmark::io

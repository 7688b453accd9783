// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#pragma once

#include <array>
#include <map>
#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <variant>
#include <vector>

#include "treadmark/core/never_held.hpp"
#include "treadmark/io/results/result_model.hpp"

namespace treadmark::report {

/// What a report shows, as plain data: the writers turn it into HTML, into the data of the live views, and into static
/// pictures. Texts are plain text; the writers escape them. Numbers of views are in the units that are shown.

struct Axis {
  std::string label, unit;
  bool logarithmic = false;
  std::vector<double> values = {};
  std::vector<std::string> labels = {};  ///< categories 0, 1, ...; empty: an axis of numbers
};

struct Series {
  enum class Marks { line, points, both };
  std::string name;
  std::vector<double> y;
  std::vector<double> x = {};  ///< empty: those of the chart or of the timeline
  Marks marks = Marks::line;
  bool dashed = false;
  std::vector<std::string> texts = {};  ///< of the points, shown where one points at them
  std::vector<double> steps = {};       ///< steps of the timeline that the points stand for
};

struct Level {
  double value = 0.0;
  std::string label;
};

/// Curves over one axis y.
struct Panel {
  std::string label, unit;
  bool logarithmic = false;
  std::vector<Series> series = {};
  std::vector<Level> levels = {};
};

/// Panels above each other over a common x. Linked: a value for each step of the timeline, whose axes are x.
struct ChartView {
  bool linked = false;
  bool to_scale = false;  ///< one millimetre is as long upwards as across; of one panel, not linked
  std::optional<Axis> x = {};
  std::vector<Panel> panels = {};
  struct Curves {
    std::vector<double> x;
    std::vector<std::vector<std::vector<double>>> y;  ///< of each panel and series
  };
  std::vector<Curves> by_step = {};  ///< the curves change with the step; empty: they do not
};

/// Contact fields of sets of frames beside each other.
struct ContactView {
  std::vector<int> sets;
};

/// Surfaces and patches in space; fixed pages leave it out.
struct SceneView {
  int set = 0;
};

/// Wheel and rail cut across the track at the contact of a step; on fixed pages of the most loaded one.
struct SectionView {
  int set = 0;
  std::vector<int> over = {};  ///< other sets, whose bodies are drawn as dashed lines in the same plane
};

/// Contact of some frames from above in track axes, each over the section of wheel and rail; fixed pages have their own
/// pictures of both.
struct TrackView {
  int set = 0;
};

/// A quantity over a rectangle.
struct MapView {
  Axis x, y;  ///< labels and units
  std::string label, unit;
  bool diverging = false;
  int nx = 0, ny = 0;
  double x0 = 0.0, dx = 0.0, y0 = 0.0, dy = 0.0;
  std::vector<double> values = {};  ///< rows of equal y; NaN = nothing there
  /// Instead of `values`: as many for each step; still pictures show the last.
  std::vector<std::vector<double>> by_step = {};
  struct Mark {
    std::string label;
    std::vector<std::array<double, 2>> points;
  };
  std::vector<Mark> marks = {};
};

/// Points in space, in the axes of their wheel or rail [mm]; fixed pages leave it out.
struct CloudView {
  /// What colours the points, from -span to span: a distance along the normals.
  struct Quantity {
    std::string label, unit;
    double per_mm = 1.0;  ///< units
    double span = 0.0;
    std::vector<double> values = {};  ///< NaN: a point of the other kind
  };
  bool wheel = false;
  std::vector<double> x, y, z;
  std::vector<double> tilt;  ///< of the normals from straight out (-z, or the radius) towards +y [rad]
  std::vector<Quantity> quantities;
  std::string others;  ///< what points without values are
  std::vector<std::string> caption;
};

/// A static picture.
struct PictureView {
  std::string svg;
};

struct Figure {
  std::string id, title;
  std::variant<ChartView, ContactView, SceneView, SectionView, TrackView, MapView, CloudView, PictureView> view;
  std::string note = {};
};

struct Column {
  std::string label, unit = {};
};

/// A number in a table: shown with as many digits as people read, kept whole.
struct Number {
  double value = 0.0;
  int digits = 4;
};
using Cell = std::variant<std::string, Number, NeverHeld>;

struct Table {
  std::string id, caption;
  std::vector<Column> columns;
  struct Row {
    std::vector<Cell> cells;
    int step = -1;  ///< of the timeline; -1 = none
  };
  std::vector<Row> rows = {};
};

struct Banner {
  enum class Kind { failed, warning, note };
  Kind kind = Kind::note;
  std::string heading, text;
};

struct Facts {
  std::vector<std::pair<std::string, std::string>> entries;
};

struct Cards {
  struct Card {
    std::string label, value, note = {};
  };
  std::vector<Card> cards;
};

/// A text as it is, of fixed width.
struct Listing {
  std::string text;
};

struct Paragraph {
  std::string text;
};

using Block = std::variant<Banner, Facts, Cards, Table, Figure, Listing, Paragraph>;

struct Section {
  std::string id, title;
  std::vector<Block> blocks = {};
};

/// Contact at one step.
struct Frame {
  std::string name;
  std::shared_ptr<const io::CaseResult> result;  ///< never nullptr
};

struct FrameSet {
  std::string name;
  std::optional<int> nominal = {};  ///< frame whose contact is the one of undamaged surfaces
  std::vector<Frame> frames = {};
};

struct Timeline {
  std::string label;                      ///< what a step is: "case", "instant", "run"
  std::vector<std::string> names = {};    ///< of the steps; empty: made from the first axis
  std::vector<int> frames = {};           ///< of each step, -1 = none; empty: there are no contact fields
  std::vector<Axis> axes = {};            ///< a value a step; at least one
  std::size_t start = 0;                  ///< the step that is shown first
  std::vector<std::size_t> notable = {};  ///< steps that a page of too many keeps; ascending
  std::size_t count() const { return axes.empty() ? names.size() : axes.front().values.size(); }
};

/// What a page that solves needs: report/web/src/live.
struct Solving {
  std::string toml;                          ///< text of its case
  std::map<std::string, std::string> files;  ///< bytes of the files that it names
  std::vector<std::string> wheels, rails;    ///< names of profiles
  std::vector<std::string> backends;         ///< names of representations that need no further library
  std::string module, loader;                ///< of interfaces/web: the program, and the script that starts it
};

struct Page {
  std::string kind;  ///< "live", "run", "check", "compare", "bench", "import", "simulation", "assessment", "evolution",
                     ///< "sweep" or "overlay"
  std::string title, lead;
  std::vector<Section> sections = {};
  std::optional<Timeline> timeline = {};
  std::vector<FrameSet> sets = {};
  std::vector<io::SampledSurface> surfaces = {};  ///< that frames name
  std::string document = {};                      ///< JSON text of the result; may be empty
  std::string full_data = {};                     ///< where all fields are in full: "fields.h5"
  std::optional<Solving> solving = {};
};

}  // namespace treadmark::report

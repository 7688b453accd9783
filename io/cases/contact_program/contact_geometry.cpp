// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors

#include <fmt/format.h>

#include <algorithm>
#include <numbers>
#include <utility>

#include "treadmark/core/constants.hpp"
#include "treadmark/io/cases/contact_program/contact_case.hpp"
#include "treadmark/io/cases/validate_case.hpp"
#include "treadmark/io/profiles/read_slices.hpp"

namespace treadmark::io {

namespace {

double positive(ContactText& text, std::string_view name, double factor) {
  const double value = text.real(name) * factor;
  if (!(value > 0.0)) text.fail(fmt::format("{} must be positive", name));
  return value;
}

HertzInput read_hertz(ContactText& text, long kind) {
  using Given = HertzInput::Given;
  HertzInput h;
  switch (kind) {
    case -1:
      h.given = Given::curvatures;
      h.a1 = positive(text, "A1", kMilli);
      h.b1 = positive(text, "B1", kMilli);
      break;
    case -2:
      h.given = Given::curvature_and_ratio;
      h.a1 = positive(text, "A1", kMilli);
      h.aob = positive(text, "AOB", 1.0);
      break;
    case -3:
      h.given = Given::semi_axes;
      h.aa = positive(text, "AA", kMillimetre);
      h.bb = positive(text, "BB", kMillimetre);
      break;
    case -4:
      h.given = Given::line_curvature;
      h.a1 = positive(text, "A1", kMilli);
      h.bb = positive(text, "BB", kMillimetre);
      break;
    case -5:
      h.given = Given::line_semi_axis;
      h.aa = positive(text, "AA", kMillimetre);
      h.bb = positive(text, "BB", kMillimetre);
      break;
    default:
      h.given = Given::semi_double_elliptic;
      h.aa = positive(text, "AA", kMillimetre);
      h.bb_negative = positive(text, "BNEG", kMillimetre);
      h.bb_positive = positive(text, "BPOS", kMillimetre);
      h.bb = 0.5 * (h.bb_negative + h.bb_positive);
  }
  h.scale = positive(text, "SCALE", 1.0);
  return h;
}

std::vector<double> read_list(ContactText& text, std::string_view record, std::string_view name, long count,
                              double factor) {
  text.begin_record(record);
  std::vector<double> values;
  for (long i = 0; i < count; ++i)
    values.push_back(
        text.real(count > 20 ? fmt::format("{} {} of {}", name, i + 1, count) : fmt::format("{}{}", name, i + 1)) *
        factor);
  return values;
}

GapInput read_gap_formula(ContactReader& r, long base) {
  ContactText& text = r.text;
  GapInput gap;
  auto& c = gap.coefficients;
  constexpr std::string_view kRecord = "the undeformed distance";
  switch (base) {
    case 1:
      gap.kind = GapInput::Kind::quadratic;
      c = read_list(text, kRecord, "B", 6, 1.0);
      for (int i = 0; i < 3; ++i) c[static_cast<std::size_t>(i)] *= kMilli;
      c[5] *= kMillimetre;
      break;
    case 2: {
      gap.kind = GapInput::Kind::circular;
      text.begin_record(kRecord);
      const long count = text.integer("NN");
      if (count < 1) text.fail("NN must be positive");
      for (const auto name : {"XM", "RM", "Y1", "DY1"}) {
        c.push_back(text.real(name) * kMillimetre);
        if (std::string_view(name) == "RM" && c.back() == 0.0) text.fail("RM must not be 0");
      }
      const auto heights = read_list(text, kRecord, "B", count, kMillimetre);
      c.insert(c.end(), heights.begin(), heights.end());
      break;
    }
    case 3: {
      gap.kind = GapInput::Kind::sinusoidal;
      c = read_list(text, kRecord, "B", 8, kMillimetre);
      for (const std::size_t wave_number : {1u, 4u}) c[wave_number] *= kMilli * kMilli;
      if (c[6] == 0.0 || c[7] == 0.0) text.fail("B7 and B8 are lengths that must not be 0");
      break;
    }
    case 9:
      gap.kind = GapInput::Kind::per_element;
      c = read_list(text, kRecord, "h of element", static_cast<long>(r.kept.basic.mx) * r.kept.basic.my, kMillimetre);
      break;
    default:
      text.fail(fmt::format("IBASE = {} does not exist", base));
  }
  return gap;
}

/// x low, x high, y low, y high of one rectangle.
void read_rectangle(ContactText& text, std::string_view record, std::vector<double>& into) {
  for (const bool y : {false, true}) {
    const double low = text.real(y ? "YL" : "XL") * kMillimetre, high = text.real(y ? "YH" : "XH") * kMillimetre;
    if (!(low < high)) text.fail(fmt::format("{} has no extent", record));
    into.insert(into.end(), {low, high});
  }
}

PlanformInput read_sub_patches(ContactText& text) {
  constexpr long kMostPatches = 100;
  constexpr std::string_view kRecord = "the rectangle of a sub-patch";
  PlanformInput plan;
  plan.kind = PlanformInput::Kind::sub_patches;
  text.begin_record("the line NPATCH");
  const long patches = text.integer("NPATCH");
  if (patches < 1 || patches > kMostPatches) text.fail(fmt::format("NPATCH must lie in 1 ... {}", kMostPatches));
  const auto count = static_cast<std::size_t>(patches);
  for (std::size_t i = 0; i < count; ++i) {
    text.begin_record(kRecord);
    read_rectangle(text, kRecord, plan.coefficients);
  }
  plan.coupling.assign(count * count, 1.0);
  for (std::size_t i = 0; i + 1 < count; ++i) {
    text.begin_record("the coupling factors");
    for (std::size_t j = i + 1; j < count; ++j) {
      const double factor = text.real(fmt::format("F{},{}", i + 1, j + 1));
      if (factor < 0.0 || factor > 1.0) text.fail(fmt::format("the coupling factor {} lies outside 0 ... 1", factor));
      plan.coupling[i * count + j] = plan.coupling[j * count + i] = factor;
    }
  }
  return plan;
}

PlanformInput read_planform(ContactText& text, long kind) {
  PlanformInput plan;
  if (kind == 4) return read_sub_patches(text);
  if (kind == 2) {
    plan.kind = PlanformInput::Kind::quadratic;
    plan.coefficients = read_list(text, "the quadratic planform", "B", 6, 1.0);
    for (std::size_t i = 0; i < 5; ++i) plan.coefficients[i] *= i < 3 ? kMilli * kMilli : kMilli;
  } else if (kind == 3) {
    constexpr std::string_view kRecord = "the two rectangles of the planform";
    plan.kind = PlanformInput::Kind::two_rectangles;
    text.begin_record(kRecord);
    for (int i = 0; i < 2; ++i) read_rectangle(text, kRecord, plan.coefficients);
  }
  return plan;
}

}  // namespace

void read_potential_contact(ContactReader& r) {
  ContactText& text = r.text;
  BasicCase& b = r.kept.basic;
  text.begin_record("the line IPOTCN");
  const long kind = text.integer("IPOTCN");
  if (kind < -6 || kind == 0 || kind > 4) text.fail(fmt::format("IPOTCN = {} does not exist", kind));

  text.begin_record("the potential contact line MX");
  const long mx = text.integer("MX"), my = text.integer("MY");
  if (mx < 1 || my < 1) text.fail("MX and MY must be positive");
  if (mx > kMostElements || my > kMostElements || mx * my > kMostElements)
    text.fail(fmt::format("potential contact too large: {} x {} elements, at most {}", mx, my, kMostElements));
  b.mx = static_cast<int>(mx);
  b.my = static_cast<int>(my);
  r.kept.potential_contact = static_cast<int>(kind);

  if (kind < 0) {
    r.kept.hertz = read_hertz(text, kind);
    b.x0 = b.y0 = b.dx = b.dy = 0.0;
    return;
  }

  const bool corner = kind <= 2;  // the first pair of numbers: lower left corner or centre of the first element
  double x = text.real(corner ? "XL" : "XC1") * kMillimetre;
  double y = text.real(corner ? "YL" : "YC1") * kMillimetre;
  if (kind == 1 || kind == 3) {
    b.dx = positive(text, "DX", kMillimetre);
    b.dy = positive(text, "DY", kMillimetre);
  } else {
    const double x_end = text.real(corner ? "XH" : "XCM") * kMillimetre;
    const double y_end = text.real(corner ? "YH" : "YCM") * kMillimetre;
    if (!corner && (mx < 2 || my < 2)) text.fail("IPOTCN = 4 needs at least two elements in each direction");
    b.dx = (x_end - x) / static_cast<double>(corner ? mx : mx - 1);
    b.dy = (y_end - y) / static_cast<double>(corner ? my : my - 1);
    if (!(b.dx > 0.0) || !(b.dy > 0.0)) text.fail("the potential contact has no extent");
  }
  b.x0 = corner ? x + 0.5 * b.dx : x;
  b.y0 = corner ? y + 0.5 * b.dy : y;
}

void read_gap(ContactReader& r) {
  ContactText& text = r.text;
  text.begin_record("the line IBASE");
  const long base = text.integer("IBASE");
  if (base != 9 && (base < 1 || base > 3)) text.fail(fmt::format("IBASE = {} does not exist", base));
  const long plan = text.integer("IPLAN");
  if (plan < 1 || plan > 4) text.fail(fmt::format("IPLAN = {} does not exist", plan));
  r.kept.gap = read_gap_formula(r, base);
  r.kept.gap_elements = static_cast<long>(r.kept.basic.mx) * r.kept.basic.my;
  r.kept.planform = read_planform(text, plan);
}

SurfaceSource read_profile(ContactReader& r, std::string_view body) {
  ContactText& text = r.text;
  text.begin_record(fmt::format("the {} profile line", body));
  GeometryFile source;
  ProfileOptions& options = source.options;
  const std::string name = text.quoted("the file name");
  const SourcePosition where = text.where();
  if (name.empty()) text.fail(fmt::format("the {} profile has no file name", body));
  source.file = resolve_name(r.folder, name);

  const long mirror_y = text.integer("MIRRORY");
  if (mirror_y < -1 || mirror_y > 1) text.fail("MIRRORY must be -1, 0 or 1");
  options.mirror_y = mirror_y == 1 ? 1 : 0;
  options.placement = ProfileOptions::Placement::reference;
  options.scale = text.real("SCALE");
  constexpr double kSmallestScale = 1e-6;
  if (options.scale < kSmallestScale) text.fail(fmt::format("SCALE must be at least {}", kSmallestScale));
  const double strength = text.real("SMOOTH");
  if (strength < 0.0) text.fail("SMOOTH must not be negative");

  long further = 0;
  if (const auto mirror_z = text.optional_integer()) {
    if (*mirror_z < -1 || *mirror_z > 1) text.fail("MIRRORZ must be -1, 0 or 1");
    options.mirror_z = static_cast<int>(*mirror_z);
    further = text.optional_integer().value_or(0);
    if (further < 0 || further > 2) text.fail("PRFOPT must be 0, 1 or 2");
  }

  SmoothingOptions& smoothing = options.smoothing = {};
  if (further >= 1) {
    text.begin_record("the profile option line ISMOOTH");
    const long method = text.integer("ISMOOTH");
    if (method < 0 || method > 2) text.fail("ISMOOTH must be 0, 1 or 2");
    smoothing.method = static_cast<SmoothingOptions::Method>(method);
    constexpr double kLeastZigzag = std::numbers::pi / 4.0;
    options.zigzag_threshold = std::max(kLeastZigzag, text.angle("ZIGTHRS"));
    smoothing.kink_high = text.angle("KINKHIGH");
    smoothing.kink_low = text.angle("KINKLOW");
    if (!(smoothing.kink_high > 0.0) || !(smoothing.kink_low > 0.0) || smoothing.kink_low > smoothing.kink_high)
      text.fail("the kink thresholds must satisfy 0 < KINKLOW <= KINKHIGH");
    smoothing.kink_width = text.real("KINKWID") * kMillimetre;
    if (smoothing.kink_width < 0.0) text.fail("KINKWID must not be negative");
  }
  if (further == 2) {
    text.begin_record("the profile option line ERRHND");
    options.error_handling = static_cast<int>(std::clamp(text.integer("ERRHND"), -100L, 100L));
    options.max_omit = text.real("MAXOMIT");
    if (options.max_omit < 0.0 || options.max_omit > 1.0) text.fail("MAXOMIT must lie in 0 ... 1");
    if (options.error_handling != 0)
      r.note(fmt::format("ERRHND = {} at {}: read, but errors in a profile always stop the run", options.error_handling,
                         text.where().to_string()));
  }
  // lambda is a volume in the unweighted method and a wavelength in the others.
  const bool wavelength = smoothing.method != SmoothingOptions::Method::spline;
  smoothing.strength = strength * (wavelength ? kMillimetre : kMillimetre * kMillimetre * kMillimetre);

  SurfaceSource surface;
  source.open_seam = is_slices_file(source.file);  // as in the reference program
  surface.geometry = source;
  surface.where = where;
  return surface;
}

}  // namespace treadmark::io

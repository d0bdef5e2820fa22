// SPDX-License-Identifier: MIT
#include "support/probe_file.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include <sphmbs/core/error.hpp>
#include <sphmbs/geometry/samples.hpp>
#include <sphmbs/io/vtp.hpp>

#include "support/text.hpp"

namespace sphmbs::examples {
namespace {

constexpr int most_points = 10'000;  // along a line, or the longer side of a plane

using Point3 = std::array<double, 3>;

std::string text_of(std::span<const double> place) {
  std::string text = "(";
  for (const double x : place) text += (text.size() > 1 ? ", " : "") + format_exact(x);
  return text + ")";
}

[[noreturn]] void refuse(const ProbeSpec& spec, const std::string& what, const char* id = "E052") {
  const std::string text = "probe \"" + spec.name + "\": " + what;
  if (!spec.place.source.empty()) {
    Complaints complaints;
    complaints.add(spec.place, id, text);
    complaints.raise();
  }
  throw InvalidInput(text, id);
}

bool may_name_file(const std::string& name) {
  return !name.empty() && std::all_of(name.begin(), name.end(), [](char c) {
    return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || (c >= '0' && c <= '9') || c == '-' ||
           c == '_';
  });
}

Point3 checked_place(const ProbeSpec& spec, const std::string& key,
                     const std::vector<double>& given, const ProbeSpace& space) {
  const auto dim = static_cast<std::size_t>(space.dim);
  if (given.size() != dim)
    refuse(spec, key + " = " + text_of(given) + ": must have " + std::to_string(dim) +
                     (dim > 1 ? " coordinates [m]" : " coordinate [m]"));
  Point3 place{};
  bool inside = true;
  for (std::size_t k = 0; k < dim; ++k) {
    if (!std::isfinite(given[k])) refuse(spec, key + " = " + text_of(given) + ": must be finite");
    place[k] = given[k];
    const double slack = 1e-9 * (space.upper[k] - space.lower[k]);
    inside = inside && (space.periodic[k] ||
                        (given[k] >= space.lower[k] - slack && given[k] <= space.upper[k] + slack));
  }
  if (!inside)
    refuse(spec,
           key + " = " + text_of(given) + " m: must lie in the domain, from " +
               text_of(std::span(space.lower).first(dim)) + " to " +
               text_of(std::span(space.upper).first(dim)) + " m",
           "E050");
  return place;
}

void check_points(const ProbeSpec& spec) {
  if (spec.points < 2 || spec.points > most_points)
    refuse(spec, "points = " + std::to_string(spec.points) + ": must be between 2 and " +
                     std::to_string(most_points));
}

void check_words(const ProbeSpec& spec) {
  if (!may_name_file(spec.name))
    refuse(spec, "its name must be made of letters, digits, - and _, since it names a file");
  if (spec.kind != "point" && spec.kind != "line" && spec.kind != "plane" && spec.kind != "volume")
    refuse(spec, "kind = \"" + spec.kind + "\": must be point, line, plane or volume");
  if (!(std::isfinite(spec.interval) && spec.interval >= 0))
    refuse(spec, "interval = " + format_exact(spec.interval) +
                     ": must be positive, or 0 for the interval of history.csv [s]");
  if (spec.fields.empty() && spec.kind != "volume") refuse(spec, "fields: must name at least one");
  const bool is_point = spec.kind == "point";
  if (is_point ? !(spec.from.empty() && spec.to.empty()) : !spec.at.empty())
    refuse(spec, is_point ? "a point is given by \"at\", without \"from\" and \"to\""
                          : "a " + spec.kind + " is given by \"from\" and \"to\", without \"at\"");
}

template <int Dim>
Vec<Dim> vec(const Point3& x) {
  Vec<Dim> v;
  for (int k = 0; k < Dim; ++k) v[k] = x[static_cast<std::size_t>(k)];
  return v;
}

template <int Dim>
void put_plane(ProbePlaces& places, const Point3& lower, const Point3& upper, int points) {
  const auto plane = geometry::points_across<Dim>({vec<Dim>(lower), vec<Dim>(upper)}, points);
  places.along_row = plane.along_row;
  for (const Vec<Dim>& x : plane.points) {
    Point3 place{};
    for (int k = 0; k < Dim; ++k) place[static_cast<std::size_t>(k)] = x[k];
    places.points.push_back(place);
  }
}

std::string number_of(std::int64_t frame) {
  const std::string digits = std::to_string(frame);
  return std::string(4 - std::min<std::size_t>(4, digits.size()), '0') + digits;
}

}  // namespace

ProbePlaces places_of(const ProbeSpec& spec, const ProbeSpace& space) {
  check_words(spec);
  ProbePlaces places;
  if (spec.kind == "point") {
    places.points = {checked_place(spec, "at", spec.at, space)};
    return places;
  }
  const Point3 from = checked_place(spec, "from", spec.from, space);
  const Point3 to = checked_place(spec, "to", spec.to, space);
  const std::string ends = "from " + text_of(spec.from) + " to " + text_of(spec.to) + " m";
  if (spec.kind == "line") {
    check_points(spec);
    for (const Vec<3>& x : geometry::points_along<3>(vec<3>(from), vec<3>(to), spec.points)) {
      places.points.push_back({x[0], x[1], x[2]});
      places.arc.push_back(std::sqrt(norm2(x - vec<3>(from))));
    }
    if (!(places.arc.back() > 0)) refuse(spec, ends + ": the ends of a line must differ");
    return places;
  }
  Point3 lower, upper;
  int extents = 0;
  for (std::size_t k = 0; k < 3; ++k) {
    lower[k] = std::min(from[k], to[k]);
    upper[k] = std::max(from[k], to[k]);
    extents += upper[k] > lower[k];
    if (spec.kind == "volume" && space.periodic[k] &&
        upper[k] - lower[k] > (space.upper[k] - space.lower[k]) * (1 + 1e-12))
      refuse(spec, ends + ": must not be longer than the period");
  }
  if (spec.kind == "volume") {
    if (extents != space.dim)
      refuse(spec, ends + ": a volume must extend along " + std::to_string(space.dim) +
                       (space.dim > 1 ? " axes" : " axis"));
    places.points = {lower, upper};
    return places;
  }
  check_points(spec);
  if (extents != 2 || space.dim == 1)
    refuse(spec, ends + ": a plane must extend along two axes, and have no extent along the third");
  if (space.dim == 2)
    put_plane<2>(places, lower, upper, spec.points);
  else
    put_plane<3>(places, lower, upper, spec.points);
  return places;
}

ProbeFile::ProbeFile(ProbeSpec spec, const ProbeSpace& space)
    : spec_(std::move(spec)), space_(space), places_(places_of(spec_, space)) {}

std::vector<io::CsvWriter::Column> ProbeFile::head(
    const std::vector<io::CsvWriter::Column>& columns) const {
  std::vector<io::CsvWriter::Column> head{{"t", "s"}};
  if (spec_.kind == "line") head.push_back({"s", "m"});
  if (spec_.kind == "plane")
    for (int k = 0; k < space_.dim; ++k) head.push_back({std::string(1, "xyz"[k]), "m"});
  head.insert(head.end(), columns.begin(), columns.end());
  return head;
}

void ProbeFile::begin(const std::filesystem::path& folder, const std::string& comment,
                      const std::vector<io::CsvWriter::Column>& columns,
                      const std::optional<ProbeProgress>& resume) {
  folder_ = folder;
  columns_ = columns;
  const std::filesystem::path path = folder / ("probe_" + spec_.name + ".csv");
  if (resume) {
    progress_ = *resume;
    csv_.emplace(path, head(columns).size(), static_cast<std::uintmax_t>(resume->bytes));
    return;
  }
  progress_ = {};
  const std::string where = spec_.kind == "point"
                                ? " at " + text_of(spec_.at)
                                : " from " + text_of(spec_.from) + " to " + text_of(spec_.to);
  csv_.emplace(path, comment + ", " + spec_.kind + where + " m", head(columns));
  progress_.bytes = static_cast<std::int64_t>(csv_->bytes());
}

void ProbeFile::write(double time, std::span<const double> values) {
  const std::size_t width = columns_.size(), rows = values.size() / width;
  for (std::size_t i = 0; i < rows; ++i) {
    std::vector<double> row{time};
    if (spec_.kind == "line") row.push_back(places_.arc[i]);
    if (spec_.kind == "plane")
      row.insert(row.end(), places_.points[i].begin(), places_.points[i].begin() + space_.dim);
    const auto own = values.subspan(i * width, width);
    row.insert(row.end(), own.begin(), own.end());
    csv_->row(row);
  }
  csv_->flush();
  ++progress_.samples;
  progress_.rows += static_cast<std::int64_t>(rows);
  progress_.bytes = static_cast<std::int64_t>(csv_->bytes());
  progress_.sampled = time;
  if (spec_.kind == "plane") write_surface(time, values);
}

void ProbeFile::write_surface(double time, std::span<const double> values) const {
  io::Mesh mesh;
  for (const Point3& x : places_.points) mesh.points.insert(mesh.points.end(), x.begin(), x.end());
  const auto row = static_cast<std::int64_t>(places_.along_row);
  const auto points = static_cast<std::int64_t>(places_.points.size());
  for (std::int64_t corner = 0; corner + row + 1 < points; ++corner)
    if ((corner + 1) % row != 0)
      mesh.polygons.add({corner, corner + 1, corner + row + 1, corner + row});
  for (std::size_t f = 0; f < columns_.size(); ++f) {
    std::vector<double> column;
    for (std::size_t i = f; i < values.size(); i += columns_.size()) column.push_back(values[i]);
    mesh.arrays.push_back({columns_[f].name + " [" + columns_[f].unit + "]", 1, std::move(column)});
  }
  io::write_vtp(folder_ / ("probe_" + spec_.name + "_" + number_of(progress_.samples) + ".vtp"),
                mesh, time);
}

std::vector<std::string> ProbeFile::names() const {
  std::vector<std::string> names{"probe_" + spec_.name + ".csv"};
  if (spec_.kind == "plane" && progress_.samples > 0)
    names.push_back("probe_" + spec_.name + "_" + number_of(progress_.samples) + ".vtp");
  return names;
}

}  // namespace sphmbs::examples

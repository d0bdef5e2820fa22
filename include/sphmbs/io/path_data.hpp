// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <charconv>
#include <cmath>
#include <cstddef>
#include <string>
#include <string_view>
#include <system_error>

#include <sphmbs/core/math.hpp>
#include <sphmbs/io/geometry_file.hpp>
#include <sphmbs/io/outline_builder.hpp>

/// Path data of SVG: commands M L H V C S Q T A Z with their numbers; small letters are relative.
namespace sphmbs::io::detail {

/// The curve of an arc command, which is told by its ends, radii, tilt and two choices: the
/// longer of two arcs, and that on which the angle rises (SVG 1.1,
/// appendix F.6). Radii that are too short grow until they reach; an arc that cannot be told from
/// its chord has no turn.
inline EllipseArc ellipse_arc(const Vec<2>& from, double rx, double ry, double tilt, bool large,
                              bool rising, const Vec<2>& to) {
  const double c = std::cos(tilt), s = std::sin(tilt);
  const Vec<2> half = 0.5 * (from - to);
  const double chord = std::sqrt(norm2(half));
  rx = std::abs(rx);
  ry = std::abs(ry);
  EllipseArc arc{from, {0, 0}, {0, 0}, 0, 0, to};
  const auto [shorter, longer] = std::minmax({rx, ry});
  if (!(shorter > 1e-9 * chord && chord > 1e-9 * longer)) return arc;
  double x = (c * half[0] + s * half[1]) / rx, y = (c * half[1] - s * half[0]) / ry;
  const double reach = std::sqrt(x * x + y * y);
  if (reach > 1) {
    rx *= reach;
    ry *= reach;
    x /= reach;
    y /= reach;
  }
  const double square = x * x + y * y;
  const double off = (large == rising ? -1 : 1) * std::sqrt(std::max(0.0, 1 / square - 1));
  const double u = off * y, v = -off * x;  // the centre, in units of the radii
  arc.first = {c * rx, s * rx};
  arc.second = {-s * ry, c * ry};
  arc.centre = 0.5 * (from + to) + u * arc.first + v * arc.second;
  arc.begin = std::atan2(y - v, x - u);
  arc.turn = std::atan2(-y - v, -x - u) - arc.begin;
  if (rising && arc.turn < 0) arc.turn += 2 * math::pi;
  if (!rising && arc.turn > 0) arc.turn -= 2 * math::pi;
  return arc;
}

/// The corners of a path and of its curves: how many there are and how far apart.
struct PathExtent {
  geometry::Box<2> box{{1e300, 1e300}, {-1e300, -1e300}};
  std::size_t points = 0;

  void line(const Vec<2>& to) {
    ++points;
    for (int k = 0; k < 2; ++k) {
      box.lower[k] = std::min(box.lower[k], to[k]);
      box.upper[k] = std::max(box.upper[k], to[k]);
    }
  }
  void cubic(const Cubic& c) {
    line(c.towards);
    line(c.away);
    line(c.to);
  }
  void arc(const EllipseArc& a) { line(a.to); }
  std::size_t close() { return 0; }
  std::size_t size() const { return 0; }
};

/// Follows a path and tells a sink of its lines and curves.
template <class Sink>
class PathData {
 public:
  PathData(std::string_view text, std::string_view name, double unit, Sink& sink)
      : text_(text), name_(name), unit_(unit), most_points_(text.size() + 1'000'000), sink_(sink) {}

  void follow() {
    skip_blanks();
    while (at_ < text_.size()) {
      const char letter = text_[at_];
      constexpr std::string_view commands = "MmLlHhVvCcSsQqTtAaZz";
      if (commands.find(letter) == std::string_view::npos)
        fail("a command such as M, L, C, A or Z");
      if (!begun_ && letter != 'M' && letter != 'm') fail("M, with which a path begins");
      ++at_;
      run(letter);
      skip_blanks();
    }
    close();
  }

 private:
  void run(char letter) {
    const bool relative = letter >= 'a';
    const char command = relative ? static_cast<char>(letter - 'a' + 'A') : letter;
    if (command == 'Z') {
      close();
      here_ = start_;
      previous_ = command;
      return;
    }
    bool first = true;
    do {
      base_ = relative ? here_ : Vec<2>{0, 0};
      step(command == 'M' && !first ? 'L' : command);
      first = false;
      if (sink_.size() > most_points_) fail("fewer curves, or a larger flatness: too many points");
      skip_blanks();
    } while (at_ < text_.size() && is_number_start(text_[at_]));
  }

  void step(char command) {
    const Vec<2> from = here_;
    if (command == 'M') {
      close();
      start_ = here_ = point();
      begun_ = true;
    } else {
      if (!open_) sink_.line(from);
      open_ = true;
    }
    if (command == 'L') sink_.line(here_ = point());
    if (command == 'H') sink_.line(here_ = {base_[0] + length(), from[1]});
    if (command == 'V') sink_.line(here_ = {from[0], base_[1] + length()});
    if (command == 'C' || command == 'S') {
      const bool smooth = command == 'S';
      const Vec<2> towards = !smooth ? point() : previous_ == 'C' ? mirrored() : from;
      const Vec<2> away = point();
      control_ = away;
      here_ = point();
      sink_.cubic({from, towards, away, here_});
      command = 'C';
    }
    if (command == 'Q' || command == 'T') {
      control_ = command == 'Q' ? point() : previous_ == 'Q' ? mirrored() : from;
      here_ = point();
      sink_.cubic(
          {from, (1.0 / 3) * (from + 2.0 * control_), (1.0 / 3) * (2.0 * control_ + here_), here_});
      command = 'Q';
    }
    if (command == 'A') {
      const double rx = length(), ry = length(), tilt = number() * math::pi / 180;
      const bool large = flag(), rising = flag();
      here_ = point();
      const EllipseArc arc = ellipse_arc(from, rx, ry, tilt, large, rising, here_);
      if (arc.turn == 0)
        sink_.line(here_);
      else
        sink_.arc(arc);
    }
    previous_ = command;
  }

  void close() {
    open_ = false;
    if (sink_.close() == 2) fail("a third corner of the outline that ends here");
  }

  Vec<2> mirrored() const { return 2.0 * here_ - control_; }
  Vec<2> point() {
    const double x = base_[0] + length();
    return {x, base_[1] + length()};
  }
  double length() {
    const std::size_t begin = at_;
    const double scaled = unit_ * number();
    if (!(std::abs(scaled) <= 1e-6 * geometry::Facets<2>::farthest)) {  // relative ones add up
      at_ = begin;
      fail("a finite coordinate below 1e24 m");
    }
    return scaled;
  }
  double number() {
    skip_blanks();
    const std::size_t begin = at_ < text_.size() && text_[at_] == '+' ? at_ + 1 : at_;
    double value = 0;
    const auto [end, error] =
        std::from_chars(text_.data() + begin, text_.data() + text_.size(), value);
    if (error != std::errc{} || !std::isfinite(value)) fail("a number");
    at_ = static_cast<std::size_t>(end - text_.data());
    return value;
  }
  bool flag() {
    skip_blanks();
    if (at_ >= text_.size() || (text_[at_] != '0' && text_[at_] != '1')) fail("0 or 1");
    return text_[at_++] == '1';
  }

  static bool is_number_start(char c) {
    return (c >= '0' && c <= '9') || c == '-' || c == '+' || c == '.';
  }
  void skip_blanks() {
    while (at_ < text_.size()) {
      if (text_[at_] == '#')
        at_ = std::min(text_.find('\n', at_), text_.size());
      else if (std::string_view(" \t\r\n\v\f,").find(text_[at_]) != std::string_view::npos)
        ++at_;
      else
        return;
    }
  }

  [[noreturn]] void fail(const std::string& allowed) const {
    const auto line = 1 + std::count(text_.begin(), text_.begin() + static_cast<long>(at_), '\n');
    const std::string_view rest = text_.substr(at_);
    const std::string found =
        rest.empty() ? "nothing" : quoted(rest.substr(0, rest.find_first_of(" \t\r\n,")));
    throw InvalidInput(
        name_ + ":" + std::to_string(line) + ": " + found + " found: must be " + allowed, "E153");
  }

  std::string_view text_;
  std::string name_;
  double unit_;
  std::size_t most_points_;
  Sink& sink_;
  std::size_t at_ = 0;
  bool begun_ = false, open_ = false;
  char previous_ = ' ';
  Vec<2> here_{0, 0}, start_{0, 0}, base_{0, 0}, control_{0, 0};
};

}  // namespace sphmbs::io::detail

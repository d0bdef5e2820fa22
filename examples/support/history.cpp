// SPDX-License-Identifier: MIT
#include "support/history.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <stdexcept>

#include <Eigen/QR>

namespace sphmbs::examples {

void History::add(const std::string& name, const std::string& unit) {
  columns_.push_back({name, unit});
  values_.emplace_back();
}

void History::begin(const std::filesystem::path& path, const std::string& comment) {
  std::vector<io::CsvWriter::Column> columns{{"t", "s"}};
  columns.insert(columns.end(), columns_.begin(), columns_.end());
  if (restored_bytes_ > 0)
    file_ = std::make_unique<io::CsvWriter>(path, columns.size(), restored_bytes_);
  else
    file_ = std::make_unique<io::CsvWriter>(path, comment, columns);
  file_->flush();
}

void History::row(double time, const std::vector<double>& values) {
  if (values.size() != values_.size())
    throw std::invalid_argument("History::row: " + std::to_string(values.size()) + " values for " +
                                std::to_string(values_.size()) + " quantities");
  time_.push_back(time);
  std::vector<double> line{time};
  for (std::size_t k = 0; k < values.size(); ++k) {
    values_[k].push_back(values[k]);
    line.push_back(values[k]);
  }
  if (file_) {
    file_->row(line);
    file_->flush();
  }
}

bool History::has(const std::string& name) const {
  return std::any_of(columns_.begin(), columns_.end(),
                     [&](const auto& column) { return column.name == name; });
}

const std::vector<double>& History::of(const std::string& name) const {
  for (std::size_t k = 0; k < columns_.size(); ++k)
    if (columns_[k].name == name) return values_[k];
  throw std::out_of_range("History::of: no quantity " + name);
}

double History::at(const std::string& name, double time) const {
  const std::vector<double>& y = of(name);
  const double slack = 1e-9 * std::max(1.0, std::abs(time));
  if (time_.empty() || time < time_.front() - slack || time > time_.back() + slack)
    return std::numeric_limits<double>::quiet_NaN();
  const auto after = std::lower_bound(time_.begin(), time_.end(), time - slack);
  const auto i = static_cast<std::size_t>(after - time_.begin());
  if (i == 0 || std::abs(time_[i] - time) <= slack) return y[i];
  const double s = (time - time_[i - 1]) / (time_[i] - time_[i - 1]);
  return (1 - s) * y[i - 1] + s * y[i];
}

Curve History::curve(const std::string& name, const std::string& label) const {
  Curve curve;
  curve.label = label;
  curve.x = time_;
  curve.y = of(name);
  return curve;
}

double rms_difference(const History& history, const std::string& name,
                      const std::vector<double>& time, const std::vector<double>& reference,
                      const std::vector<double>& scale, double from, double to) {
  double sum = 0;
  int n = 0;
  for (std::size_t i = 0; i < time.size(); ++i) {
    const double value = history.at(name, time[i]);
    if (time[i] < from - 1e-9 || time[i] > to + 1e-9 || std::isnan(value)) continue;
    const double difference = (value - reference[i]) / scale[i];
    sum += difference * difference;
    ++n;
  }
  return n > 0 ? std::sqrt(sum / n) : std::numeric_limits<double>::quiet_NaN();
}

Spread spread_of(const History& history, const std::string& name, double from, double to) {
  std::vector<double> s, x;
  for (std::size_t i = 0; i < history.time().size(); ++i) {
    const double t = history.time()[i];
    if (t < from || t > to) continue;
    s.push_back((t - from) / (to - from));
    x.push_back(history.of(name)[i]);
  }
  const double nothing = std::numeric_limits<double>::quiet_NaN();
  if (s.size() < 4) return {nothing, nothing};
  const auto n = static_cast<Eigen::Index>(s.size());
  const Eigen::Map<const Eigen::ArrayXd> at(s.data(), n);
  const Eigen::Map<const Eigen::VectorXd> value(x.data(), n);
  Eigen::MatrixX3d powers(n, 3);
  powers << Eigen::VectorXd::Ones(n), at.matrix(), at.square().matrix();
  const Eigen::VectorXd rest = value - powers * powers.colPivHouseholderQr().solve(value);
  return {value.mean(), std::sqrt(rest.squaredNorm() / static_cast<double>(n - 3))};
}

Curve ReferenceCurve::curve(const std::string& label, double until) const {
  Curve curve{
      .label = label, .style = {.line = Line::none, .marker = Marker::circle}, .reference = true};
  for (std::size_t i = 0; i < time.size(); ++i) {
    if (time[i] > until + 1e-9) break;
    curve.x.push_back(time[i]);
    curve.y.push_back(value[i]);
  }
  curve.style.marker_every = 1 + static_cast<int>(curve.x.size()) / 30;
  return curve;
}

double ReferenceCurve::at(double when) const {
  for (std::size_t i = 0; i < time.size(); ++i)
    if (std::abs(time[i] - when) < 1e-9) return value[i];
  return std::numeric_limits<double>::quiet_NaN();
}

Curve ReferenceCurve::difference(const History& history, const std::string& name,
                                 const std::string& label) const {
  Curve curve{.label = label};
  for (std::size_t i = 0; i < time.size(); ++i) {
    const double difference = history.at(name, time[i]) - value[i];
    if (std::isnan(difference)) continue;
    curve.x.push_back(time[i]);
    curve.y.push_back(difference);
  }
  return curve;
}

double largest_until(const Curve& curve, double time) {
  double largest = 0;
  for (std::size_t i = 0; i < curve.x.size(); ++i)
    if (curve.x[i] <= time + 1e-9) largest = std::max(largest, std::abs(curve.y[i]));
  return largest;
}

}  // namespace sphmbs::examples

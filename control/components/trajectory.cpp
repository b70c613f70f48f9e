#include <algorithm>
#include <cmath>
#include <stdexcept>
#include <string_view>

#include "control/component.h"
#include "control/data/curve.h"
#include "control/data/table.h"
#include "control/registry.h"

namespace hookpoint::control {
namespace {

/// Joint goals over time from a table. It has no memory: its outputs depend on the time alone.
class Trajectory final : public Component, public ReadsTable {
 public:
  static constexpr std::size_t size = 24;

  TableFields table{*this};
  Text columns{*this, "columns",
               "titles, names or numbers of the goals' columns, between commas; default: all but "
               "the times"};
  Text interpolate =
      Text{*this, "interpolate", "between two rows", "cubic"}.choices({"linear", "cubic"});
  Text outside = Text{*this, "outside", "before the first row and after the last", "hold"}.choices(
      {"hold", "repeat"});
  Output goal{*this, "goal", "?", "the columns, in order", size};
  Output goal_rate{*this, "goal_rate", "?", "their rates of change", size};

  void start(double) override {
    Table read = table.read(wanted(), report_);
    const std::string& file = table.file.value();
    if (read.columns.size() > size) {
      throw std::runtime_error(file + ": " + std::to_string(read.columns.size()) +
                               " goals, at most " + std::to_string(size) +
                               " are possible: `columns` says which");
    }
    for (std::size_t i = 0; i < read.units.size(); ++i) {
      const text::SeriesColumn& column = read.units[i];
      if (column.unit.empty()) continue;
      const text::Dimension dimension = column.scale.dimension;
      report_.units.push_back({"goal", i, column.unit, dimension});
      report_.units.push_back(
          {"goal_rate", i, column.unit + "/s", dimension / text::Dimension{0, 0, 1, 0}});
    }
    repeat_ = report_.repeats = outside.value() == "repeat";
    begin_ = read.time.front();
    end_ = read.time.back();
    if (repeat_ && read.time.size() < 2) {
      throw std::runtime_error(file + ": outside = repeat needs two rows or more");
    }
    const auto shape = interpolate.value() == "linear" ? Curve::Shape::linear : Curve::Shape::cubic;
    curves_.clear();
    for (std::vector<double>& column : read.columns) {
      const bool closed = repeat_ && column.front() == column.back();
      curves_.emplace_back(read.time, std::move(column), shape, closed);
    }
  }

  void update(const Tick& tick) override {
    double time = tick.time - table.start;
    if (repeat_) time = within_round(time);
    for (std::size_t i = 0; i < curves_.size(); ++i) {
      const Curve::Sample sample = curves_[i].at(time);
      goal.set(i, sample.value);
      goal_rate.set(i, sample.rate);
    }
  }

 private:
  /// The columns that the file names, without the blanks around them.
  std::vector<std::string> wanted() const {
    std::vector<std::string> names;
    std::string_view rest = columns.value();
    while (!rest.empty()) {
      const std::size_t end = std::min(rest.find(','), rest.size());
      const std::string_view name = rest.substr(0, end);
      const std::size_t first = name.find_first_not_of(' ');
      if (first != std::string_view::npos)
        names.emplace_back(name.substr(first, name.find_last_not_of(' ') - first + 1));
      rest.remove_prefix(std::min(end + 1, rest.size()));
    }
    return names;
  }

  /// `time` less as many whole rounds as bring it into the table; the last row belongs to the next
  /// round.
  double within_round(double time) const {
    const double duration = end_ - begin_;
    const double since = std::fmod(time - begin_, duration);
    const double moment = begin_ + (since < 0. ? since + duration : since);
    return moment < end_ ? moment : begin_;
  }

  std::vector<Curve> curves_;
  double begin_ = 0., end_ = 0.;
  bool repeat_ = false;
};

}  // namespace
HOOKPOINT_REGISTER_COMPONENT(Trajectory, "Controller.Trajectory",
                             "joint goals over time from a table", Attachment::none, "", "goal")
}  // namespace hookpoint::control

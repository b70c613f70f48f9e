#include <cmath>
#include <stdexcept>

#include "control/component.h"
#include "control/data/curve.h"
#include "control/data/table.h"
#include "control/registry.h"

namespace hookpoint::control {
namespace {

/// Joint goals over time from a table. It has no memory: its outputs depend on the time alone.
class Trajectory final : public Component {
 public:
  static constexpr std::size_t size = 24;

  Text file =
      Text{*this, "file", "CSV file: a row of names, the time, then a column a goal"}.path();
  Text interpolate =
      Text{*this, "interpolate", "between two rows", "cubic"}.choices({"linear", "cubic"});
  Text outside = Text{*this, "outside", "before the first row and after the last", "hold"}.choices(
      {"hold", "repeat"});
  Parameter start_time{*this, "start", "s", 0., "time of the simulation at the table's time 0"};
  Output goal{*this, "goal", "?", "the columns after the time, in order", size};
  Output goal_rate{*this, "goal_rate", "?", "their rates of change", size};

  void start(double) override {
    if (file.value().empty()) throw std::runtime_error("file is not given");
    Table table = read_csv_table(file.value());
    if (table.columns.size() > size) {
      throw std::runtime_error(file.value() + ": " + std::to_string(table.columns.size()) +
                               " goals, at most " + std::to_string(size) + " are possible");
    }
    repeat_ = outside.value() == "repeat";
    begin_ = table.time.front();
    end_ = table.time.back();
    if (repeat_ && table.time.size() < 2) {
      throw std::runtime_error(file.value() + ": outside = repeat needs two rows or more");
    }
    const auto shape = interpolate.value() == "linear" ? Curve::Shape::linear : Curve::Shape::cubic;
    curves_.clear();
    for (std::vector<double>& column : table.columns) {
      const bool closed = repeat_ && column.front() == column.back();
      curves_.emplace_back(table.time, std::move(column), shape, closed);
    }
  }

  void update(const Tick& tick) override {
    double time = tick.time - start_time;
    if (repeat_) time = within_round(time);
    for (std::size_t i = 0; i < curves_.size(); ++i) {
      const Curve::Sample sample = curves_[i].at(time);
      goal.set(i, sample.value);
      goal_rate.set(i, sample.rate);
    }
  }

 private:
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

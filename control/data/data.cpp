#include <stdexcept>

#include "control/component.h"
#include "control/data/table.h"
#include "control/registry.h"

namespace hookpoint::control {
namespace {

/// A time series from a file. Before its first sample and after its last it holds that sample's
/// value.
class Data final : public Component, public ReadsTable {
 public:
  TableFields table{*this};
  Text column{*this, "column", "title, name or number of the column, or name of the MAT variable"};
  Text interpolate =
      Text{*this, "interpolate", "between two samples", "linear"}.choices({"hold", "linear"});
  Output output{*this, "output", "?", "the series at the time of the simulation"};

  void start(double) override {
    if (column.value().empty() && !table.file.value().empty())
      throw std::runtime_error("column is not given");
    Table read = table.read({column.value()}, report_);
    time_ = std::move(read.time);
    value_ = std::move(read.columns[0]);
    if (!read.units[0].unit.empty())
      report_.units.push_back({"output", 0, read.units[0].unit, read.units[0].scale.dimension});
    linear_ = interpolate.value() == "linear";
  }

  void update(const Tick& tick) override { output = linear_ ? interpolated(tick) : held(tick); }

 private:
  double held(const Tick& tick) const {
    // k dt may fall short of the decimal number in the file: a millionth of a period counts as
    // reached.
    return value_[row_at(time_, tick.time - table.start + 1e-6 * tick.period)];
  }
  double interpolated(const Tick& tick) const {
    const double time = tick.time - table.start;
    const std::size_t row = row_at(time_, time);
    const std::vector<double>& t = time_;
    const std::vector<double>& y = value_;
    if (time <= t.front() || row + 1 == t.size()) return y[row];
    return y[row] + (y[row + 1] - y[row]) * (time - t[row]) / (t[row + 1] - t[row]);
  }

  std::vector<double> time_, value_;
  bool linear_ = true;
};

}  // namespace
HOOKPOINT_REGISTER_COMPONENT(Data, "Data", "a time series read from a file")
}  // namespace hookpoint::control

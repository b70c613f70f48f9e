#include <stdexcept>

#include "control/component.h"
#include "control/data/table.h"
#include "control/registry.h"

namespace hookpoint::control {
namespace {

/// A time series from a file. Before its first sample and after its last it holds that sample's
/// value.
class Data final : public Component {
 public:
  Text file = Text{*this, "file", "CSV file, or MAT file by the ending .mat"}.path();
  Text column{*this, "column", "name of the column or of the MAT variable"};
  Text interpolate =
      Text{*this, "interpolate", "between two samples", "linear"}.choices({"hold", "linear"});
  Output output{*this, "output", "?", "the series at the time of the simulation"};

  void start(double) override {
    if (file.value().empty()) throw std::runtime_error("file is not given");
    if (column.value().empty()) throw std::runtime_error("column is not given");
    series_ = file.value().ends_with(".mat") ? read_mat_series(file.value(), column.value())
                                             : read_csv_series(file.value(), column.value());
    linear_ = interpolate.value() == "linear";
  }

  void update(const Tick& tick) override { output = linear_ ? interpolated(tick) : held(tick); }

 private:
  double held(const Tick& tick) const {
    // k dt may fall short of the decimal number in the file: a millionth of a period counts as
    // reached.
    return series_.value[row_at(series_.time, tick.time + 1e-6 * tick.period)];
  }
  double interpolated(const Tick& tick) const {
    const std::size_t row = row_at(series_.time, tick.time);
    const std::vector<double>& t = series_.time;
    const std::vector<double>& y = series_.value;
    if (tick.time <= t.front() || row + 1 == t.size()) return y[row];
    return y[row] + (y[row + 1] - y[row]) * (tick.time - t[row]) / (t[row + 1] - t[row]);
  }

  Series series_;
  bool linear_ = true;
};

}  // namespace
HOOKPOINT_REGISTER_COMPONENT(Data, "Data", "a time series read from a file")
}  // namespace hookpoint::control

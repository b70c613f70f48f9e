#include "output/figures/plot_legend.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace hookpoint::output {
namespace {

int lane_of(const std::vector<int>& lanes, std::size_t series) {
  return static_cast<int>(std::find(lanes.begin(), lanes.end(), static_cast<int>(series)) -
                          lanes.begin());
}

/// The end of what is drawn of a series: its last point, or the last run that did not finish.
void set_end(LegendEntry& entry, const Series& series, const Layout& layout) {
  double x = -std::numeric_limits<double>::infinity();
  const Curve& curve = series.reference ? series.predicted : series.measured;
  for (std::size_t i = 0; i < curve.x.size(); ++i) {
    if (curve.x[i] < x) continue;
    x = curve.x[i];
    const double y = curve.y[i];
    entry.end_y = !layout.y.logarithmic ? y
                  : layout.y.below_floor(y)
                      ? layout.floor_lane(lane_of(layout.strips.below_floor, entry.series))
                      : std::abs(y);
  }
  for (const double stopped : series.unfinished) {
    if (!curve.x.empty() || stopped <= x) continue;
    x = stopped;
    entry.end_y = layout.unfinished_lane(lane_of(layout.strips.unfinished, entry.series));
  }
  entry.end_x = layout.x.logarithmic ? std::max(x, layout.x.range_low) : x;
}

struct Pool {
  double sum = 0.;
  std::size_t count = 0;
  double mean() const { return sum / static_cast<double>(count); }
};

/// The non-decreasing sequence nearest to `wanted`.
std::vector<double> isotonic(const std::vector<double>& wanted) {
  std::vector<Pool> pools;
  for (const double value : wanted) {
    pools.push_back({value, 1});
    while (pools.size() > 1 && pools[pools.size() - 2].mean() > pools.back().mean()) {
      const Pool last = pools.back();
      pools.pop_back();
      pools.back().sum += last.sum;
      pools.back().count += last.count;
    }
  }
  std::vector<double> result;
  for (const Pool& pool : pools) result.insert(result.end(), pool.count, pool.mean());
  return result;
}

}  // namespace

std::vector<LegendEntry> place_legend(const Plot& plot, const Layout& layout,
                                      const LegendRoom& room) {
  std::vector<LegendEntry> entries(plot.series.size());
  for (std::size_t i = 0; i < entries.size(); ++i) {
    entries[i].series = i;
    set_end(entries[i], plot.series[i], layout);
    entries[i].height =
        room.bottom + layout.y.fraction(entries[i].end_y) * (room.top - room.bottom);
    entries[i].leads = layout.x.fraction(entries[i].end_x) > 0.5;
  }
  std::stable_sort(entries.begin(), entries.end(),
                   [](const LegendEntry& a, const LegendEntry& b) { return a.height > b.height; });
  // Counted from the top and less the spacing that entries above need, heights must not increase.
  std::vector<double> depth;
  for (std::size_t i = 0; i < entries.size(); ++i)
    depth.push_back(room.top - entries[i].height - static_cast<double>(i) * room.spacing);
  const double most =
      room.top - room.bottom - static_cast<double>(entries.size() - 1) * room.spacing;
  depth = isotonic(depth);
  for (std::size_t i = 0; i < entries.size(); ++i)
    entries[i].height = room.top - std::clamp(depth[i], 0., std::max(most, 0.)) -
                        static_cast<double>(i) * room.spacing;
  return entries;
}

}  // namespace hookpoint::output

#include "studies/blocks/times.h"

#include <utility>

namespace hookpoint::studies {

Fields<TimesBlock> times_fields(std::string duration, std::string settle) {
  return {positive(number_field("duration", "s", &TimesBlock::duration, std::move(duration))),
          not_negative(number_field("settle", "s", &TimesBlock::settle, std::move(settle))),
          positive(number_field("quick_duration", "s", &TimesBlock::quick_duration,
                                "duration under --quick; default: a fifth")),
          not_negative(number_field("quick_settle", "s", &TimesBlock::quick_settle,
                                    "settle under --quick; default: a fifth"))};
}

RunTimes load_times(const TimesBlock& block, bool quick, std::optional<double> otherwise) {
  constexpr double quick_part = 0.2;
  RunTimes times{*block.settle, block.duration ? block.duration.value : otherwise};
  if (!quick) return times;
  const bool cut_short = times.duration || block.quick_duration;
  if (block.quick_settle)
    times.settle = *block.quick_settle;
  else if (cut_short)
    times.settle *= quick_part;
  if (block.quick_duration)
    times.duration = block.quick_duration.value;
  else if (times.duration)
    times.duration = quick_part * *times.duration;
  return times;
}

}  // namespace hookpoint::studies

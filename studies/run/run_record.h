// What is kept of a finished run, under names, so that every study finds in it what it requires.
#pragma once

#include <map>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "studies/measure/regime.h"

namespace hookpoint::studies {

/// A metric of the run and its closed form.
struct KeptValue {
  std::optional<double> measured, predicted;
  std::string no_form =
      {};  ///< why there is no closed form; "" where it is not known or there is one
};

/// Numbers that were recorded along the run, in the layout of whoever recorded them.
struct KeptCurve {
  std::size_t size = 0;
  std::vector<double> samples;  ///< `size` of them, or none where only the numbers were read
};

struct RunRecord {
  std::string status = "ok";
  std::vector<std::string> notices;  ///< of its engine
  Regime regime = Regime::none;
  std::map<std::string, KeptValue> values;
  std::map<std::string, KeptCurve> curves;

  /// Its engine, a program, ended on the way: another try may do.
  bool lost_engine() const { return status.starts_with("engine_lost"); }
  /// Takes what `other`, a record of the same run, has beside this one's.
  void merge(RunRecord other);
};

/// All but the samples, a line each: values with as many digits as read back to the same double,
/// and at the end a hash of it all. The status and each notice are written on one line.
std::string numbers_text(const RunRecord& record);
/// Nothing when a byte of it is missing or changed. Its curves have sizes and no samples.
std::optional<RunRecord> read_numbers(std::string_view text);

/// The samples of all curves: doubles, least byte first, and a hash.
std::string samples_bytes(const RunRecord& record);
/// Gives the curves of `record`, as read by `read_numbers`, their samples; false when these are not
/// whole.
bool read_samples(std::string_view bytes, RunRecord& record);

}  // namespace hookpoint::studies

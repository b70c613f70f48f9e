// The one file that sees libmatio.
#include <matio.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <filesystem>
#include <fstream>
#include <memory>
#include <stdexcept>
#include <string_view>

#include "control/data/table.h"
#include "text/formats.h"
#include "text/letters.h"

namespace hookpoint::control {
namespace {

/// "'a', 'b' and 7 more".
std::string list_of_names(const std::vector<std::string>& names) {
  constexpr std::size_t most = 20;
  std::string list;
  for (std::size_t i = 0; i < std::min(names.size(), most); ++i)
    list += (i == 0 ? "'" : ", '") + text::shown(names[i]) + "'";
  if (names.size() > most) list += " and " + std::to_string(names.size() - most) + " more";
  return list;
}

/// Throws unless `time` is finite and increases strictly; `where` begins the message, as "x.mat:
/// 'time'".
void check_increasing(const std::vector<double>& time, const std::string& where) {
  for (std::size_t i = 0; i < time.size(); ++i) {
    if (!std::isfinite(time[i])) {
      throw std::runtime_error(where + ": element " + std::to_string(i + 1) + " is not finite");
    }
    if (i > 0 && time[i] <= time[i - 1]) {
      throw std::runtime_error(where + ": element " + std::to_string(i + 1) +
                               " is not after the one before");
    }
  }
}

struct CloseFile {
  void operator()(mat_t* file) const { Mat_Close(file); }
};
struct FreeVariable {
  void operator()(matvar_t* variable) const { Mat_VarFree(variable); }
};

template <class Number>
std::vector<double> copied(const matvar_t& variable, std::size_t count) {
  const auto* data = static_cast<const Number*>(variable.data);
  return {data, data + count};
}

/// The elements of a real row or column vector; empty for anything else.
std::vector<double> elements(const matvar_t& variable) {
  if (variable.rank != 2 || variable.isComplex != 0 || variable.data == nullptr) return {};
  if (variable.dims[0] != 1 && variable.dims[1] != 1) return {};
  const std::size_t count = variable.dims[0] * variable.dims[1];
  const auto size = static_cast<std::size_t>(std::max(variable.data_size, 1));
  if (variable.nbytes / size < count) return {};
  switch (variable.class_type) {
    case MAT_C_DOUBLE:
      return copied<double>(variable, count);
    case MAT_C_SINGLE:
      return copied<float>(variable, count);
    case MAT_C_INT8:
      return copied<std::int8_t>(variable, count);
    case MAT_C_UINT8:
      return copied<std::uint8_t>(variable, count);
    case MAT_C_INT16:
      return copied<std::int16_t>(variable, count);
    case MAT_C_UINT16:
      return copied<std::uint16_t>(variable, count);
    case MAT_C_INT32:
      return copied<std::int32_t>(variable, count);
    case MAT_C_UINT32:
      return copied<std::uint32_t>(variable, count);
    default:
      return {};
  }
}

using Variable = std::unique_ptr<matvar_t, FreeVariable>;

/// The field of a structure; nothing for what is none or has none of that name.
matvar_t* field(matvar_t* variable, const char* name) {
  if (variable == nullptr || variable->class_type != MAT_C_STRUCT) return nullptr;
  return Mat_VarGetStructFieldByName(variable, name, 0);
}

std::vector<std::string> variables_of(mat_t& file) {
  std::size_t count = 0;
  char* const* names = Mat_GetDir(&file, &count);
  return names == nullptr ? std::vector<std::string>{}
                          : std::vector<std::string>(names, names + count);
}

std::vector<double> read_vector(const matvar_t* variable, mat_t& file, const std::string& path,
                                const std::string& name) {
  if (variable == nullptr) {
    throw std::runtime_error(path + ": no variable '" + name + "'; there are " +
                             list_of_names(variables_of(file)));
  }
  std::vector<double> values = elements(*variable);
  if (values.empty()) {
    throw std::runtime_error(path + ": '" + name + "' is not a vector of real numbers");
  }
  return values;
}

/// A text of MATLAB's characters, of one byte or two; "" for anything else.
std::string text_of(const matvar_t* variable) {
  if (variable == nullptr || variable->class_type != MAT_C_CHAR || variable->data == nullptr)
    return "";
  const auto letters = [&](const auto* data) {
    std::string text;
    for (std::size_t i = 0; i < variable->nbytes / sizeof *data; ++i)
      text += data[i] < 0x80U ? static_cast<char>(data[i]) : '?';
    return text;
  };
  if (variable->data_size == 2) return letters(static_cast<const std::uint16_t*>(variable->data));
  if (variable->data_size != 1) return "";
  const auto* bytes = static_cast<const char*>(variable->data);
  return {bytes, variable->nbytes};
}

/// A unit by its name. Throws where it is none.
text::Unit unit_named(const std::string& name, const std::string& where) {
  const auto unit = text::parse_unit(text::usual_unit(name));
  if (!unit) throw std::runtime_error(where + ": `" + text::shown(name) + "` is no unit");
  return *unit;
}

void scale(std::vector<double>& values, const text::Unit& unit) {
  for (double& value : values) value = value * unit.numerator / unit.denominator;
}

/// The vectors as a table, in SI, as the request has it.
Table table_of(const text::ColumnTitle& column, std::vector<double> time, std::vector<double> value,
               const text::SeriesRequest& request, const std::string& where_time,
               const std::string& path) {
  const text::Unit unit = unit_named(column.unit, path);
  scale(value, unit);
  scale(time, unit_named(request.time_unit.empty() ? "s" : request.time_unit, path));
  const bool dated = !request.offset && !time.empty() && text::counts_from_date(time.front());
  const double begin = dated ? time.front() : request.offset.value_or(0.);
  for (double& moment : time) moment -= begin;
  check_increasing(time, where_time);
  for (std::size_t i = 0; i < value.size(); ++i) {
    const bool gap = std::isnan(value[i]) && request.gaps != text::Gaps::error;
    if (std::isfinite(value[i]) || gap) continue;
    throw std::runtime_error(
        path + ": element " + std::to_string(i + 1) + " of '" + column.name + "' is not finite" +
        (std::isnan(value[i]) ? ": `gaps = interpolate` says what stands for it" : ""));
  }
  if (!text::fill_gaps(time, value, request.gaps))
    throw std::runtime_error(path + ": '" + column.name + "' holds no number");
  return {{column.name},
          {{column.name, column.unit, unit}},
          std::move(time),
          {std::move(value)},
          dated ? std::vector<std::string>{text::dated_clock_notice} : std::vector<std::string>{}};
}

/// Bytes of memory that a variable claims, structures with their fields.
double claimed(matvar_t& variable) {
  double count = 1.;
  for (int i = 0; i < variable.rank; ++i) count *= static_cast<double>(variable.dims[i]);
  if (variable.class_type != MAT_C_STRUCT) return count * std::max(variable.data_size, 1);
  double bytes = 0.;
  const unsigned fields = Mat_VarGetNumberOfFields(&variable);
  for (unsigned i = 0; i < fields; ++i) {
    if (matvar_t* inner = Mat_VarGetStructFieldByIndex(&variable, i, 0))
      bytes += claimed(*inner) + sizeof(matvar_t);
  }
  return count * bytes;
}

/// The variable; nothing when there is none. Throws when it claims more than the file can hold: the
/// library would believe it.
Variable read_variable(mat_t& file, const std::string& path, const std::string& name) {
  constexpr double most_compressed = 1032.;  // deflate's limit
  const Variable header(Mat_VarReadInfo(&file, name.c_str()));
  if (!header) return nullptr;
  const auto size = static_cast<double>(std::filesystem::file_size(path));
  if (claimed(*header) > most_compressed * size)
    throw std::runtime_error(path + ": '" + name + "' claims to be larger than the file can hold");
  return Variable(Mat_VarRead(&file, name.c_str()));
}

/// The first look at a file, as the library believes whatever sizes it reads. The format: MATLAB,
/// "MAT-File Format" (MAT-file level 5).
class FirstLook {
 public:
  explicit FirstLook(const std::string& path) : file_(path, std::ios::binary) {
    std::error_code missing;
    end_ = std::filesystem::file_size(path, missing);
    if (missing) end_ = 0;
  }

  /// A MAT file v5 or 7.3 begins with a text of 124 bytes, the version and the byte order; anything
  /// else the library would take for a v4 file, which has no mark of its own. The variables of a v5
  /// file must lie within it, and have no more elements than bytes.
  bool is_sound() {
    char header[128] = {};
    file_.read(header, sizeof header);
    const std::string_view order(header + 126, 2);
    swapped_ = order == "MI";
    const int minor = static_cast<unsigned char>(header[swapped_ ? 125 : 124]);
    const int version = static_cast<unsigned char>(header[swapped_ ? 124 : 125]);
    if (!file_ || (order != "IM" && !swapped_) || minor != 0) return false;
    if (version != 1) return version == 2;
    while (at_ + 8 <= end_) {
      const std::uint64_t type = word(at_), size = word(at_ + 4);
      if (at_ + 8 + size > end_ || (type == matrix && !matrix_fits(at_ + 8, size))) return false;
      at_ += 8 + size;
    }
    return static_cast<bool>(file_);
  }

 private:
  static constexpr std::uint32_t matrix = 14, sparse = 5;

  /// Array flags (a tag and two words), then the dimensions, then the name.
  bool matrix_fits(std::uint64_t begin, std::uint64_t size) {
    if (size < 24) return size == 0;
    if ((word(begin + 8) & 0xFFU) == sparse) return true;
    const std::uint64_t ranks = word(begin + 20) / 4;
    if (24 + 4 * ranks > size) return false;
    double elements = 1.;
    for (std::uint64_t i = 0; i < ranks; ++i) elements *= word(begin + 24 + 4 * i);
    const std::uint64_t name = begin + 24 + (4 * ranks + 7) / 8 * 8;
    const bool named = name + 8 > begin + size || word(name) >> 16U != 0 || word(name + 4) <= size;
    return named && elements <= static_cast<double>(size);
  }

  std::uint32_t word(std::uint64_t at) {
    unsigned char b[4] = {};
    file_.seekg(static_cast<std::streamoff>(at));
    file_.read(reinterpret_cast<char*>(b), sizeof b);
    if (swapped_) std::ranges::reverse(b);
    return b[0] | b[1] << 8U | b[2] << 16U | static_cast<std::uint32_t>(b[3]) << 24U;
  }

  std::ifstream file_;
  std::uint64_t at_ = 128, end_ = 0;
  bool swapped_ = false;
};

}  // namespace

Table read_mat_table(const std::filesystem::path& path, const text::SeriesRequest& request) {
  const std::string& column = request.columns.front();
  const std::string name = path.string();
  const std::string refusal = text::refusal(path, text::Use::series);
  if (!refusal.empty()) throw std::runtime_error(name + ": " + refusal);
  // Its own messages would go to the terminal beside ours.
  Mat_LogInitFunc("hookpoint", [](int, auto) {});
  const std::unique_ptr<mat_t, CloseFile> file(
      FirstLook(name).is_sound() ? Mat_Open(name.c_str(), MAT_ACC_RDONLY) : nullptr);
  if (!file) throw std::runtime_error(name + ": cannot be read as a MAT file");
  const std::string moment = request.time.empty() ? "time" : request.time;
  const std::size_t dot = column.find('.');
  const Variable variable = read_variable(*file, name, column.substr(0, dot));
  const bool of_structure = dot != std::string::npos;
  matvar_t* values =
      of_structure ? field(variable.get(), column.substr(dot + 1).c_str()) : variable.get();
  const bool is_data = of_structure && column.substr(dot + 1) == "data";
  const std::string stated = text_of(field(is_data ? variable.get() : values, "unit"));
  if (matvar_t* data = field(values, "data")) values = data;
  std::vector<double> value = read_vector(values, *file, name, column);
  matvar_t* own_time = of_structure ? field(variable.get(), moment.c_str()) : nullptr;
  const std::string time_name = own_time != nullptr ? column.substr(0, dot) + "." + moment : moment;
  std::vector<double> time;
  if (request.sample_rate > 0.) {
    if (!request.time.empty())
      throw std::runtime_error(name + ": rows are by `time` or by `sample_rate`, not by both");
    for (std::size_t i = 0; i < value.size(); ++i)
      time.push_back(static_cast<double>(i) / request.sample_rate);
  } else {
    const Variable common_time = own_time == nullptr ? read_variable(*file, name, moment) : nullptr;
    time = read_vector(own_time != nullptr ? own_time : common_time.get(), *file, name, time_name);
  }
  if (time.size() != value.size()) {
    throw std::runtime_error(name + ": '" + column + "' has " + std::to_string(value.size()) +
                             " elements, '" + time_name + "' " + std::to_string(time.size()));
  }
  return table_of({column, request.unit.empty() ? stated : request.unit}, std::move(time),
                  std::move(value), request, name + ": '" + time_name + "'", name);
}

}  // namespace hookpoint::control

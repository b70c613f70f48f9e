// The one file that sees libmatio.
#include <matio.h>

#include <cmath>
#include <memory>
#include <stdexcept>

#include "control/table.h"

namespace hookpoint::control {
namespace {

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

std::vector<double> read_vector(const matvar_t* variable, const std::string& path,
                                const std::string& name) {
  if (variable == nullptr) throw std::runtime_error(path + ": no variable '" + name + "'");
  std::vector<double> values = elements(*variable);
  if (values.empty()) {
    throw std::runtime_error(path + ": '" + name + "' is not a vector of real numbers");
  }
  return values;
}

}  // namespace

Series read_mat_series(const std::filesystem::path& path, const std::string& column) {
  const std::string name = path.string();
  // Its own messages would go to the terminal beside ours.
  Mat_LogInitFunc("hookpoint", [](int, char*) {});
  const std::unique_ptr<mat_t, CloseFile> file(Mat_Open(name.c_str(), MAT_ACC_RDONLY));
  if (!file) throw std::runtime_error(name + ": cannot be read as a MAT file");
  const std::size_t dot = column.find('.');
  const Variable variable(Mat_VarRead(file.get(), column.substr(0, dot).c_str()));
  const Variable common_time(Mat_VarRead(file.get(), "time"));
  const bool of_structure = dot != std::string::npos;
  matvar_t* values =
      of_structure ? field(variable.get(), column.substr(dot + 1).c_str()) : variable.get();
  if (matvar_t* data = field(values, "data")) values = data;
  matvar_t* own_time = of_structure ? field(variable.get(), "time") : nullptr;
  const std::string time_name = own_time != nullptr ? column.substr(0, dot) + ".time" : "time";
  Series series{read_vector(own_time != nullptr ? own_time : common_time.get(), name, time_name),
                read_vector(values, name, column)};
  if (series.time.size() != series.value.size()) {
    throw std::runtime_error(name + ": '" + column + "' has " +
                             std::to_string(series.value.size()) + " elements, '" + time_name +
                             "' " + std::to_string(series.time.size()));
  }
  check_increasing(series.time, name + ": '" + time_name + "'");
  for (std::size_t i = 0; i < series.value.size(); ++i) {
    if (!std::isfinite(series.value[i])) {
      throw std::runtime_error(name + ": element " + std::to_string(i + 1) + " of '" + column +
                               "' is not finite");
    }
  }
  return series;
}

}  // namespace hookpoint::control

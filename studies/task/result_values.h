// What a task leaves for a program that reads its results: values by name, as Python's dict has
// them.
#pragma once

#include <memory>
#include <string>
#include <utility>
#include <variant>
#include <vector>

#include "output/files/csv.h"
#include "studies/results/idleness.h"
#include "studies/results/pivot.h"

namespace hookpoint::studies {

struct JsonText {
  std::string text;
};

struct ResultValue;
struct AnyResult;

/// In the order in which a reader meets them.
using ResultValues = std::vector<std::pair<std::string, ResultValue>>;

struct ResultValue {
  /// Of a type that AnyResult has.
  template <class Value>
  ResultValue(Value value);

  std::shared_ptr<const AnyResult> any;  ///< never null
};

struct AnyResult {
  std::variant<bool, int, std::string, std::vector<std::string>, output::CsvTable, Pivot,
               std::vector<IdleBlock>, JsonText, std::vector<ResultValues>, ResultValues>
      value;
};

template <class Value>
ResultValue::ResultValue(Value value)
    : any(std::make_shared<const AnyResult>(
          AnyResult{decltype(AnyResult::value)(std::in_place_type<Value>, std::move(value))})) {}

}  // namespace hookpoint::studies

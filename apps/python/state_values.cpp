#include "apps/python/state_values.h"

#include <fmt/format.h>

#include "apps/python/arguments.h"
#include "apps/python/errors.h"

namespace hookpoint::python {
namespace {

namespace py = pybind11;

constexpr std::size_t quaternion_size = 4, angles = 3;

}  // namespace

StateValues::StateValues(const py::object& state, std::size_t worlds, const Find& find) {
  if (state.is_none()) return;
  if (!py::isinstance<py::dict>(state)) throw py::type_error("`state` is a dict {trail: numbers}");
  for (const auto& [key, value] : py::reinterpret_borrow<py::dict>(state)) {
    if (!py::isinstance<py::str>(key))
      throw py::type_error("the keys of `state` are trails, which are text");
    Written written{utf8(key), {}, {}, 1, false};
    written.numbers = find(written.trail);
    const std::size_t size = written.numbers.size();
    const Numbers array = numbers_of(value, fmt::format("`{}` in `state`", written.trail));
    const auto dimensions = static_cast<std::size_t>(array.ndim());
    const std::size_t of_row = size > 1 ? 1 : 0;  // dimensions of one world's value
    written.by_world = dimensions == of_row + 1;
    written.width = of_row == 0      ? 1
                    : dimensions > 0 ? static_cast<std::size_t>(array.shape(array.ndim() - 1))
                                     : 0;
    const bool fits = written.width == size || (size == quaternion_size && written.width == angles);
    const bool one_a_world =
        !written.by_world || static_cast<std::size_t>(array.shape(0)) == worlds;
    if (dimensions < of_row || dimensions > of_row + 1 || !fits || !one_a_world)
      throw_error(fmt::format("`{}` in `state` takes {}, or an array of {} with {} a world, not {}",
                              written.trail,
                              size == 1                 ? "one number"
                              : size == quaternion_size ? "4 numbers w, x, y, z or 3 angles"
                                                        : fmt::format("{} numbers", size),
                              worlds, size == 1 ? "one" : "a row", shape_text(array)));
    written.values.assign(array.data(), array.data() + array.size());
    ports_.push_back(std::move(written));
  }
}

std::vector<simulation::InitialValue> StateValues::of(std::size_t world) const {
  std::vector<simulation::InitialValue> values;
  for (const Written& port : ports_) {
    const auto first =
        port.values.begin() + static_cast<std::ptrdiff_t>(port.by_world ? world * port.width : 0);
    values.push_back(
        {port.trail, port.numbers, {first, first + static_cast<std::ptrdiff_t>(port.width)}});
  }
  return values;
}

}  // namespace hookpoint::python

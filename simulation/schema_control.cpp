#include "simulation/schema.h"
#include "simulation/schema_fields.h"

namespace hookpoint::simulation {
namespace {

/// What the lines to and from a controller do to the values that they carry. The noise is in the
/// unit of the value carried.
std::vector<FieldSchema> transmission_fields() {
  return {
      positive(number_field("rate", "Hz", "",
                            "samples a second, held in between; if not given, one each step")),
      not_negative(number_field("delay", "s", "0", "each sample arrives that much later")),
      not_negative(number_field(
          "noise", "?", "0", "standard deviation of zero-mean Gaussian noise, added when sampled")),
  };
}

language::ClassSchema pd_class() {
  language::ClassSchema pd;
  pd.name = "Controller.PD";
  pd.doc = "output = pconstant (goal - current) - dconstant d(current)/dt";
  pd.top_level = true;
  pd.default_input = "current";
  pd.default_output = "output";
  pd.fields = {
      with_port(Direction::both, number_field("goal", "?", "0", "value that current is to reach")),
      with_port(Direction::both, number_field("pconstant", "?", "0", "output per error")),
      with_port(Direction::both, number_field("dconstant", "?", "0", "output per rate")),
      port_only(Direction::input,
                number_field("current", "?", "", "the value controlled: a joint's angle")),
      port_only(
          Direction::input,
          number_field("rate_in", "?", "",
                       "d(current)/dt: a joint's rate; if not wired, from successive samples")),
      port_only(Direction::output, number_field("output", "?", "", "to a joint's torque")),
  };
  append(pd.fields, transmission_fields());
  return pd;
}

}  // namespace

void add_control_classes(language::Schema& schema) { schema.add(pd_class()); }

}  // namespace hookpoint::simulation

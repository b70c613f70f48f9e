// Wires and attachments: one WireSpec a number, what their lines do to it, and what is wrong with
// the whole of them.
#include <fmt/format.h>

#include <algorithm>
#include <exception>
#include <map>
#include <new>
#include <set>

#include "control/data/table.h"
#include "control/registry.h"
#include "language/tree/fields.h"
#include "language/tree/references.h"
#include "language/units.h"
#include "language/values/budget.h"
#include "language/wording.h"
#include "simulation/scene/load_parts.h"
#include "simulation/wiring/timing.h"
#include "simulation/wiring/wiring_order.h"
#include "text/number.h"

namespace hookpoint::simulation {

using language::FieldSchema;

namespace {

using control::Attachment;
using control::PortDescription;
using control::PortKind;

/// What an end of a wire names: the object, its port without a part, and the trails of its numbers.
struct End {
  const language::Object* object = nullptr;
  const FieldSchema* field = nullptr;
  std::vector<std::string> trails;
};

/// Something that drives inputs: a wire, or an attachment when `wire` is null.
struct Driver {
  const language::Object* from = nullptr;
  const language::Object* to = nullptr;
  const language::Wire* wire = nullptr;
  const FieldSchema* field = nullptr;  ///< the output's; for its unit
  const FieldSchema* input = nullptr;
  language::Position position;
};

class Wires {
 public:
  explicit Wires(Loading& loading) : loading_(loading), experiment_(loading.experiment) {}

  void run(const language::Object& root) {
    collect(root);
    for (std::size_t i = 0; i < loading_.components.size(); ++i) attach(i);
    for (const FormulaInput& input : loading_.formula_inputs) feed(input);
    if (loading_.diagnostics.error_count() != errors_before_) return;
    const Components components(experiment_);
    check_lines();
    check_loop(components);
    check_start();
  }

 private:
  void collect(const language::Object& object) {
    for (const language::Wire& wire : object.wires) add_wire(wire);
    for (const auto& child : object.children) collect(*child);
  }

  End end_of(const language::Reference& reference) const {
    End end{reference.object, nullptr, {}};
    const std::string trail = loading_.trails.at(reference.object) + ".";
    end.field = reference.object->schema->find(reference.port);
    if (end.field == nullptr) {
      const std::string whole = reference.port.substr(0, reference.port.find_last_of(".["));
      end.field = reference.object->schema->find(whole);
      end.trails.push_back(trail + reference.port);
      return end;
    }
    const int parts = components_of(*end.field);
    for (int i = 0; i < parts; ++i)
      end.trails.push_back(trail + reference.port +
                           (parts > 1 ? language::part_name(*end.field, i) : ""));
    return end;
  }

  void add_wire(const language::Wire& wire) {
    const End from = end_of(*wire.from), to = end_of(*wire.to);
    if (!has_value(from)) {
      return loading_.error(end_place(wire, *wire.from),
                            fmt::format("`{}` of this {} is not given, so there is nothing to read",
                                        from.field->name, from.object->type));
    }
    if (!is_published(*from.object, *from.field, end_place(wire, *wire.from)) ||
        !is_published(*to.object, *to.field, end_place(wire, *wire.to)))
      return;
    for (std::size_t i = 0; i < from.trails.size(); ++i) {
      add({from.object, to.object, &wire, from.field, to.field, wire.position}, from.trails[i],
          to.trails[i]);
    }
  }

  /// A wire from what a formula names to its component.
  void feed(const FormulaInput& input) {
    const language::Object& object = *loading_.components[input.component];
    const End from = end_of(input.from);
    if (!has_value(from)) {
      return loading_.error(input.from.position,
                            fmt::format("`{}` of this {} is not given, so there is nothing to read",
                                        from.field->name, from.object->type));
    }
    if (!is_published(*from.object, *from.field, input.from.position)) return;
    static const FieldSchema in = language::number_field("in", "?", "", "");
    const std::size_t count = experiment_.components[input.component].open_inputs;
    const std::string element = count > 1 ? fmt::format("[{}]", input.element) : "";
    add({from.object, &object, nullptr, from.field, &in, input.from.position}, from.trails[0],
        loading_.trails.at(&object) + "." + in.name + element);
  }

  static const language::Position& end_place(const language::Wire& wire,
                                             const language::Reference& end) {
    return end.trail.empty() ? wire.position : end.position;
  }

  /// Whether a run has that port; says why where it has not.
  bool is_published(const language::Object& object, const FieldSchema& field,
                    const language::Position& place) {
    const std::string why = missing_port(experiment_, object, field);
    if (!why.empty()) loading_.error(place, why);
    return why.empty();
  }

  /// A setting that the file leaves open and nothing works out cannot be read.
  bool has_value(const End& end) const {
    if (!end.field->setting || end.field->port != language::Direction::output ||
        end.object->find(end.field->name) != nullptr)
      return true;
    const auto& values = *experiment_.values;
    return std::ranges::find(values, end.trails[0], &ValueSpec::trail) != values.end();
  }

  void add(const Driver& driver, const std::string& from, const std::string& to) {
    const auto first = drivers_by_input_.emplace(to, drivers_.size());
    if (!first.second) {
      loading_.error(driver.position, fmt::format("a second signal into `{}`", to));
      return loading_.diagnostics.note(drivers_[first.first->second].position,
                                       "the first one is here");
    }
    WireSpec spec{.from = from, .to = to, .rate = {}, .mean = takes_mean(driver)};
    if (const language::Field* rate = property(driver, language::wire_rate))
      spec.rate = rate->numbers[0];
    if (const language::Field* delay = property(driver, language::wire_delay))
      spec.delay = delay->numbers[0];
    if (const language::Field* noise = property(driver, language::wire_noise))
      spec.noise = noise->numbers[0];
    drivers_.push_back(driver);
    ends_by_output_.emplace(from, to);
    experiment_.wires.push_back(std::move(spec));
  }

  /// Whether it ends at an input that takes means.
  bool takes_mean(const Driver& driver) {
    const auto [inputs, is_new] = mean_inputs_.try_emplace(driver.to->type);
    const control::ComponentClass* type = control::Registry::instance().find(driver.to->type);
    if (is_new && type != nullptr) {
      const auto component = type->make();
      for (const PortDescription& port : component->ports())
        if (port.mean) inputs->second.insert(port.name);
    }
    return inputs->second.contains(driver.input->name);
  }

  /// The wire's own; else that of the stub at its end; else that of the stub at its beginning.
  const language::Field* property(const Driver& driver, std::string_view name) const {
    if (driver.wire != nullptr) {
      for (const language::Field& field : driver.wire->fields) {
        if (field.schema->name == name) return &field;
      }
    }
    for (const language::Object* stub : {driver.to, driver.from}) {
      if (control::Registry::instance().find(stub->type) == nullptr || !stub->given(name)) continue;
      const language::Field* field = stub->find(name);
      if (name != language::wire_noise || carries(driver, field->dimension)) return field;
    }
    return nullptr;
  }

  /// Whether the wire's value can have noise in that unit.
  static bool carries(const Driver& driver, const language::Dimension& dimension) {
    const std::string& unit = driver.field->unit == "?" ? driver.to->unit_of(*driver.input)
                                                        : driver.from->unit_of(*driver.field);
    return unit == "?" || language::fits(dimension, language::parse_unit(unit)->dimension);
  }

  /// What the component reads and drives where no wire says otherwise.
  void attach(std::size_t index) {
    const language::Object& object = *loading_.components[index];
    const control::ComponentClass& type = *control::Registry::instance().find(object.type);
    if (type.attachment == Attachment::none) return;
    const std::string_view name = attachment_field(type.attachment);
    const language::Object* target = object.given(name) ? object.object(name) : nullptr;
    std::vector<std::string> missing;
    const auto component = type.make();
    for (const PortDescription& port : component->ports()) {
      if (port.attached.empty()) continue;
      for (std::size_t i = 0; i < port.count; ++i) {
        const std::string own =
            experiment_.components[index].trail + "." + port.name + element_suffix(port, i);
        if (is_wired(port, own, target, i)) continue;
        if (target == nullptr) {
          missing.push_back(port.name + element_suffix(port, i));
        } else if (!add_attachment(object, *target, port, i, own)) {
          return;
        }
      }
    }
    if (!missing.empty()) {
      loading_.error(object.position,
                     fmt::format("this {} is attached to nothing: give `{} = ...`, or wire its {}",
                                 object.type, name, fmt::join(missing, ", ")));
    }
  }

  /// Whether a wire takes the attachment's place: one into the input; one from the output to the
  /// port that it would drive, or to anything where there is no such port. A wire from the output
  /// to somewhere else only listens.
  bool is_wired(const PortDescription& port, const std::string& own, const language::Object* target,
                std::size_t i) const {
    if (port.kind != PortKind::output) return drivers_by_input_.contains(own);
    const std::string driven = target == nullptr ? "" : attached_trail(*target, port, i);
    const auto [first, last] = ends_by_output_.equal_range(own);
    return std::any_of(
        first, last, [&](const auto& wire) { return target == nullptr || wire.second == driven; });
  }

  /// Of the number of `target` that element `i` of `port` reads or drives.
  std::string attached_trail(const language::Object& target, const PortDescription& port,
                             std::size_t i) const {
    const FieldSchema* field = target.schema->find(port.attached);
    std::string trail = loading_.trails.at(&target) + "." + port.attached;
    if (port.count > 1 && field != nullptr)
      trail += language::part_name(*field, static_cast<int>(i));
    return trail;
  }

  /// False after saying that the target lacks the port.
  bool add_attachment(const language::Object& object, const language::Object& target,
                      const PortDescription& port, std::size_t i, const std::string& own) {
    const FieldSchema* field = target.schema->find(port.attached);
    const std::string other = attached_trail(target, port, i);
    if (field == nullptr)
      field = target.schema->find(port.attached.substr(0, port.attached.rfind('.')));
    const control::ComponentClass& type = *control::Registry::instance().find(object.type);
    const language::Position& position = place_of(object, attachment_field(type.attachment));
    if (field == nullptr) {
      loading_.error(position, fmt::format("{} has no port `{}`, which {} needs",
                                           language::with_article(target.type), port.attached,
                                           language::with_article(object.type)));
      return false;
    }
    if (!is_published(target, *field, position)) return false;
    const FieldSchema* self = object.schema->find(port.name);
    if (port.kind == PortKind::output) {
      add({&object, &target, nullptr, self, field, position}, own, other);
    } else {
      add({&target, &object, nullptr, field, self, position}, other, own);
    }
    return true;
  }

  void check_lines() {
    constexpr std::size_t most = 20'000'000;
    std::size_t samples = 0;
    for (std::size_t i = 0; i < experiment_.wires.size() && samples <= most; ++i) {
      try {
        samples += transmission_line(experiment_.wires[i], experiment_, 0.).state_size();
      } catch (const std::bad_alloc&) {
        throw;
      } catch (const std::exception& error) {
        loading_.error(drivers_[i].position, error.what());
      }
      if (samples > most)
        loading_.error(drivers_[i].position, "with this one the wires require " +
                                                 language::too_many(static_cast<double>(samples),
                                                                    most, "samples under way") +
                                                 ": shorten the delays or lower the rates");
    }
  }

  void check_loop(const Components& components) {
    const std::vector<std::size_t> loop = order_wiring(experiment_, components).loop;
    if (loop.empty()) return;
    std::vector<std::string> members;
    for (const std::size_t i : loop) members.push_back("`" + experiment_.wires[i].from + "`");
    members.push_back(members.front());
    loading_.error(
        drivers_[loop[0]].position,
        fmt::format("an algebraic loop: {} within one step; give one of these wires a delay",
                    fmt::join(members, " to ")));
    for (std::size_t i = 0; i < loop.size(); ++i) {
      loading_.diagnostics.note(
          drivers_[loop[i]].position,
          fmt::format("from `{}` to `{}` here", experiment_.wires[loop[i]].from,
                      experiment_.wires[loop[i]].to));
    }
  }

  void check_start() {
    for (std::size_t i = 0; i < experiment_.components.size(); ++i) {
      try {
        update_schedule(experiment_.components[i], experiment_.deltat);
      } catch (const std::bad_alloc&) {
        throw;
      } catch (const std::exception& error) {
        return loading_.error(place_of(*loading_.components[i], language::wire_rate), error.what());
      }
    }
    Components components(experiment_);
    for (const StartProblem& problem : components.start(experiment_))
      loading_.error(place_of_problem(problem, components[problem.component]), problem.message);
    for (std::size_t i = 0; i < components.size(); ++i) {
      if (const auto* table = dynamic_cast<const control::ReadsTable*>(&components[i]))
        check_table(*loading_.components[i], i, table->report());
    }
  }

  /// What the user should know of a table, and whether its units suit what it drives.
  void check_table(const language::Object& object, std::size_t index,
                   const control::TableReport& report) {
    const language::Position& place = place_of(object, "file");
    for (const std::string& notice : report.notices) loading_.diagnostics.note(place, notice);
    const double end = experiment_.duration;
    if (!report.repeats && (report.last < 0. || report.first > end))
      loading_.diagnostics.warning(
          place,
          fmt::format("the table's times, {} s to {} s, lie outside of the run, 0 s to {} s: "
                      "one row holds throughout; `start` and `offset` move them",
                      text::rounded(report.first, 6), text::rounded(report.last, 6),
                      text::rounded(end, 6)));
    const std::string& trail = experiment_.components[index].trail;
    for (std::size_t i = 0; i < drivers_.size(); ++i) {
      if (drivers_[i].from != &object) continue;
      for (const control::TableReport::Unit& unit : report.units) {
        const std::string port = trail + "." + unit.output;
        const std::string& from = experiment_.wires[i].from;
        if (from == port || from == fmt::format("{}[{}]", port, unit.element))
          check_unit(drivers_[i], unit);
      }
    }
  }

  /// A unit that a table states suits the port that its wire drives.
  void check_unit(const Driver& driver, const control::TableReport::Unit& unit) {
    const std::string& wanted = driver.to->unit_of(*driver.input);
    if (wanted == "?") return;
    const language::Dimension expected = language::parse_unit(wanted)->dimension;
    if (language::fits(unit.dimension, expected)) return;
    loading_.error(
        driver.position,
        fmt::format("the table has `{}` in {} ({}), and `{}` of this {} is {}: wire "
                    "another column, or state its `unit`",
                    unit.output, unit.written, language::describe_dimension(unit.dimension),
                    driver.input->name, driver.to->type, language::describe_dimension(expected)));
  }

  /// A message that begins with the name of a data file is about the field that names it.
  const language::Position& place_of_problem(const StartProblem& problem,
                                             const control::Component& component) const {
    const language::Object& object = *loading_.components[problem.component];
    for (const auto& [index, text] : experiment_.components[problem.component].texts) {
      if (text.empty() || !problem.message.starts_with(text)) continue;
      for (const PortDescription& port : component.ports()) {
        if (port.kind == PortKind::text && port.first == index) return place_of(object, port.name);
      }
    }
    return object.position;
  }

  Loading& loading_;
  Experiment& experiment_;
  std::size_t errors_before_ = loading_.diagnostics.error_count();
  std::vector<Driver> drivers_;  // one a wire
  std::map<std::string, std::size_t> drivers_by_input_;
  std::map<std::string, std::set<std::string>> mean_inputs_;  ///< that take means, by class
  std::multimap<std::string, std::string> ends_by_output_;    ///< of the wires so far
};

}  // namespace

void load_wires(const language::Object& root, Loading& loading) { Wires(loading).run(root); }

}  // namespace hookpoint::simulation

// The numbers that can be read though nothing computes them.
#include "control/registry.h"
#include "language/tree/references.h"
#include "simulation/experiment/material_fields.h"
#include "simulation/experiment/robot_tree.h"
#include "simulation/scene/body.h"
#include "simulation/scene/fixed_part.h"
#include "simulation/scene/load_parts.h"

namespace hookpoint::simulation {

using language::Direction;
using language::FieldSchema;
using language::FieldType;

namespace {

class Values {
 public:
  explicit Values(Loading& loading) : loading_(loading) {}

  void run(const language::Object& root) {
    visit(root);
    loading_.experiment.values = std::make_shared<const std::vector<ValueSpec>>(std::move(values_));
  }

 private:
  void visit(const language::Object& parent) {
    for (const auto& object : parent.children) {
      add_fields(*object);
      add_loaded(*object);
      visit(*object);
    }
  }

  void add_fields(const language::Object& object) {
    const bool component = control::Registry::instance().find(object.type) != nullptr;
    for (const FieldSchema& field : object.schema->fields) {
      // A component's own ports are its values; what the stub says beside them is a constant.
      if (component && (!field.setting || field.port != Direction::output)) continue;
      if (field.port == Direction::none || !is_number(field)) continue;
      if (is_part(object) && is_of_joint(field.name)) continue;
      const language::Field* value = object.find(field.name);
      const bool writable = field.port != Direction::output;
      if (value != nullptr) {
        add(object, field, loaded_numbers(object, *value), writable);
      } else if (writable) {
        add_open(object, field);
      }
    }
  }

  /// As the load step has them: where a word stands for a step (deltat = auto), and the constants
  /// that follow from others of a Material.
  std::vector<double> loaded_numbers(const language::Object& object,
                                     const language::Field& value) const {
    if (value.numbers.empty()) return {loading_.experiment.deltat};
    const auto material = loading_.materials.find(&object);
    if (material == loading_.materials.end()) return value.numbers;
    const contact::MaterialConstants<double>& constants =
        loading_.experiment.materials[static_cast<std::size_t>(material->second)].constants;
    for (const MaterialField& field : material_fields())
      if (field.name == value.schema->name) return {constants.*field.member};
    return value.numbers;
  }

  /// A port that the file leaves open. A list has one a part where its length is known all the
  /// same.
  void add_open(const language::Object& object, const FieldSchema& field) {
    if (field.type == FieldType::numbers && field.min_count != field.max_count) return;
    for (int i = 0; i < components_of(field); ++i) {
      const std::string part = components_of(field) > 1 ? language::part_name(field, i) : "";
      values_.push_back({loading_.trails[&object] + "." + field.name + part,
                         unit_of(object, field),
                         {},
                         true,
                         object.type == "Button"});
    }
  }

  /// What the load step worked out where the file left it open.
  void add_loaded(const language::Object& object) {
    const auto at = loading_.bodies.find(&object);
    if (at == loading_.bodies.end()) return;
    const MassSpec& mass = at->second.mass;
    add_missing(object, mass_field::mass, {mass.mass});
    add_missing(object, mass_field::center_of_mass,
                {mass.center_of_mass.x, mass.center_of_mass.y, mass.center_of_mass.z});
    const Symmetric3d& I = mass.inertia;
    add_missing(object, mass_field::inertia, {I.xx, I.yy, I.zz, I.xy, I.xz, I.yz});
  }

  void add_missing(const language::Object& object, const char* name,
                   const std::vector<double>& numbers) {
    if (object.find(name) == nullptr) add(object, *object.schema->find(name), numbers, false);
  }

  void add(const language::Object& object, const FieldSchema& field,
           const std::vector<double>& numbers, bool writable) {
    const bool list = field.type == FieldType::numbers || field.type == FieldType::orientation;
    for (std::size_t i = 0; i < numbers.size(); ++i) {
      const std::string part =
          list && numbers.size() > 1 ? language::part_name(field, static_cast<int>(i)) : "";
      values_.push_back({loading_.trails[&object] + "." + field.name + part, unit_of(object, field),
                         numbers[i], writable});
    }
  }

  static std::string unit_of(const language::Object& object, const FieldSchema& field) {
    return field.unit == "?" ? "" : object.unit_of(field);
  }

  Loading& loading_;
  std::vector<ValueSpec> values_;
};

}  // namespace

void load_values(const language::Object& root, Loading& loading) {
  loading.trails = trails_of(root);
  Values(loading).run(root);
}

}  // namespace hookpoint::simulation

// Included files of another format: what their readers return becomes objects.
#include <cassert>

#include "language/tree/builder.h"
#include "language/tree/field.h"
#include "language/tree/foreign.h"

namespace hookpoint::language {

void Builder::lay_foreign_file(const FileScope& scope) {
  if (scope.file.report.has_errors()) return;
  // It is read anew each time.
  if (!take(Resource::steps, scope.file.source.text.size(), scope.place)) return;
  ForeignArguments arguments;
  for (const auto& [name, given] : scope.given)
    arguments.emplace(name, ForeignField{name, given.values, given.position});
  const std::vector<ForeignObject> objects =
      (*scope.file.reader)(scope.file.source, arguments, files_, report_);
  for (const ForeignObject& object : objects) lay_foreign(scope, object);
}

void Builder::lay_foreign(const FileScope& scope, const ForeignObject& foreign) {
  const ClassSchema* schema = schema_.schema().find(foreign.type);
  assert(schema != nullptr && "readers speak of classes that exist");
  check_place(*schema, foreign.position);
  Object* object = open_object(*schema, foreign.name, foreign.position, foreign.position);
  if (object == nullptr) return;
  const ExpressionEvaluator evaluate = evaluator(scope);
  for (const ForeignField& field : foreign.fields) {
    add_field(*schema, field.name, field.position, object->fields, [&](const FieldSchema& taker) {
      return make_field(schema_.context(*schema, taker, evaluate, report_), field.values,
                        field.position);
    });
  }
  for (const auto& [from, to] : foreign.wires) {
    if (!take(Resource::objects, 1, foreign.position)) break;
    const auto end = [&](const std::string& trail) {
      return Reference{trail, nullptr, "", foreign.position};
    };
    object->wires.push_back({end(from), end(to), {}, foreign.position});
  }
  for (const ForeignObject& child : foreign.children) {
    if (!stopped()) lay_foreign(scope, child);
  }
  close_object();
}

}  // namespace hookpoint::language

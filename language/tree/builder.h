// From syntax to the object tree: variables, loops and includes are carried out, every value is
// checked by the field that takes it. References are resolved afterwards (checker.h), when all
// objects are known.
#pragma once

#include <functional>
#include <map>
#include <memory>
#include <set>
#include <string>
#include <unordered_map>
#include <vector>

#include "language/syntax/files.h"
#include "language/tree/evaluate_options.h"
#include "language/tree/hints.h"
#include "language/tree/prepared.h"
#include "language/values/expression.h"

namespace hookpoint::language {

class Builder {
 public:
  Builder(const PreparedSchema& schema, FileStore& files, Report& report)
      : schema_(schema), files_(files), report_(report) {}

  /// The tree of `file` under a nameless root. Errors go to the report.
  std::unique_ptr<Object> build(const ParsedFile& file, const EvaluateOptions& options);
  /// Names in what was left out for an error: a trail that speaks of them is no second error.
  const std::set<std::string, std::less<>>& left_out() const { return left_out_; }
  /// What may explain errors in the references of the tree.
  const Hints& hints() const { return hints_; }

 private:
  struct Given {
    std::vector<Value> values;  ///< empty when the value was wrong, and said to be
    Position position;
  };
  /// What a loop's variable has its value from: a variable whose name may have been meant as a
  /// word.
  struct CopiedValue {
    std::string_view from;
    Position place;  ///< of that name in the loop's list
  };
  /// One evaluation of a file: its variables, and where it was included.
  struct FileScope {
    const ParsedFile& file;
    const FileScope* includer = nullptr;
    Position place;  ///< of the Include; no file for the first one
    std::map<std::string, Given> given;
    Variables variables;
    bool chosen = false;  ///< by a value: what is not evaluated does not know of it
    std::map<std::string_view, CopiedValue> copied = {};  ///< of loops' variables
  };
  using Names = std::unordered_map<std::string, const Object*>;
  /// An object that is being filled.
  struct Open {
    Object* object;
    Names names;  ///< of its children
  };

  // builder.cpp
  void lay_items(FileScope& scope, Range items, bool top_of_file);
  void lay_item(FileScope& scope, const Item& item, bool top_of_file);
  void lay_object(FileScope& scope, const Item& item);
  void lay_assignment(FileScope& scope, const Item& item);
  void lay_wire(FileScope& scope, const Item& item);
  void lay_let(FileScope& scope, const Item& item);
  void lay_loop(FileScope& scope, const Item& item);
  void lay_loop_over_list(FileScope& scope, const Item& item);
  /// The loop's items once, its variable being `value`; false to go no further.
  bool lay_round(FileScope& scope, const Item& item, Value value);
  /// An error at `place` may come from `name`, which holds a value where a word was meant.
  void hint_at_value(const FileScope& scope, std::string_view name, const Position& place);
  void hint_at_values(const FileScope& scope, const Trail& trail, const Position& place);
  void lay_implicit_objects();
  /// The class, if it is known and may stand here; else an error.
  const ClassSchema* class_of(const FileScope& scope, const Item& item);
  bool check_place(const ClassSchema& schema, const Position& place);
  /// Adds a child to the innermost open object and opens it. Null when there are too many.
  Object* open_object(const ClassSchema& schema, std::string name, const Position& place,
                      const Position& name_place);
  void close_object() { open_.pop_back(); }
  void add_field(const FileScope& scope, const ClassSchema& schema, const Item& item,
                 std::vector<Field>& fields);
  /// The field called `name`, as `make` makes it, if there may be one.
  void add_field(const ClassSchema& schema, const std::string& name, const Position& place,
                 std::vector<Field>& fields,
                 const std::function<std::optional<Field>(const FieldSchema&)>& make);
  bool define(FileScope& scope, std::string_view name, std::vector<Value> values,
              const Position& place);
  void leave_out(const FileScope& scope, const Item& item);
  /// The innermost open object that is no Group.
  Object& owner() const;

  // builder_files.cpp
  void lay_file(FileScope& scope);
  void lay_param(FileScope& scope, const Item& item, bool top_of_file);
  void lay_include(FileScope& scope, const Item& item);
  /// Lays the included file down under the Include's name.
  void lay_group(const FileScope& scope, const Item& item, FileScope& inner);
  const ParsedFile* find_include(const FileScope& scope, const Item& item);
  /// Where the Include's file lies; empty after an error.
  std::filesystem::path include_path(const FileScope& scope, const Item& item);
  /// Remembers the library at the root; whoever evaluates has loaded it (Library::load_plugins).
  void lay_plugin(const FileScope& scope, const Item& item, bool top_of_file);
  void take_arguments(const FileScope& scope, const Item& item, FileScope& inner);
  void take_parameters(const EvaluateOptions& options, FileScope& scope);
  /// False when an argument is missing: nothing sensible can be created then.
  bool check_arguments(const FileScope& scope);
  bool check_argument(Given& given, const std::vector<Value>& defaults, const Item& item,
                      const FileScope& scope);

  // builder_foreign.cpp
  void lay_foreign_file(const FileScope& scope);
  void lay_foreign(const FileScope& scope, const ForeignObject& foreign);

  ExpressionEvaluator evaluator(const FileScope& scope) {
    return {scope.file, scope.variables, report_, budget_};
  }
  static Position position(const FileScope& scope, Span span) {
    return {&scope.file.source, span.offset, std::max<std::size_t>(span.length, 1)};
  }
  /// Takes of the budget; false, after one error, when the file requires too much.
  bool take(Resource resource, std::size_t amount, const Position& place) {
    return budget_.take(resource, amount, place, report_);
  }
  /// Nothing more is created.
  bool stopped() const { return too_deep_ || budget_.spent() || report_.full(); }

  const PreparedSchema& schema_;
  FileStore& files_;
  Report& report_;
  Hints hints_;
  Budget budget_;
  std::vector<Open> open_;
  std::set<std::string, std::less<>> left_out_;
  bool too_deep_ = false;
};

}  // namespace hookpoint::language

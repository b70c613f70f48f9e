// Every component class by the name that the language gives it. A class registers itself: adding
// one changes nothing elsewhere.
#pragma once

#include <map>
#include <memory>
#include <string>
#include <string_view>

#include "control/component.h"

namespace hookpoint::control {

/// What a component is attached to: nothing, a joint (`joint = bot.leg1.link1;`) or a body (`body =
/// bot.base;`).
enum class Attachment { none, joint, body };

struct ComponentClass {
  std::string name;  ///< "Controller.PD", "Sensor.IMU", "Actuator.DCMotor", "Signal.Sine", "Gain"
  std::string doc;   ///< one line
  Attachment attachment = Attachment::none;
  std::string default_input, default_output;  ///< the ports that a wire without an end means
  std::string origin;                         ///< "" when built in, else the plugin's file
  std::unique_ptr<Component> (*make)() = nullptr;
};

class Registry {
 public:
  /// The one of the process: static registrations of the program and of plugins meet in it.
  static Registry& instance();
  /// A name that is taken is refused and remembered (see `problems`).
  void add(ComponentClass type);
  const ComponentClass* find(std::string_view name) const;
  const std::map<std::string, ComponentClass, std::less<>>& classes() const { return classes_; }
  const std::vector<std::string>& problems() const { return problems_; }
  /// While a plugin is loaded: the origin of what registers.
  void set_origin(std::string origin) { origin_ = std::move(origin); }
  /// Forgets the classes of a plugin that is refused.
  void remove(const std::string& origin);

 private:
  std::map<std::string, ComponentClass, std::less<>> classes_;
  std::vector<std::string> problems_;
  std::string origin_;
};

/// "" or what is wrong with how the class declares its ports: two of one name, a default port that
/// does not exist, a name that the stub has a field of or that is none. Makes one instance.
std::string declaration_problem(const ComponentClass& type);

/// The class `Type` as the registry holds it.
template <class Type>
ComponentClass describe_class(std::string name, std::string doc,
                              Attachment attachment = Attachment::none,
                              std::string default_input = "",
                              std::string default_output = "output") {
  return {std::move(name),
          std::move(doc),
          attachment,
          std::move(default_input),
          std::move(default_output),
          "",
          []() -> std::unique_ptr<Component> { return std::make_unique<Type>(); }};
}

struct Registration {
  explicit Registration(ComponentClass type) { Registry::instance().add(std::move(type)); }
};

}  // namespace hookpoint::control

/// Registers `Class` (a default-constructible Component) as `name`. Further arguments: attachment,
/// default input, default output.
#define HOOKPOINT_REGISTER_COMPONENT(Class, name, doc, ...)                               \
  namespace {                                                                             \
  const ::hookpoint::control::Registration registration_of_##Class(                       \
      ::hookpoint::control::describe_class<Class>(name, doc __VA_OPT__(, ) __VA_ARGS__)); \
  }

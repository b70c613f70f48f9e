// The contacts that `hookpoint translate` answers for: of a file's World, of a material by itself, or of
// another engine's parameters.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "apps/shared/application.h"
#include "translation/report.h"

namespace hookpoint::application {

struct TranslateRequest {
  std::string
      file;  ///< a .hook file with a World or Materials, a robot's file, or a name of materials/; "" with `from`
  Settings settings;
  std::optional<std::string> material;                               ///< of several, this one
  std::optional<std::string> load, mass, step, radius, area, creep;  ///< with their units
  std::optional<int> contacts;
  std::vector<std::string> to;     ///< engines; none: all
  std::string from;                ///< engine whose parameters are read
  std::vector<std::string> given;  ///< "key=value"
  Consent consent;
};

/// One answer a material under a robot of the experiment. Throws translation::ParameterError where its law or
/// its ground has nothing to translate.
std::vector<translation::Answer> contacts_of(simulation::Experiment experiment,
                                             const TranslateRequest& request);

/// One answer a material under a robot of a World, or a material of a file without one. None after errors of
/// the file, which are reported. Throws translation::ParameterError, and simulation::ExperimentError.
std::optional<std::vector<translation::Answer>> translated(Application& application,
                                                           const TranslateRequest& request);

}  // namespace hookpoint::application

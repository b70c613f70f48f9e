// An experiment as a model of another program: its robots, its ground and, as far as that has them,
// its contacts.
#pragma once

#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "simulation/experiment/experiment.h"
#include "translation/parameters.h"

namespace hookpoint::translation {

struct Model {
  std::string text;
  std::vector<std::string> left_out;  ///< what the format does not hold, each with a reason
};

/// Contact parameters of the ground as parameters of the format's engine (targets.h).
using ModelContact = std::optional<Parameters>;

/// A format of models: models/NAME.cpp has it.
struct ModelFormat {
  std::string_view name;    ///< as in `--to mjcf`
  std::string_view title;   ///< "MJCF, of MuJoCo"
  std::string_view engine;  ///< the target whose parameters its contacts have; "" for none
  bool one_robot = false;   ///< it holds one robot, and no world around it
  /// `robots`: indices into Experiment::robots. Throws ParameterError.
  Model (*write)(const simulation::Experiment& experiment, std::span<const std::size_t> robots,
                 const ModelContact& contact) = nullptr;
};

extern const ModelFormat mjcf_format, urdf_format, sdf_format;

std::span<const ModelFormat* const> model_formats();
/// Null for an unknown name.
const ModelFormat* find_model_format(std::string_view name);

}  // namespace hookpoint::translation

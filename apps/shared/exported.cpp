#include "apps/shared/exported.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "apps/shared/robot_file.h"
#include "text/display.h"

namespace hookpoint::application {
namespace {

using translation::ModelFormat;
using translation::ParameterError;

const ModelFormat& format_of(const std::string& name) {
  if (const ModelFormat* found = translation::find_model_format(name)) return *found;
  std::vector<std::string_view> known;
  for (const ModelFormat* format : translation::model_formats()) known.push_back(format->name);
  throw ParameterError(fmt::format("there is no format `{}` to export to: give {}",
                                   text::printable(name), fmt::join(known, ", ")));
}

/// Indices of the robots that are written.
std::vector<std::size_t> robots_of(const simulation::Experiment& experiment,
                                   const ModelFormat& format,
                                   const std::optional<std::string>& wanted) {
  std::vector<std::size_t> found;
  std::vector<std::string> names;
  for (std::size_t i = 0; i < experiment.robots.size(); ++i) {
    names.push_back(experiment.robots[i].name);
    if (!wanted || names.back() == *wanted) found.push_back(i);
  }
  if (found.empty() && wanted)
    throw ParameterError(fmt::format("there is no robot `{}`; there {} {}",
                                     text::printable(*wanted), names.size() == 1 ? "is" : "are",
                                     fmt::join(names, ", ")));
  if (found.empty()) throw ParameterError("the World has no robot to export");
  if (format.one_robot && found.size() > 1)
    throw ParameterError(fmt::format("{} holds one robot: give --robot with one of {}",
                                     format.title, fmt::join(names, ", ")));
  return found;
}

/// The ground's contact as parameters of the format's engine; in `left_out` why there is none.
translation::ModelContact contact_of(const simulation::Experiment& experiment,
                                     const ModelFormat& format, const ExportRequest& request,
                                     std::vector<std::string>& left_out) {
  if (format.engine.empty() || !experiment.terrain) return std::nullopt;
  TranslateRequest translate;
  translate.to = {std::string(format.engine)};
  translate.creep = request.creep;
  try {
    const auto answers = contacts_of(experiment, translate);
    if (answers.empty()) {
      left_out.emplace_back("the ground's contact: no robot rests on it at the start");
      return std::nullopt;
    }
    if (answers.size() > 1)
      left_out.push_back(
          fmt::format("contacts but that of robot {} on {}: a ground has one set of parameters",
                      answers.front().robot, answers.front().material));
    return answers.front().targets.front().parameters;
  } catch (const translation::NothingToTranslate& none) {
    left_out.push_back(fmt::format("the ground's contact: {}", none.what()));
  }
  return std::nullopt;
}

}  // namespace

std::optional<translation::Model> exported(Application& application, const ExportRequest& request) {
  const ModelFormat& format = format_of(request.format);
  const std::filesystem::path file = file_with_world(application, application.locate(request.file),
                                                     request.consent, RobotJoints::as_written);
  const auto root = application.evaluate_set(file, request.settings);
  if (!root) return std::nullopt;
  const auto experiment = application.load(*root);
  if (!experiment) return std::nullopt;
  const auto robots = robots_of(*experiment, format, request.robot);
  std::vector<std::string> left_out;
  const auto contact = contact_of(*experiment, format, request, left_out);
  translation::Model model = format.write(*experiment, robots, contact);
  model.left_out.insert(model.left_out.end(), left_out.begin(), left_out.end());
  return model;
}

}  // namespace hookpoint::application

// The neutral fixture: scenes with known truths (configs/fixture) that any engine can run. As a Wall
// for the engines at hand, and as a folder for whoever has no hookpoint.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "apps/shared/application.h"

namespace hookpoint::application {

/// The text of a file with the fixture's Wall under these subjects, as words of the command line
/// (subject_words.h): an engine alone is meant with each of its settings, our engine alone with each
/// of its laws. None: all of our laws, and every engine that is found. Throws SubjectError.
std::string fixture_wall(const Application& application, const std::vector<std::string>& subjects);

/// Writes the fixture into `folder`: check.py, and for each phenomenon its scene as the engine
/// protocol's experiment, as MJCF, URDF and SDF, its truth as expected.json, and a README. False after
/// errors of the scenes, which are reported. Throws output::FolderError, output::FileError.
bool export_fixture(Application& application, const std::filesystem::path& folder);

}  // namespace hookpoint::application

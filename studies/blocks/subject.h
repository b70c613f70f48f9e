// Subject blocks: engines with their laws, integrators and settings.
#pragma once

#include <array>
#include <string>
#include <vector>

#include "language/diagnostics.h"
#include "language/schema/schema.h"
#include "language/tree/object.h"
#include "studies/blocks/only.h"
#include "studies/results/assignment.h"
#include "studies/results/result.h"

namespace hookpoint::studies {

struct StudyParts;

/// Words of the World that say which engine runs a scene and how; "" leaves the scene's own.
struct Composition {
  std::string engine, contact, integrator, settings;
};

struct CompositionWord {
  const char* field;  ///< of World and Subject
  std::string Composition::*member;
  const char* doc;
};
inline constexpr std::array composition_words{
    CompositionWord{"engine", &Composition::engine, "which engine runs the scene"},
    CompositionWord{"contact", &Composition::contact, "the contact law, of engine dts"},
    CompositionWord{"integrator", &Composition::integrator, "the integrator, of engine dts"},
    CompositionWord{
        "settings", &Composition::settings,
        "another engine's settings: default, recommended, matched, and those of one engine alone"}};

struct SubjectPlan : Composition {
  SubjectInfo info;
  std::vector<Assignment> fixes;
  std::vector<Condition> only;
};

/// Call after the World's class has been added: the choices of engine, law and integrator are its.
void add_subject_class(language::Schema& schema);

/// What the block says of engine, law, integrator and settings; its Fix and Only blocks are left to
/// the caller.
SubjectPlan subject_of(const language::Object& block);

/// A Subject of a Study. Errors where it sets what is swept, or a law of an engine that has its own
/// contact.
SubjectPlan load_subject(const language::Object& block, const StudyParts& so_far,
                         language::Diagnostics& diagnostics);

/// The subjects that `names` holds, as indices; errors for names that there are not.
std::vector<int> named_subjects(const language::Field* names, const StudyParts& so_far,
                                language::Diagnostics& diagnostics);

}  // namespace hookpoint::studies

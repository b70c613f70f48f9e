// The classes of ground whose heights are read or computed, and what all classes of ground share;
// for the files of the load step alone.
#pragma once

#include "simulation/scene/load_parts.h"
#include "simulation/scene/terrain/surface.h"

namespace hookpoint::simulation {

/// A class of ground with fields of its `own`, and with those that every ground has.
language::ClassSchema terrain_class(const char* name, const char* doc,
                                    std::vector<language::FieldSchema> own);

/// Extent along x,y: one number or two.
inline constexpr const char* size_field = "size";

/// `size` of a computed ground, which cannot be unbounded.
language::FieldSchema grid_size_field();
/// How far a computed ground reaches, its cells as large as `extent` or the file says.
void load_size(const language::Object& object, Extent& extent);

void add_grid_class(language::Schema& schema);
void add_rough_class(language::Schema& schema);
void add_steps_class(language::Schema& schema);

// The heights of an object of each class; the edge of its cells goes to `terrain`. Errors are
// reported.

GridSpec load_grid(const language::Object& object, TerrainSpec& terrain, Loading& loading);
GridSpec load_rough(const language::Object& object, TerrainSpec& terrain, Loading& loading);
GridSpec load_steps(const language::Object& object, TerrainSpec& terrain, Loading& loading);

}  // namespace hookpoint::simulation

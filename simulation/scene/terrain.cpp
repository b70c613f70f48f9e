#include <fmt/format.h>

#include "simulation/material_fields.h"
#include "simulation/scene/schema.h"
#include "simulation/scene/fields.h"

namespace hookpoint::simulation {
namespace {

language::ClassSchema material_class() {
  language::ClassSchema material;
  material.name = "Material";
  material.doc = "the surface of ground tiles; each contact law reads the constants that it knows";
  material.naming = language::Naming::required;
  material.top_level = true;
  const contact::MaterialConstants<double> defaults;
  for (const MaterialField& constant : material_fields()) {
    // Each coefficient of friction stands in for the other when only one is given.
    const bool friction = std::string(constant.name).ends_with("_friction");
    FieldSchema field =
        number_field(constant.name, constant.unit,
                     friction ? "" : fmt::format("{}", defaults.*constant.member), constant.doc);
    field = constant.positive ? positive(std::move(field)) : not_negative(std::move(field));
    if (field.name == "restitution" || field.name == "breakaway") field.maximum = 1.;
    material.fields.push_back(std::move(field));
  }
  return material;
}

language::ClassSchema terrain_class(const char* name, const char* doc,
                                    std::vector<FieldSchema> own) {
  language::ClassSchema terrain;
  terrain.name = name;
  terrain.doc = doc;
  terrain.naming = language::Naming::required;
  terrain.top_level = true;
  terrain.children = {"Patch"};
  terrain.fields = std::move(own);
  terrain.fields.push_back(object_field(
      "material", "Material",
      "of every tile that no Patch covers; if not given, a material with all defaults"));
  return terrain;
}

FieldSchema spacing() {
  return positive(number_field("spacing", "m", "1", "edge of a cell of two tiles"));
}

FieldSchema extent() {
  return not_negative(list_field(
      "size", "m", 1, 2, "0",
      "extent along x,y (one number: both), centred on the world's origin; 0 is unbounded"));
}

language::ClassSchema slope_class() {
  FieldSchema angle =
      required(not_negative(number_field("angle", "rad", "", "of the fall, below 90 deg")));
  angle.maximum = 1.57;
  return terrain_class(
      "Terrain.Slope",
      "a plane through the world's origin that falls along +x turned by azimuth about z",
      {angle, number_field("azimuth", "rad", "0", "direction of the fall, from +x about z"),
       spacing(), extent()});
}

/// Of a computed ground, which cannot be unbounded.
FieldSchema grid_extent() {
  return positive(list_field("size", "m", 1, 2, "10",
                             "extent along x,y (one number: both), centred on the world's origin "
                             "and made up to an even number of cells"));
}

language::ClassSchema grid_class() {
  return terrain_class(
      "Terrain.Grid",
      "heights from a file: an ESRI ASCII grid, a plain matrix whose first line has the least y, "
      "or a grayscale PNG of 8 or 16 bits whose top has the greatest y",
      {required(text_field("file",
                           "looked up beside the .hook file, then along the search path; "
                           "an image is known by its ending .png")),
       positive(number_field("spacing", "m", "",
                             "edge of a cell, that is from pixel to pixel; if not given, the "
                             "file's cellsize, or 1 m")),
       list_field("origin", "m", 2, 2, "",
                  "world x,y of the corner of least x and y; if not given, the file's, or such "
                  "that the grid is centred"),
       number_field("height", "m", "0", "added to every height"),
       number_field("low", "m", "", "of a PNG, and needed there: the height of black"),
       number_field("high", "m", "", "of a PNG, and needed there: the height of white")});
}

language::ClassSchema rough_class() {
  FieldSchema slope = not_negative(
      number_field("slope", "rad", "0", "of the plane that the heights are over, below 90 deg"));
  slope.maximum = 1.57;
  return terrain_class(
      "Terrain.Rough",
      "smooth random ground: 64 plane waves of equal amplitude, 1/sqrt(2) to sqrt(2) wavelengths "
      "long, in all directions",
      {required(not_negative(number_field("amplitude", "m", "",
                                          "largest height or depth of a vertex; the mean is 0"))),
       required(positive(number_field("wavelength", "m", "", "of the middle of the band"))),
       not_negative(integer_field("seed", "1", "another seed, another ground of the same kind")),
       not_negative(number_field("flat_radius", "m", "0",
                                 "up to here from the world's origin the ground is plane, to be "
                                 "stood on; it is rough from one wavelength further out")),
       slope, number_field("azimuth", "rad", "0", "direction of the slope's fall, from +x about z"),
       positive(number_field("spacing", "m", "",
                             "edge of a cell of two tiles, at most a quarter of the wavelength; if "
                             "not given, an eighth")),
       grid_extent()});
}

language::ClassSchema steps_class() {
  return terrain_class(
      "Terrain.Steps",
      "stairs along +x turned by azimuth about z; a riser is a ramp one cell wide, at the foot of "
      "its tread",
      {required(number_field("height", "m", "", "of one step; below 0 they go down")),
       required(positive(number_field("run", "m", "", "from one riser to the next"))),
       at_least(1., integer_field("count", "", "of steps; if not given, to the ground's edge")),
       number_field("from", "m", "0.5",
                    "of the first riser's foot from the world's origin, along the stairs"),
       number_field("azimuth", "rad", "0",
                    "direction of the stairs, from +x about z; risers are exact at quarter turns"),
       positive(number_field("spacing", "m", "0.02", "edge of a cell of two tiles")),
       grid_extent()});
}

language::ClassSchema patch_class() {
  language::ClassSchema patch;
  patch.name = "Patch";
  patch.doc =
      "gives the tiles whose centroid is in a rectangle another material; later patches cover "
      "earlier ones";
  patch.fields = {
      required(list_field("from", "m", 2, 2, "", "one corner, world x,y")),
      required(list_field("to", "m", 2, 2, "", "the corner opposite, world x,y")),
      required(object_field("material", "Material", "of the tiles covered")),
  };
  return patch;
}

}  // namespace

void add_ground_classes(language::Schema& schema) {
  schema.add(material_class());
  schema.add(
      terrain_class("Terrain.Flat", "level ground",
                    {number_field("height", "m", "0", "z of the ground"), spacing(), extent()}));
  schema.add(slope_class());
  schema.add(grid_class());
  schema.add(rough_class());
  schema.add(steps_class());
  schema.add(patch_class());
}

}  // namespace hookpoint::simulation

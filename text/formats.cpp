#include "text/formats.h"

#include <algorithm>
#include <array>
#include <fstream>
#include <span>

#include "text/letters.h"

namespace hookpoint::text {
namespace {

using namespace std::string_view_literals;

/// What a format holds, which decides the advice.
enum class Holds { robot, mesh, image, table, text, program, nothing };

/// How the content shows the format.
enum class Sign {
  none,       ///< it does not: the name does
  beginning,  ///< its first bytes
  element,    ///< the name of the first element of XML
  json        ///< an object or array of JSON
};

constexpr unsigned bit(Use use) { return static_cast<unsigned>(use); }

constexpr unsigned read_nowhere = 0;

/// What of a file shows its format.
enum class Shown {
  by_either,        ///< its content; its name, unless the content is text that lacks the signs
  by_name_of_text,  ///< the same, and its name where the content is any text
  by_both,          ///< content and name together
  last              ///< its content, where nothing else shows a format: what holds other formats
};

/// A format. Signs and endings are alternatives, separated by '|'.
struct Format {
  std::string_view name;
  std::string_view description;  ///< "" when the name says it; of what holds nothing, what to do
  Holds holds;
  Sign sign;
  std::string_view signs;
  std::string_view endings;  ///< lower case, each with its dot; the first is the usual one
  unsigned read_as;          ///< uses that read it
  Shown shown = Shown::by_either;
};

/// More special formats first: the first row that fits is the file's.
constexpr std::array table{
    // What stands for another file.
    Format{"a pointer of Git LFS",
           "the file itself was not fetched; run `git lfs pull` where it lies", Holds::nothing,
           Sign::beginning, "version https://git-lfs.github.com/spec/", "", read_nowhere},
    Format{"a web page", "fetch the file that it shows instead", Holds::nothing, Sign::element,
           "html|!DOCTYPE html", "", read_nowhere},
    // Robots and scenes.
    Format{"MJCF", "the format of MuJoCo", Holds::robot, Sign::element, "mujoco|mujocoinclude",
           ".mjcf", bit(Use::experiment)},
    Format{"SDF", "the format of Gazebo", Holds::robot, Sign::element, "sdf|gazebo", ".sdf|.world",
           bit(Use::experiment)},
    Format{"SRDF", "the groups of MoveIt, beside a URDF", Holds::robot, Sign::element, "robot",
           ".srdf", read_nowhere, Shown::by_both},
    Format{"URDF", "", Holds::robot, Sign::element, "robot", ".urdf|.xacro", bit(Use::experiment)},
    Format{"a model of OpenSim", "", Holds::robot, Sign::element, "OpenSimDocument", ".osim",
           read_nowhere},
    Format{"a model of DART", "", Holds::robot, Sign::element, "skel", ".skel", read_nowhere},
    Format{"a model of OpenRAVE", "", Holds::robot, Sign::element, "KinBody|Robot|Environment", "",
           read_nowhere},
    Format{"a launch file of ROS", "", Holds::text, Sign::element, "launch", ".launch",
           read_nowhere},
    Format{"a world of Webots", "", Holds::robot, Sign::beginning, "#VRML_SIM", ".wbt|.proto",
           read_nowhere},
    Format{"a scene of CoppeliaSim", "", Holds::robot, Sign::beginning, "VREP",
           ".ttt|.ttm|.simscene", read_nowhere},
    Format{"USD", "Universal Scene Description", Holds::robot, Sign::beginning, "#usda|PXR-USDC",
           ".usd|.usda|.usdc|.usdz", read_nowhere},
    Format{"glTF", "", Holds::robot, Sign::beginning, "glTF", ".gltf|.glb", read_nowhere},
    Format{"FBX", "", Holds::robot, Sign::beginning, "Kaydara FBX Binary|; FBX", ".fbx",
           read_nowhere},
    Format{"a file of Blender", "", Holds::robot, Sign::beginning, "BLENDER", ".blend",
           read_nowhere},
    Format{"STEP", "CAD", Holds::robot, Sign::beginning, "ISO-10303-21", ".step|.stp",
           read_nowhere},
    Format{"IGES", "CAD", Holds::robot, Sign::none, "", ".iges|.igs", read_nowhere,
           Shown::by_name_of_text},
    Format{"BVH", "motion capture", Holds::robot, Sign::beginning, "HIERARCHY", ".bvh",
           read_nowhere},
    // Meshes.
    Format{"Collada", "", Holds::mesh, Sign::element, "COLLADA", ".dae", bit(Use::mesh)},
    Format{"PLY", "", Holds::mesh, Sign::beginning, "ply\n|ply\r", ".ply", read_nowhere},
    Format{"VRML", "", Holds::mesh, Sign::beginning, "#VRML", ".wrl", read_nowhere},
    Format{"X3D", "", Holds::mesh, Sign::element, "X3D|x3d", ".x3d", read_nowhere},
    Format{"OFF", "", Holds::mesh, Sign::beginning, "OFF\n|OFF\r", ".off", read_nowhere},
    Format{"3MF", "", Holds::mesh, Sign::none, "", ".3mf", read_nowhere},
    Format{"STL", "", Holds::mesh, Sign::none, "", ".stl", bit(Use::mesh), Shown::by_name_of_text},
    Format{"OBJ", "", Holds::mesh, Sign::none, "", ".obj", bit(Use::mesh), Shown::by_name_of_text},
    // Images.
    Format{"a PNG image", "", Holds::image, Sign::beginning, "\x89PNG\r\n", ".png",
           bit(Use::heights)},
    Format{"a JPEG image", "", Holds::image, Sign::beginning, "\xff\xd8\xff", ".jpg|.jpeg",
           read_nowhere},
    Format{"a TIFF image", "", Holds::image, Sign::beginning, "II*\0|MM\0*"sv, ".tif|.tiff",
           read_nowhere},
    Format{"a GIF image", "", Holds::image, Sign::beginning, "GIF87a|GIF89a", ".gif", read_nowhere},
    Format{"an OpenEXR image", "", Holds::image, Sign::beginning, "v/1\x01", ".exr", read_nowhere},
    Format{"an SVG image", "", Holds::image, Sign::element, "svg", ".svg", read_nowhere},
    // Columns of numbers.
    Format{"a MAT file", "", Holds::table, Sign::beginning,
           "MATLAB 5.0 MAT-file|MATLAB 7.3 MAT-file", ".mat", bit(Use::series)},
    Format{"HDF5", "`hookpoint replay` opens the movie of a run", Holds::table, Sign::beginning,
           "\x89HDF\r\n", ".h5|.hdf5", read_nowhere},
    Format{"MCAP", "", Holds::table, Sign::beginning, "\x89MCAP", ".mcap", read_nowhere},
    Format{"a bag of ROS", "", Holds::table, Sign::beginning, "#ROSBAG|SQLite format 3",
           ".bag|.db3", read_nowhere},
    Format{"an array of NumPy", "", Holds::table, Sign::beginning, "\x93NUMPY", ".npy|.npz",
           read_nowhere},
    Format{"Parquet", "", Holds::table, Sign::beginning, "PAR1", ".parquet", read_nowhere},
    Format{"a spreadsheet", "", Holds::table, Sign::beginning, "\xd0\xcf\x11\xe0",
           ".xlsx|.xls|.ods", read_nowhere},
    Format{"C3D", "motion capture", Holds::table, Sign::none, "", ".c3d", read_nowhere},
    Format{"CSV", "", Holds::table, Sign::none, "", ".csv", bit(Use::series) | bit(Use::heights),
           Shown::by_name_of_text},
    // Other text and programs.
    Format{"YAML", "", Holds::text, Sign::beginning, "%YAML|---\n", ".yaml|.yml", read_nowhere,
           Shown::by_name_of_text},
    Format{"TOML", "", Holds::text, Sign::none, "", ".toml", read_nowhere, Shown::by_name_of_text},
    Format{"Python", "", Holds::program, Sign::beginning, "#!/usr/bin/env python|#!/usr/bin/python",
           ".py", read_nowhere, Shown::by_name_of_text},
    Format{"a notebook of Jupyter", "", Holds::program, Sign::none, "", ".ipynb", read_nowhere},
    Format{"a program or library", "", Holds::program, Sign::beginning,
           "\x7f"
           "ELF",
           ".so", read_nowhere},
    Format{"PDF", "", Holds::text, Sign::beginning, "%PDF-", ".pdf", read_nowhere},
    // What may hold any of those above.
    Format{"JSON", "", Holds::text, Sign::json, "", ".json", read_nowhere, Shown::last},
    Format{"XML", "", Holds::text, Sign::element, "*", ".xml", read_nowhere, Shown::last},
    Format{"a packed archive", "unpack it first", Holds::nothing, Sign::beginning,
           "PK\x03\x04|\x1f\x8b|7z\xbc\xaf|BZh9|\xfd"
           "7zXZ",
           ".zip|.gz|.7z|.bz2|.xz|.tar", read_nowhere, Shown::last},
};

constexpr std::string_view any_element = "*";
constexpr std::string_view blank_characters = " \t\r\n\v\f";

/// Whether `test` holds for one of the parts of `list` that '|' separates.
template <class Test>
bool any_part(std::string_view list, const Test& test) {
  while (!list.empty()) {
    const std::size_t end = std::min(list.find('|'), list.size());
    if (test(list.substr(0, end))) return true;
    list.remove_prefix(std::min(end + 1, list.size()));
  }
  return false;
}

void skip_blanks(std::string_view& text) {
  text.remove_prefix(std::min(text.find_first_not_of(blank_characters), text.size()));
}

void skip_past(std::string_view& text, std::string_view end) {
  const std::size_t at = text.find(end);
  text.remove_prefix(at == std::string_view::npos ? text.size() : at + end.size());
}

std::string_view without_mark(std::string_view text) {
  constexpr std::string_view byte_order_mark = "\xef\xbb\xbf";
  if (text.starts_with(byte_order_mark)) text.remove_prefix(byte_order_mark.size());
  return text;
}

/// Name of the first element of XML behind declarations and comments, "!DOCTYPE html" as it is; ""
/// when the text is no XML.
std::string_view first_element(std::string_view text) {
  constexpr std::string_view page = "!DOCTYPE html";
  for (skip_blanks(text); text.starts_with('<'); skip_blanks(text)) {
    if (text.starts_with("<!--")) {
      skip_past(text, "-->");
    } else if (text.starts_with("<?")) {
      skip_past(text, "?>");
    } else if (text.substr(1).starts_with(page) || text.substr(1).starts_with("!doctype html")) {
      return page;
    } else if (text.starts_with("<!")) {
      // A document type may hold declarations of its own.
      if (text.find('[') < text.find('>')) skip_past(text, "]");
      skip_past(text, ">");
    } else {
      return text.substr(1, std::min(text.find_first_of(" \t\r\n/>"), text.size()) - 1);
    }
  }
  return "";
}

/// `{` and a name in quotes, or `[` and a value: what no file of the language begins with.
bool begins_as_json(std::string_view text) {
  skip_blanks(text);
  if (!text.starts_with('{') && !text.starts_with('[')) return false;
  const char open = text.front();
  text.remove_prefix(1);
  skip_blanks(text);
  constexpr std::string_view begins_a_value = "{[\"-0123456789]";
  return text.starts_with(open == '{'    ? '"'
                          : text.empty() ? ']'
                                         : text.front()) &&
         !text.empty() &&
         (open == '{' || begins_a_value.find(text.front()) != std::string_view::npos);
}

bool content_shows(const Format& format, std::string_view content) {
  switch (format.sign) {
    case Sign::beginning:
      return any_part(format.signs,
                      [&](std::string_view sign) { return content.starts_with(sign); });
    case Sign::element: {
      const std::string_view element = first_element(content);
      return !element.empty() && any_part(format.signs, [&](std::string_view sign) {
        return sign == any_element || element == sign;
      });
    }
    case Sign::json:
      return begins_as_json(content);
    case Sign::none:
      return false;
  }
  return false;
}

std::string ending_of(const std::filesystem::path& name) {
  return lower_case(name.extension().string());
}

bool name_shows(const Format& format, const std::string& ending) {
  return !ending.empty() &&
         any_part(format.endings, [&](std::string_view known) { return ending == known; });
}

/// Text that is neither XML nor JSON: nothing but a name could say that it is more.
bool is_plain_text(std::string_view content) {
  const bool text = std::ranges::all_of(content, [](char c) {
    return static_cast<unsigned char>(c) >= ' ' ||
           blank_characters.find(c) != std::string_view::npos;
  });
  return text && first_element(content).empty() && !begins_as_json(content);
}

const Format* find(std::string_view content, const std::filesystem::path& name) {
  content = without_mark(content.substr(0, enough_bytes));
  const std::string ending = ending_of(name);
  const bool plain = is_plain_text(content);
  const auto first = [](const auto& shows) -> const Format* {
    const auto* const found = std::ranges::find_if(table, shows);
    return found == table.end() ? nullptr : found;
  };
  const Format* found = first([&](const Format& format) {
    return format.shown != Shown::last && content_shows(format, content) &&
           (format.shown != Shown::by_both || name_shows(format, ending));
  });
  if (found != nullptr) return found;
  found = first([&](const Format& format) {
    return format.shown != Shown::by_both && name_shows(format, ending) &&
           (!plain || format.shown == Shown::by_name_of_text);
  });
  if (found != nullptr) return found;
  return first([&](const Format& format) { return content_shows(format, content); });
}

std::string_view read_there(Use use) {
  switch (use) {
    case Use::experiment:
      return "expected a file of the language (.hook), a URDF (.urdf, .xacro), an MJCF (.xml) or an SDF "
             "(.sdf, .world)";
    case Use::mesh:
      return "meshes are read from STL, OBJ and DAE (Collada) files";
    case Use::heights:
      return "heights are read from an ESRI ASCII grid, a matrix of numbers as text, or a "
             "grayscale PNG";
    case Use::series:
      return "series are read from tables as text (.csv, .tsv, .txt, .mot, .sto, .trc) and from MAT "
             "files (.mat)";
  }
  return "";
}

/// What to do with a file that holds something else than is read.
std::string_view advice(const Format& format, Use use) {
  if (use == Use::mesh) return "convert it to one of them";
  if (use == Use::heights) return "export the heights as one of them";
  if (use == Use::series) return "save the columns as CSV";
  switch (format.holds) {
    case Holds::robot:
      return "take the robot's URDF, MJCF or SDF, or convert it to one, and Include that";
    case Holds::mesh:
      return "a mesh is the <mesh> of a link of a URDF";
    case Holds::image:
      return "an image is the `file` of a Terrain.Grid";
    case Holds::table:
      return "columns of numbers are the `file` of a Data or of a Trace";
    case Holds::text:
    case Holds::program:
    case Holds::nothing:
      return "give the file that holds the World, the Study or the robot";
  }
  return "";
}

}  // namespace

std::string_view usual_ending(std::string_view content, const std::filesystem::path& name) {
  const Format* format = find(content, name);
  return format == nullptr ? "" : format->endings.substr(0, format->endings.find('|'));
}

std::string refusal(std::string_view content, const std::filesystem::path& name, Use use) {
  const Format* format = find(content, name);
  if (format == nullptr) return "";
  if ((format->read_as & bit(use)) != 0) return "";
  std::string text = "this is " + std::string(format->name);
  const std::string description(format->description);
  if (format->holds == Holds::nothing) return text + ": " + description;
  if (!description.empty()) text += " (" + description + ")";
  return text + ", which is not read here: " + std::string(read_there(use)) + "; " +
         std::string(advice(*format, use));
}

std::string refusal(const std::filesystem::path& path, Use use) {
  std::ifstream stream(path, std::ios::binary);
  std::string content(enough_bytes, '\0');
  stream.read(content.data(), static_cast<std::streamsize>(content.size()));
  if (stream.bad() || !stream.is_open()) return "";
  content.resize(static_cast<std::size_t>(stream.gcount()));
  return refusal(content, path, use);
}

}  // namespace hookpoint::text

// The models of an SDFormat file with those that they include, and where each of their frames stands.
#pragma once

#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <unordered_map>
#include <unordered_set>
#include <vector>

#include "language/syntax/files.h"
#include "simulation/experiment/kinematics.h"
#include "simulation/scene/urdf/xml.h"

namespace hookpoint::simulation {

struct SdfModel;

/// What a pose may be relative to: a link, joint, frame or model, by its name in a model.
struct SdfFrame {
  XmlElement element;
  SdfModel* model = nullptr;  ///< where it is one
  std::optional<Pose> known;  ///< in the frame of the model that holds it, once it is computed
  bool visiting = false;
};

/// A model, or the world, which holds the outermost models.
struct SdfModel {
  std::string own_name;  ///< in the model that holds it
  std::string name;      ///< with those of the models around it, "arm::hand"; "" of the world
  XmlElement element;    ///< what holds its links
  XmlElement placed_by;  ///< what gives its pose: an <include>, or itself
  SdfModel* outer = nullptr;
  int version = 0;  ///< 1007 of SDFormat 1.7, that of its file
  bool is_static = false;
  std::string placement_frame;  ///< that stands at the pose; "" for the model's own
  std::vector<std::unique_ptr<SdfModel>> models;
  std::unordered_map<std::string, SdfFrame> frames;
  std::vector<std::string> links;  ///< their names, in the file's order
  /// Joints called like something else, which formats before 1.7 allow; they are no frames.
  std::unordered_set<std::string> joints;
};

class SdfDocument {
 public:
  SdfDocument(const language::SourceFile& file, language::FileStore& files,
              language::Report& report);

  /// False after an error.
  bool open();
  bool good() const;
  SdfModel& world() { return world_; }
  const XmlElement& root() const { return root_; }
  const std::filesystem::path& path_of(const XmlElement& element) const;
  /// Models stand in models at most so deep.
  static constexpr std::size_t deepest = 100;
  /// Files that are included and hold a light or an actor.
  std::size_t lights() const { return lights_; }

  /// Where `name` stands in `scope`: X_SF. `from` is where that name is written.
  Pose pose_of(SdfModel& scope, std::string_view name, const XmlElement& from,
               std::size_t depth = 0);
  /// The frame of an element, `otherwise` that which its pose is relative to if it says none: X_SF.
  Pose pose_of_element(SdfModel& scope, const XmlElement& element, const std::string& otherwise,
                       std::size_t depth = 0);
  /// The same of what a link holds, which stands in the link's frame if it says nothing else: X_LF.
  Pose pose_in_link(SdfModel& scope, const std::string& link, const XmlElement& element);
  /// The scope and the name of the link that `name` of `scope` belongs to; no scope after an error,
  /// the world's scope and "world" for the world.
  struct LinkName {
    SdfModel* scope = nullptr;
    std::string name;
  };
  LinkName link_of(SdfModel& scope, std::string_view name, const XmlElement& from,
                   std::size_t depth = 0);
  /// What an element says, `true` or 1, `false` or 0, in letters of any size; `otherwise` where there is
  /// none. Anything else is an error.
  static bool flag(const XmlElement& parent, const char* name, bool otherwise);
  static bool flag_attribute(const XmlElement& of, const char* name);
  /// The text of an element in another, trimmed; "" where there is none.
  static std::string text_of(const XmlElement& parent, const char* name);
  static XmlElement child(const XmlElement& parent, const char* name);

 private:
  /// What an included file holds.
  struct Opened {
    XmlElement model;
    int version = 0;
    bool is_light = false;
  };
  /// Parsed once, however often it is included.
  const Opened& open_file(const std::filesystem::path& path);
  int version_of(const XmlElement& root);
  void read_contents(SdfModel& model, std::size_t depth);
  void add_model(SdfModel& outer, const XmlElement& element, const XmlElement& placed_by,
                 int version, std::size_t depth);
  void add_included(SdfModel& outer, const XmlElement& include, std::size_t depth);
  void add_frame(SdfModel& model, const std::string& name, SdfFrame frame);
  std::filesystem::path find_model(const std::string& uri, const XmlElement& at);
  Pose frame_pose(SdfModel& scope, const std::string& name, SdfFrame& frame, std::size_t depth);
  Pose written_pose(const XmlElement& pose);
  SdfFrame* find_frame(SdfModel& scope, std::string_view name, const XmlElement& from);

  const language::SourceFile& file_;
  language::FileStore& files_;
  language::Report& report_;
  std::vector<std::unique_ptr<UrdfXml>> open_files_;
  std::unordered_map<const UrdfXml*, std::filesystem::path> paths_;
  std::vector<std::string>
      including_;  ///< paths of the files that include each other, outermost first
  std::unordered_map<std::string, Opened> opened_;
  std::size_t included_ = 0;  ///< models so far
  std::size_t lights_ = 0;
  XmlElement root_;
  SdfModel world_;
};

}  // namespace hookpoint::simulation

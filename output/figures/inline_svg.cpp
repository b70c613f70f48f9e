#include "output/figures/inline_svg.h"

#include <pugixml.hpp>
#include <sstream>
#include <string_view>

namespace hookpoint::output {
namespace {

/// Makes a drawing's elements those of a page.
class Inliner final : public pugi::xml_tree_walker {
 public:
  explicit Inliner(const std::string& prefix) : prefix_(prefix + "-") {}

  bool for_each(pugi::xml_node& element) override {
    // What is drawn in `currentColor` then has the page's.
    if (is(element, "color", "black")) element.remove_attribute("color");
    for (pugi::xml_attribute attribute : element.attributes()) change(attribute);
    return true;
  }

 private:
  static bool is(const pugi::xml_node& element, const char* name, std::string_view value) {
    return element.attribute(name).value() == value;
  }

  void change(pugi::xml_attribute attribute) const {
    const std::string_view name = attribute.name(), value = attribute.value();
    if (name == "id") {
      attribute = (prefix_ + attribute.value()).c_str();
    } else if (name == "xlink:href" && value.starts_with('#')) {
      attribute.set_name("href");
      attribute = ("#" + prefix_ + (attribute.value() + 1)).c_str();
    } else if ((name == "fill" && value == "black") ||
               (name == "stroke" && (value == "black" || value == "rgb(  0,   0,   0)"))) {
      attribute = "currentColor";
    } else if (value == "rgb(221, 221, 221)") {
      attribute = "rgba(128, 128, 128, 0.3)";  // lines of the grid, on a dark page too
    }
  }

  std::string prefix_;
};

}  // namespace

std::optional<std::string> inline_svg(const std::string& svg, const std::string& prefix,
                                      const std::string& description) {
  pugi::xml_document document;
  // Blanks between the parts of a label are text, too.
  const bool parsed =
      document.load_string(svg.c_str(), pugi::parse_default | pugi::parse_ws_pcdata);
  pugi::xml_node root = document.document_element();
  if (!parsed || std::string_view(root.name()) != "svg") return std::nullopt;
  const pugi::xml_node background = root.find_node([](const pugi::xml_node& node) {
    return std::string_view(node.name()) == "rect" && node.attribute("x").as_int(-1) == 0 &&
           node.attribute("y").as_int(-1) == 0;
  });
  background.parent().remove_child(background);
  Inliner inliner(prefix);
  inliner.for_each(root);
  root.traverse(inliner);
  root.prepend_attribute("aria-label") = description.c_str();
  root.prepend_attribute("role") = "img";
  std::ostringstream page;
  root.print(page, "", pugi::format_raw | pugi::format_no_declaration, pugi::encoding_utf8);
  return page.str();
}

}  // namespace hookpoint::output

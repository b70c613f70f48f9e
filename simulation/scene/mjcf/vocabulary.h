// The elements and attributes of MJCF that matter to a robot, as MuJoCo 3.14 knows them.
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "simulation/scene/mjcf/document.h"

namespace hookpoint::simulation {

/// Whether `tag` is an element of <actuator>. In a default class they are one and the same: each sets
/// what all are.
bool is_mjcf_actuator(std::string_view tag);

/// False after an error: MuJoCo knows no such element in a <`parent`>. Any is known in a parent that
/// nothing here reads.
bool check_mjcf_child(const XmlElement& element, std::string_view parent);

/// An error at each attribute that MuJoCo does not know of this element, and at numbers that are none
/// of attributes that are not read. Elements that nothing here reads are not looked into.
void check_mjcf_attributes(const XmlElement& element);

/// Those of its attributes, also from its classes, that bear on motion and are not read.
std::vector<std::string> unread_mjcf_attributes(const MjcfAttributes& given);

}  // namespace hookpoint::simulation

// What two materials make of a contact that both have a part in: the foot's and the ground's
// (docs/contact.md, "Materials of both sides").
#pragma once

#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "contact/vocabulary.h"

namespace hookpoint::contact {

/// Which coefficient of friction, and which other constant but stiffness and damping, holds where
/// foot and ground state one each.
enum class Combination { foot, ground, minimum, maximum, product, geometric, harmonic, series };

/// One row of the table of rules.
struct CombinationRule {
  Combination rule;
  std::string_view name;     ///< as in `combine = foot`
  std::string_view formula;  ///< of the foot's a and the ground's b
  double (*combine)(double foot, double ground);
};

/// Every rule, in the order of the enumeration.
std::span<const CombinationRule> combination_rules();
std::vector<std::string> combination_names();

/// The constants of a contact between two materials. Stiffness and damping are in series under every
/// rule, k = a b/(a + b): the two sides carry the same force. Friction, restitution, adhesion and the
/// resistances to rolling and spinning follow the rule. What else a law reads are shapes and scales of
/// its curve, of which no mean has a meaning: the ground's under `ground`, else the foot's.
MaterialConstants<double> combine(const MaterialConstants<double>& foot,
                                  const MaterialConstants<double>& ground, Combination rule);

}  // namespace hookpoint::contact

#pragma once
/// What the directives of a deck must be to each other: the tools, and the groups of relations. A finding is
/// told at the place of the first of its directives, and only where all of them are sound: one slip, one
/// message.

#include <initializer_list>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "core/deck/findings.hpp"

namespace treejet {

constexpr double round_off = 1e-9;  ///< relative: a third of 0.02 typed with ten digits is a third

class Relations {
 public:
  Relations(const Place& deck, const std::vector<Given>& given, const Parameters& p, Findings& findings)
      : p_(p), findings_(findings), deck_(deck), given_(given) {}

 protected:
  /// Blames the first of the directives concerned.
  void error(bool violated, const std::vector<std::string_view>& directives, const std::string& message);
  void note(bool holds, std::string_view words, const std::string& message);

  bool is_given(std::string_view words) const;
  bool sound(std::string_view words) const;

  /// Details of what a deck may leave off.
  void only_with(bool on, const char* that, std::initializer_list<const char*> details);

  /// A feature that knows these laws alone, and nothing that adds to them.
  void law_without_extras(const char* feature, bool known, std::string_view laws, std::string_view why);

  /// Of the initial jet, cm; none if its lines are faulty, or divide it twice or not at all.
  std::optional<double> element_length() const;

  /// Everything that scales and groups are made of is given and sound.
  bool composable() const;

  const Place& deck() const { return deck_; }

  const Parameters& p_;
  Findings& findings_;

 private:
  const Given* find(std::string_view words) const;
  Finding about(std::string_view words, const std::string& message) const;

  const Place& deck_;
  const std::vector<Given>& given_;
};

void check_jet(const Relations& all);
void check_forces(const Relations& all);
void check_fluid(const Relations& all);

}  // namespace treejet

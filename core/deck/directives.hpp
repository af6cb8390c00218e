#pragma once
/// The directives of a deck as one table: parser, defaults, checks, template and documentation are all read
/// off it.
///
/// A row binds the words of a directive to a member of Parameters; the member's type says which argument it
/// takes and a default-constructed Parameters says its default. The directives of JETSPIN that
/// Treejet does not model are in core/deck/foreign.hpp.

#include <span>
#include <string>
#include <string_view>
#include <variant>

#include "core/jet/parameters.hpp"

namespace treejet {

/// What a number must be, in words that follow "expected".
struct Check {
  std::string_view words;
  bool (*holds)(double);
};

using Member =
    std::variant<double Parameters::*, std::optional<double> Parameters::*, int Parameters::*,
                 std::optional<int> Parameters::*, bool Parameters::*, std::vector<std::string> Parameters::*,
                 Scheme Parameters::*, EventRule Parameters::*, Multirate Parameters::*, Units Parameters::*,
                 CoulombSum Parameters::*, TreeOrder Parameters::*, ExpansionKind Parameters::*,
                 ParallelData Parameters::*, std::optional<bool> Parameters::*, DragModel Parameters::*,
                 Wave Parameters::*, std::vector<double> Parameters::*, SelfField Parameters::*,
                 SurfaceModel Parameters::*, StressLawKind Parameters::*, EvaporationModel Parameters::*,
                 SolventName Parameters::*, Feed Parameters::*, Model Parameters::*, CoulombLaw Parameters::*,
                 std::string Parameters::*>;

struct Directive {
  std::string_view words;
  Member member;
  std::string_view unit = {};       ///< of a bare number; its dimension is that of every unit it may carry
  std::string_view real_unit = {};  ///< of a bare number under `units real`, where it differs
  Check check = {"", nullptr};
  std::string_view meaning;
  bool mandatory = false;
  std::string_view or_else = {};     ///< exactly one of this directive and that one must be given
  std::string_view instead_of = {};  ///< as an override it takes the place of this directive, too
  std::string_view absent = {};      ///< what holds without it, where Parameters cannot say
  std::string_view example =
      {};  ///< stands in the template; without it the template shows the default as a comment
  std::string_view synonyms = {};  ///< further spellings, separated by ", "
  std::string_view heading = {};   ///< opens a group of rows
  bool since_1_21 = false;         ///< a word of JETSPIN that versions before 1.21 do not know
};

inline constexpr std::string_view last_directive = "finish";

std::span<const Directive> directives();

/// The row with these words; std::logic_error if there is none.
const Directive& directive(std::string_view words);

/// The unit a number without one is in.
std::string_view bare_unit(const Directive& directive, Units units);

/// Sets the member, in the unit of a bare number. Parameters::units must be set before. Returns what is wrong
/// with the arguments ("expected ..., found ..."), empty if nothing is.
std::string assign(const Directive& directive, std::span<const std::string> arguments,
                   Parameters& parameters);

/// What the directive takes: "real", "integer", "yes|no", ...
std::string argument(const Directive& directive);

/// One line for each directive with different values: "final time: 0.1 here, 0.2 there".
std::vector<std::string> differences(const Parameters& here, const Parameters& there);

/// The member's value as a deck spells it, empty if it has none.
std::string value_text(const Directive& directive, const Parameters& parameters);

}  // namespace treejet

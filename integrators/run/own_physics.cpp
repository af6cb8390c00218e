#include "integrators/run/own_physics.hpp"

#include <fmt/format.h>

#include "core/base/error.hpp"
#include "core/deck/observable_keys.hpp"
#include "core/io/frame.hpp"

namespace treejet {

namespace {

void expect_name(const std::string& name, bool taken) {
  if (!is_column_name(name) || taken)
    throw InputError(
        fmt::format("`{}` cannot name a column or an observable of one's own: expected small letters, "
                    "digits and _, and no name that is taken",
                    name));
}

bool is_taken(const std::string& column) {
  for (const FrameColumn& c : frame_columns())
    if (c.name == column) return true;
  return column == "id";
}

}  // namespace

template <>
OwnTerms<3> own_terms<3>(const OwnPhysics& own, const Parameters& p) {
  OwnTerms<3> terms = own.terms(p);
  for (const auto& rate : terms.columns) expect_name(rate->column().name, is_taken(rate->column().name));
  return terms;
}

template <>
OwnTerms<1> own_terms<1>(const OwnPhysics& own, const Parameters&) {
  if (!own.name.empty())
    throw InputError(fmt::format("{} is written for three dimensions: system 3", own.name));
  return {};
}

template <>
OwnObservables<3> own_observables<3>(const OwnPhysics& own) {
  for (const auto& o : own.observables) expect_name(o.key, observable_key(o.key) != nullptr);
  return own.observables;
}

template <>
OwnObservables<1> own_observables<1>(const OwnPhysics&) {
  return {};
}

}  // namespace treejet

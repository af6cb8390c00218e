#pragma once
/// The words of a deck's choices: one table for each type of value that is named, not written in digits.
///
/// The first word of a value is the one it is printed with.

#include <algorithm>
#include <array>
#include <cstddef>
#include <string_view>

#include "core/jet/parameters.hpp"
#include "core/jet/schemes.hpp"

namespace treejet {

template <class T>
struct Word {
  std::string_view word;
  T value;
};

template <class T>
inline constexpr std::nullptr_t choices = nullptr;

template <>
inline constexpr Word<bool> choices<bool>[] = {{"yes", true}, {"no", false}};
template <>
inline constexpr Word<EventRule> choices<EventRule>[] = {{"located", EventRule::located},
                                                         {"step", EventRule::step}};
template <>
inline constexpr Word<Multirate> choices<Multirate>[] = {{"auto", Multirate::automatic},
                                                         {"no", Multirate::no}};
template <>
inline constexpr Word<Units> choices<Units>[] = {{"cgs", Units::cgs}, {"real", Units::real}};
template <>
inline constexpr Word<CoulombSum> choices<CoulombSum>[] = {
    {"direct", CoulombSum::direct}, {"tree", CoulombSum::tree}, {"auto", CoulombSum::automatic}};
template <>
inline constexpr Word<TreeOrder> choices<TreeOrder>[] = {
    {"auto", TreeOrder::automatic}, {"chain", TreeOrder::chain}, {"space", TreeOrder::space}};
template <>
inline constexpr Word<ExpansionKind> choices<ExpansionKind>[] = {{"local", ExpansionKind::local},
                                                                 {"none", ExpansionKind::none}};
template <>
inline constexpr Word<ParallelData> choices<ParallelData>[] = {{"replicated", ParallelData::replicated},
                                                               {"distributed", ParallelData::distributed},
                                                               {"auto", ParallelData::automatic}};
template <>
inline constexpr Word<SelfField> choices<SelfField>[] = {{"point", SelfField::point},
                                                         {"slender", SelfField::slender}};
template <>
inline constexpr Word<CoulombLaw> choices<CoulombLaw>[] = {{"point", CoulombLaw::point},
                                                           {"softened", CoulombLaw::softened}};
template <>
inline constexpr Word<DragModel> choices<DragModel>[] = {
    {"jetspin", DragModel::jetspin}, {"jetspin-1.20", DragModel::jetspin_1_20}, {"full", DragModel::full}};
template <>
inline constexpr Word<StressLawKind> choices<StressLawKind>[] = {
    {"maxwell", StressLawKind::maxwell},
    {"kelvin-voigt", StressLawKind::kelvin_voigt},
    {"oldroyd-b", StressLawKind::oldroyd_b},
    {"giesekus", StressLawKind::giesekus},
    {"fene-p", StressLawKind::fene_p},
    {"power-law", StressLawKind::power_law},
    {"herschel-bulkley", StressLawKind::herschel_bulkley}};
template <>
inline constexpr Word<EvaporationModel> choices<EvaporationModel>[] = {
    {"vapour", EvaporationModel::vapour}, {"jetspin", EvaporationModel::jetspin}};
template <>
inline constexpr Word<SolventName> choices<SolventName>[] = {{"water", SolventName::water},
                                                             {"ethanol", SolventName::ethanol},
                                                             {"dmf", SolventName::dmf},
                                                             {"chloroform", SolventName::chloroform},
                                                             {"acetone", SolventName::acetone}};
template <>
inline constexpr Word<Feed> choices<Feed>[] = {{"pull", Feed::pull}, {"flow", Feed::flow}};
template <>
inline constexpr Word<Model> choices<Model>[] = {{"paper", Model::paper}, {"slender", Model::slender}};
/// JETSPIN's numbers behind its four.
template <>
inline constexpr Word<Wave> choices<Wave>[] = {{"constant", Wave::constant}, {"sine", Wave::sine},
                                               {"square", Wave::square},     {"rc", Wave::rc},
                                               {"restart", Wave::restart},   {"ramp", Wave::ramp},
                                               {"table", Wave::table},       {"rotating", Wave::rotating},
                                               {"0", Wave::constant},        {"1", Wave::square},
                                               {"2", Wave::restart},         {"3", Wave::rotating}};
template <>
inline constexpr Word<SurfaceModel> choices<SurfaceModel>[] = {{"paper", SurfaceModel::paper},
                                                               {"energy", SurfaceModel::energy}};

/// Those of the table of schemes, JETSPIN's numbers behind them.
template <>
inline constexpr auto choices<Scheme> = [] {
  constexpr auto numbered = [](const SchemeProperties& s) { return !s.number.empty(); };
  std::array<Word<Scheme>, schemes.size() + std::ranges::count_if(schemes, numbered)> words;
  auto* next = words.data();
  for (const auto& s : schemes) *next++ = {s.word, s.scheme};
  for (const auto& s : schemes)
    if (numbered(s)) *next++ = {s.number, s.scheme};
  return words;
}();

}  // namespace treejet

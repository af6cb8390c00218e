#include "core/deck/lab_sheet.hpp"

#include <fmt/format.h>

#include <cmath>
#include <numbers>

#include "core/deck/directives.hpp"
#include "core/deck/units.hpp"
#include "core/jet/scales.hpp"

namespace treejet {

namespace {

using std::numbers::pi;

double in(double number, std::string_view from, std::string_view to) {
  return converted(number, unit(from).value(), unit(to).value());
}

/// Onset of the corona at a wire of radius a in cm, kV/cm.
double peek_field(double a) {
  return 30 * (1 + 0.301 / std::sqrt(a));
}

class Sheet {
 public:
  Sheet(const Parameters& p, const std::optional<Draw>& draw) : p_(p), draw_(draw) {
    const Scales s = scales(p);
    a_ = p.nozzle_cross;
    element_ = s.l_step;
    section_ = pi * a_ * a_;
    charge_density_ = s.charge / (section_ * s.l_step);
    relaxation_ = s.time;
  }

  std::vector<SheetRow> rows() {
    setting();
    flow();
    sizes();
    numbers();
    surface_charge();
    return std::move(rows_);
  }

 private:
  void setting() {
    const std::string_view potential = bare_unit(directive("external potential"), p_.units);
    const double kilovolts = in(p_.external_potential, potential, "kV");
    add({"potential", "potential", kilovolts, "kV"});
    add({"field", "mean field", kilovolts / p_.collector_distance, "kV/cm"});
  }

  void flow() {
    const bool pumped = p_.feed == Feed::flow;
    const double supplied = section_ * inlet_velocity(p_);
    add({"flow_supplied", "flow supplied", in(supplied, "cm3/s", "mL/h"), "mL/h",
         pumped ? "by flow rate" : "by the nozzle's velocity"});
    add({"current_supplied", "current supplied", nanoamperes(supplied), "nA",
         pumped ? "with the fluid, whose charge is given" : ""});
    if (pumped) add({"nozzle_velocity", "velocity at nozzle", inlet_velocity(p_), "cm/s", "from that"});
    if (!draw_ || draw_->flow == 0) return;
    const double drawn = draw_->flow;
    const bool absurd = supplied > 0 && drawn > most_draw * supplied;
    add({"flow_drawn", "flow drawn", in(drawn, "cm3/s", "mL/h"), "mL/h",
         "by the jet, as a trial run inserts beads",
         absurd ? fmt::format("{:.3g} times what is supplied: no pump feeds this jet", drawn / supplied)
                : ""});
    add({"current_drawn", "current drawn", nanoamperes(drawn), "nA"});
  }

  void sizes() {
    add({"relaxation_time", "relaxation time", in(relaxation_, "s", "ms"), "ms",
         "viscosity / elastic modulus"});
    add({"element", "element", in(element_, "cm", "um"), "um", "length at the start"});
    add({"nozzle_radius", "radius at nozzle", in(a_, "cm", "um"), "um"});
    if (!draw_ || draw_->speed <= 0) return;
    if (draw_->flow > 0)
      add({"front_radius", "radius at front", in(std::sqrt(draw_->flow / (pi * draw_->speed)), "cm", "um"),
           "um", "where the trial run ended, from the flow drawn and the speed"});
    add({"front_speed", "speed at front", in(draw_->speed, "cm/s", "m/s"), "m/s", "where the trial run ended",
         draw_->speed > speed_of_sound ? "faster than sound in air" : ""});
  }

  void numbers() {
    const double v = inlet_velocity(p_), alpha = p_.surface_tension;
    add({"deborah", "Deborah number", relaxation_ * v / a_, "",
         "relaxation time over the time to flow one radius: above 1 the fluid leaves the nozzle elastic"});
    if (alpha > 0)
      add({"capillary", "capillary number", p_.viscosity * v / alpha, "",
           "viscous stress over capillary pressure at the nozzle: below 1 surface tension rules there"});
    const double number = line_charge() * line_charge() / (section_ * p_.elastic_modulus);
    constexpr double most_for_tubes = 0.5;
    add({"electrostatic", "electrostatic number", number, "",
         "repulsion along the jet, lambda^2/(pi a^2), over the elastic modulus: above 1 charge stretches "
         "it",
         p_.self_field == SelfField::slender && number > most_for_tubes
             ? "above 1/2 the speed near the nozzle depends on the elements: docs/accuracy.md, The edge"
             : ""});
  }

  void surface_charge() {
    const double lambda = line_charge();
    if (p_.surface_tension > 0)
      add({"bending", "lambda^2/(pi a alpha)", lambda * lambda / (pi * a_ * p_.surface_tension), "",
           "repulsion over surface tension in a bend: above 1, but for a logarithm of the wave length, bends "
           "grow"});
    const double surface = 2 * std::abs(lambda) / a_ * kilovolt_per_statvolt;
    const double onset = peek_field(a_);
    add({"surface_field", "surface field", surface, "kV/cm", "2 lambda/a at the nozzle's radius",
         surface > onset ? "above the corona's onset: air takes such a charge from a jet" : ""});
    add({"corona_onset", "corona onset", onset, "kV/cm",
         "Peek's 30 kV/cm (1 + 0.301/sqrt(a/cm)) at that radius"});
  }

  double nanoamperes(double volume_a_second) const {
    return in(charge_density_ * volume_a_second, "statC/s", "nA");
  }
  double line_charge() const { return charge_density_ * section_; }
  void add(SheetRow row) { rows_.push_back(std::move(row)); }

  static constexpr double kilovolt_per_statvolt = volt_per_statvolt / 1000;
  const Parameters& p_;
  const std::optional<Draw>& draw_;
  double a_, element_, section_, charge_density_, relaxation_;
  std::vector<SheetRow> rows_;
};

}  // namespace

std::vector<SheetRow> lab_sheet(const Parameters& parameters, const std::optional<Draw>& draw) {
  return Sheet(parameters, draw).rows();
}

std::string lab_sheet_text(const std::vector<SheetRow>& rows) {
  std::string text = "in the laboratory\n";
  for (const SheetRow& row : rows) {
    std::string line = fmt::format("  {:<22} {:>10.4g} {:<6}", row.name, row.value, row.unit);
    if (!row.meaning.empty()) line += "  " + row.meaning;
    if (!row.warning.empty()) line += fmt::format("{} {}", row.meaning.empty() ? " ! " : " !", row.warning);
    line.erase(line.find_last_not_of(' ') + 1);
    text += line + "\n";
  }
  return text;
}

}  // namespace treejet

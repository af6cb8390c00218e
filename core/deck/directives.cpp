#include "core/deck/directives.hpp"
#include "core/base/tree_parameters.hpp"

#include <fmt/format.h>

#include <stdexcept>

#include "core/jet/schemes.hpp"

namespace treejet {

namespace {

using P = Parameters;

constexpr Check positive{"positive", [](double v) { return v > 0; }};
constexpr Check not_negative{"zero or positive", [](double v) { return v >= 0; }};
constexpr Check below_one{"positive and below 1", [](double v) { return v > 0 && v < 1; }};
constexpr Check a_system{"1 (straight jet), 3 (three dimensions) or 4 (the same in air)",
                         [](double v) { return v == 1 || v == 3 || v == 4; }};
constexpr Check up_to_one{"positive and at most 1", [](double v) { return v > 0 && v <= 1; }};
constexpr Check up_to_one_or_zero{"from 0 to 1", [](double v) { return v >= 0 && v <= 1; }};
constexpr Check a_temperature{"from 223.15 to 373.15", [](double v) { return v >= 223.15 && v <= 373.15; }};
constexpr Check a_count{"from 1 to 100000000", [](double v) { return v >= 1 && v <= 1e8; }};
constexpr Check a_factor{"from 1e-100 to 1e100", [](double v) { return v >= 1e-100 && v <= 1e100; }};
constexpr Check an_order{tree_parameters::orders, tree_parameters::is_order};
constexpr Check an_opening{tree_parameters::openings, tree_parameters::is_opening};
constexpr Check a_leaf{tree_parameters::leaf_sizes, tree_parameters::is_leaf};

const std::string integrators =
    fmt::format("{} with timestep; {} with tolerance; auto takes kencarp5 for stiff scenes",
                scheme_words(false, "or", /*numbers*/ true), scheme_words(true, "or"));

// clang-format off
const Directive table[] = {
    {.words = "system", .member = &P::system, .check = a_system,
     .meaning = "model of the jet: 1 straight along x, 3 in three dimensions, 4 for 3 with airdrag yes",
     .mandatory = true, .example = "3", .synonyms = "systype", .heading = "Model"},
    {.words = "model", .member = &P::model,
     .meaning = "paper, but for what other lines say, or slender: self field slender, feed flow and surface tension "
                "model energy in one line; needs flow rate"},
    {.words = "units", .member = &P::units,
     .meaning = "cgs, or real: a bare density charge is in C/L, a bare external potential in V, all else in CGS"},
    {.words = "seed", .member = &P::seed, .meaning = "of the random numbers, where anything is random"},

    {.words = "final time", .member = &P::final_time, .unit = "s", .check = positive,
     .meaning = "end of the simulation", .mandatory = true, .example = "5.d-2", .heading = "Time"},
    {.words = "tolerance", .member = &P::tolerance, .check = below_one,
     .meaning = "local error a step may make, scaled; the program chooses the step",
     .or_else = "timestep", .example = "1.d-6"},
    {.words = "timestep", .member = &P::timestep, .unit = "s", .check = positive,
     .meaning = "fixed time step", .or_else = "tolerance"},
    {.words = "integrator", .member = &P::integrator,
     .meaning = integrators,
     .absent = "auto; mandatory with timestep"},
    {.words = "events", .member = &P::events,
     .meaning = "insertion and removal at their exact time (located) or at the end of a step, as JETSPIN does (step)"},
    {.words = "multirate", .member = &P::multirate,
     .meaning = "auto: slow forces are evaluated less often than fast ones; no: all at each stage"},

    {.words = "initial length", .member = &P::initial_length, .unit = "cm", .check = positive,
     .meaning = "length of the jet at the start", .mandatory = true, .example = "0.02", .heading = "Jet"},
    {.words = "points", .member = &P::points, .check = a_count,
     .meaning = "number of elements of the initial jet", .or_else = "resolution", .example = "1"},
    {.words = "resolution", .member = &P::resolution, .unit = "cm", .check = positive,
     .meaning = "length of an element; must divide initial length", .or_else = "points"},
    {.words = "density mass", .member = &P::density_mass, .unit = "g/cm^3", .check = positive,
     .meaning = "mass density", .mandatory = true, .example = "0.84"},
    {.words = "density charge", .member = &P::density_charge, .unit = "statC/cm^3", .real_unit = "C/L",
     .meaning = "charge density, of either sign", .mandatory = true, .example = "44000."},
    {.words = "viscosity", .member = &P::viscosity, .unit = "g/(cm s)", .check = positive,
     .meaning = "viscosity", .mandatory = true, .example = "20."},
    {.words = "elastic modulus", .member = &P::elastic_modulus, .unit = "g/(cm s^2)", .check = positive,
     .meaning = "elastic modulus; viscosity / elastic modulus is the relaxation time", .mandatory = true,
     .example = "50000."},
    {.words = "surface tension", .member = &P::surface_tension, .unit = "g/s^2", .check = not_negative,
     .meaning = "surface tension; that of the paper has no effect in system 1", .example = "21.13"},
    {.words = "surface tension model", .member = &P::surface_model,
     .meaning = "the paper's force on bends, too weak by element length over radius (paper), or the tension that "
                "follows from the energy of the surface (energy)"},
    {.words = "stress law", .member = &P::stress_law,
     .meaning = "how stress follows strain: Maxwell's equation as in the paper, to which yield stress and hbfluid add as in "
                "JETSPIN; kelvin-voigt; oldroyd-b (upper-convected Maxwell without solvent viscosity), giesekus and fene-p for "
                "polymers that harden; power-law; herschel-bulkley, rigid but for its elasticity below the yield stress. "
                "viscosity and elastic modulus are those of extension in all, three times those of shear",
     .heading = "Fluid"},
    {.words = "stress law mobility", .member = &P::mobility, .check = up_to_one,
     .meaning = "mobility factor of Giesekus' law", .absent = "mandatory with stress law giesekus"},
    {.words = "stress law extensibility", .member = &P::extensibility, .check = {"above 1.8", [](double v) { return v > 1.8; }},
     .meaning = "greatest length of FENE-P's dumbbells, L, in units of a coil at rest whose length squared is 3",
     .absent = "mandatory with stress law fene-p"},
    {.words = "solvent viscosity", .member = &P::solvent_viscosity, .unit = "g/(cm s)", .check = not_negative,
     .meaning = "elongational viscosity of the solvent, whose stress adds to that of the stress law"},
    {.words = "kvfluid", .member = &P::kvfluid,
     .meaning = "JETSPIN's words for stress law kelvin-voigt", .since_1_21 = true},
    {.words = "yield stress", .member = &P::yield_stress, .unit = "g/(cm s^2)", .check = not_negative,
     .meaning = "yield stress; in Maxwell's equation it adds to the viscous stress, without hbfluid yes, too"},
    {.words = "hbfluid", .member = &P::hbfluid,
     .meaning = "Herschel-Bulkley fluid of JETSPIN: needs consistency and index"},
    {.words = "hbfluid consistency", .member = &P::hb_consistency, .check = positive,
     .meaning = "consistency of a Herschel-Bulkley or power-law fluid, in units of the viscosity, strain rates in 1/s"},
    {.words = "hbfluid index", .member = &P::hb_index, .check = positive,
     .meaning = "its flow index"},
    {.words = "small strain rate", .member = &P::small_strain_rate, .unit = "1/s", .check = positive,
     .meaning = "strain rate over which the sign of a strain rate is rounded, in hbfluid, yield stress and stress law power-law; "
                "elements that come to rest take steps as its root",
     .absent = "a tenth of elastic modulus / viscosity"},

    {.words = "evaporation", .member = &P::evaporation,
     .meaning = "the solvent leaves the jet, which thickens: needs polymer frac", .heading = "Evaporation", .since_1_21 = true},
    {.words = "evaporation model", .member = &P::evaporation_model,
     .meaning = "JETSPIN's law, 1330 times too fast for water (jetspin), or the vapour that air can hold (vapour)"},
    {.words = "evaporation polymer frac", .member = &P::polymer_fraction, .check = below_one,
     .meaning = "polymer in the fluid at the nozzle, by volume", .absent = "mandatory with evaporation yes",
     .synonyms = "evaporation polymer fraction", .since_1_21 = true},
    {.words = "evaporation solvent", .member = &P::solvent,
     .meaning = "solvent, with model vapour; others than water need their diffusivity"},
    {.words = "evaporation temperature", .member = &P::temperature, .check = a_temperature,
     .meaning = "temperature of air and jet in K", .since_1_21 = true},
    {.words = "evaporation humidity", .member = &P::humidity, .check = up_to_one_or_zero,
     .meaning = "relative humidity of the air, of water", .synonyms = "evaporation umidity, evaporation relumidity", .since_1_21 = true},
    {.words = "evaporation diffusivity", .member = &P::vapour_diffusivity, .unit = "cm^2/s", .check = positive,
     .meaning = "diffusivity of the vapour in air", .absent = "that of water: 0.242 at 293.15 K", .since_1_21 = true},
    {.words = "evaporation airviscosity", .member = &P::drying_air_viscosity, .unit = "cm^2/s", .check = positive,
     .meaning = "kinematic viscosity of air", .since_1_21 = true},
    {.words = "evaporation vapour density", .member = &P::vapour_density, .unit = "g/cm^3", .check = positive,
     .meaning = "density of the saturated vapour, of any solvent", .absent = "from the solvent's vapour pressure"},
    {.words = "evaporation chi", .member = &P::flory_chi, .check = not_negative,
     .meaning = "Flory and Huggins' parameter of polymer and solvent, with model vapour"},
    {.words = "evaporation bconstant", .member = &P::viscosity_b, .check = not_negative,
     .meaning = "B of the viscosity, mu_0 10^(B (c^m - c_0^m)), c the concentration of polymer", .since_1_21 = true},
    {.words = "evaporation mconstant", .member = &P::viscosity_m, .check = positive,
     .meaning = "m of the viscosity", .since_1_21 = true},
    {.words = "evaporation tconstant", .member = &P::relaxation_t,
     .meaning = "t of the relaxation time, theta_0 (c / c_0)^t", .since_1_21 = true},

    {.words = "nozzle cross", .member = &P::nozzle_cross, .unit = "cm", .check = positive,
     .meaning = "radius of the jet at the nozzle", .mandatory = true, .example = "5.d-3",
     .synonyms = "nozzle cross section", .heading = "Nozzle, collector and field"},
    {.words = "nozzle velocity", .member = &P::nozzle_velocity, .unit = "cm/s", .check = not_negative,
     .meaning = "velocity of the fluid at the nozzle", .example = "0.2829"},
    {.words = "nozzle stress", .member = &P::nozzle_stress, .unit = "g/(cm s^2)",
     .meaning = "stress of the initial jet"},
    {.words = "perturb", .member = &P::perturb,
     .meaning = "the nozzle circles around the axis (system 3): needs freq and ampl", .example = "yes",
     .synonyms = "perturbation"},
    {.words = "perturb freq", .member = &P::perturb_frequency, .unit = "rad/s", .check = not_negative,
     .meaning = "its angular frequency", .example = "1.d+4",
     .synonyms = "perturb frequency, perturbation freq, perturbation frequency"},
    {.words = "perturb ampl", .member = &P::perturb_amplitude, .unit = "cm", .check = not_negative,
     .meaning = "its radius", .example = "1.d-3",
     .synonyms = "perturb amplitude, perturbation ampl, perturbation amplitude"},
    {.words = "inserting", .member = &P::inserting, .meaning = "the nozzle releases new beads", .example = "yes"},
    {.words = "feed", .member = &P::feed,
     .meaning = "the jet draws from the nozzle what it pulls, the paper's rule (pull), or is given flow rate (flow)"},
    {.words = "flow rate", .member = &P::flow_rate, .unit = "cm^3/s", .check = positive,
     .meaning = "volume a time, with feed flow; the velocity at the nozzle follows from it and nozzle cross",
     .instead_of = "nozzle velocity", .absent = "none"},
    {.words = "dragvel", .member = &P::dragvel,
     .meaning = "a bead is released with half the velocity of the one before it (the paper's dragging velocity) or, as JETSPIN from "
                "1.21 on means without this line, with nozzle velocity alone",
     .since_1_21 = true},
    {.words = "removing", .member = &P::removing, .meaning = "the collector takes beads away", .example = "yes"},
    {.words = "collector distance", .member = &P::collector_distance, .unit = "cm", .check = positive,
     .meaning = "distance of the collector from the nozzle", .mandatory = true, .example = "16."},
    {.words = "external potential", .member = &P::external_potential, .unit = "statV", .real_unit = "V",
     .meaning = "potential between nozzle and collector, of the sign of the charge where it pulls", .example = "30.02"},
    {.words = "field wave", .member = &P::field_wave,
     .meaning = "factor on the potential in time: sine of 2 pi f t + phase; on while that is positive (square), behind a resistor "
                "and a capacitor (rc), or as JETSPIN has that (restart); a ramp or a table; or a field that rotates",
     .synonyms = "external potential type"},
    {.words = "field frequency", .member = &P::field_frequency, .unit = "Hz", .check = positive,
     .meaning = "f of sine, square, rc, restart and rotating", .absent = "mandatory with these",
     .synonyms = "field freq, external potential freq, external potential frequency"},
    {.words = "field phase", .member = &P::field_phase, .unit = "rad", .meaning = "their phase",
     .synonyms = "external potential phase"},
    {.words = "field time", .member = &P::field_time, .unit = "s", .check = positive,
     .meaning = "resistance times capacitance, or the length of the ramp", .absent = "mandatory with rc, restart and ramp",
     .synonyms = "external potential time"},
    {.words = "field table", .member = &P::field_table,
     .meaning = "times in s and factors in turn, straight between them", .absent = "mandatory with table"},
    {.words = "field vector", .member = &P::field_vector,
     .meaning = "x, y and z of a field as potentials over collector distance, instead of external potential (system 3)",
     .absent = "along x; mandatory with rotating", .synonyms = "external potential vector"},
    {.words = "field needle", .member = &P::field_needle, .unit = "cm", .check = positive,
     .meaning = "radius of a needle's tip at the nozzle: the field of needle and plate instead of a uniform one",
     .absent = "a uniform field"},
    {.words = "field map", .member = &P::field_map,
     .meaning = "file with the potential on a grid (HDF5, VTK image data; m and V, nozzle at the origin): its field instead of that of "
                "external potential",
     .absent = "none"},
    {.words = "magnetic field", .member = &P::magnetic_field,
     .meaning = "x, y and z of a uniform, constant magnetic field in gauss, with units real in tesla (system 3)", .absent = "none"},
    {.words = "gravity", .member = &P::gravity, .meaning = "gravity along x", .example = "yes"},
    {.words = "cutoff", .member = &P::cutoff, .unit = "cm", .check = positive,
     .meaning = "reach of the Coulomb force along the jet, measured at the nozzle", .absent = "the full sum"},

    {.words = "bending", .member = &P::bending,
     .meaning = "the thread resists bending, by Maxwell's stresses across its section (system 3): stiffness elastic modulus times "
                "pi a^4 / 4"},
    {.words = "self field", .member = &P::self_field,
     .meaning = "field of an element on itself: none, beads are point charges (point), or that of a thin charged tube "
                "(slender), with which the force on a bend does not depend on the length of the elements"},

    {.words = "airdrag", .member = &P::airdrag, .meaning = "drag of the air", .heading = "Air and noise"},
    {.words = "airdrag airdensity", .member = &P::air_density, .unit = "g/cm^3", .check = positive,
     .meaning = "density of the air; the default is that at 20 C"},
    {.words = "airdrag airviscosity", .member = &P::air_viscosity, .unit = "cm^2/s", .check = positive,
     .meaning = "its kinematic viscosity"},
    {.words = "airdrag airvelocity", .member = &P::air_velocity, .unit = "cm/s",
     .meaning = "its velocity along x, below zero towards the nozzle"},
    {.words = "airdrag model", .member = &P::drag_model,
     .meaning = "drag along the jet and lift, as JETSPIN has them (jetspin) or as its version 1.20 computed them (jetspin-1.20: drag "
                "always to the nozzle, 1 cm for the length of an element in the lift), or drag along and across it (full)"},
    {.words = "airdrag lift", .member = &P::airdrag_lift,
     .meaning = "lift of the air on bends, which drives them farther out", .absent = "no with model full, yes with the others"},
    {.words = "airdrag amplitude", .member = &P::airdrag_amplitude, .check = not_negative,
     .meaning = "of a random force, JETSPIN's"},
    {.words = "noise", .member = &P::noise,
     .meaning = "each bead's velocity diffuses: needs diffusivity"},
    {.words = "noise diffusivity", .member = &P::noise_diffusivity, .unit = "cm^2/s^3", .check = not_negative,
     .meaning = "half the growth of a component's variance in time", .absent = "mandatory with noise yes"},
    {.words = "noise variance", .member = &P::noise_variance, .unit = "cm^2/s^2", .check = positive,
     .meaning = "that a component comes to by the friction diffusivity / variance", .absent = "no friction"},
    {.words = "noise interval", .member = &P::noise_interval, .unit = "s", .check = positive,
     .meaning = "for which a random force is constant; integrator sra1 has white noise",
     .absent = "a 20th of the relaxation time, or of the time between two beads if that is shorter"},
    {.words = "dynamic refinement", .member = &P::refinement,
     .meaning = "elements are split where the jet needs more beads, and merged where it needs less",
     .synonyms = "dynam refinement, dynam refin", .heading = "Beads where the jet needs them"},
    {.words = "dynamic refinement tolerance", .member = &P::refinement_tolerance, .check = below_one,
     .meaning = "relative error of an arc that is drawn by an element: the jet turns by at most sqrt(24 times "
                "this) an element",
     .absent = "the threshold alone"},
    {.words = "dynamic refinement threshold", .member = &P::refinement_threshold, .unit = "cm", .check = positive,
     .meaning = "longest element", .absent = "the tolerance alone"},
    {.words = "dynamic refinement every", .member = &P::refinement_every, .unit = "s", .check = positive,
     .meaning = "interval at which to look", .absent = "whenever a bead is released; mandatory without inserting"},
    {.words = "dynamic refinement start", .member = &P::refinement_start, .unit = "s", .check = not_negative,
     .meaning = "time from which on to look"},

    {.words = "coulomb", .member = &P::coulomb,
     .meaning = "Coulomb sum: direct over all pairs; by a tree to the accuracy below; auto: whichever is faster",
     .heading = "Coulomb sum"},
    {.words = "coulomb law", .member = &P::coulomb_law,
     .meaning = "force between two charges: 1/R^2 (point), or 1/(R + a)^2 with the radius a of the one nearer the nozzle, as in JETSPIN "
                "from 1.21 on (softened)"},
    {.words = "coulomb accuracy", .member = &P::coulomb_accuracy, .check = below_one,
     .meaning = "relative L2 error of the field that the tree may make; it is measured and kept"},
    {.words = "coulomb order", .member = &P::coulomb_order, .check = an_order,
     .meaning = "order of the expansions", .absent = "chosen by the program"},
    {.words = "coulomb opening", .member = &P::coulomb_opening, .check = an_opening,
     .meaning = "opening of the tree, cell radii over distance, alike for all cells", .absent = "chosen by the program"},
    {.words = "coulomb leaf", .member = &P::coulomb_leaf, .check = a_leaf,
     .meaning = "beads in a leaf", .absent = "chosen by the program"},
    {.words = "coulomb tree", .member = &P::coulomb_tree,
     .meaning = "order of the beads in the tree: along the chain, or in space"},
    {.words = "coulomb expansions", .member = &P::coulomb_expansions,
     .meaning = "local: dual tree with local expansions; none: Barnes and Hut's, cells on beads"},

    {.words = "parallel", .member = &P::parallel,
     .meaning = "what ranks hold: all of the jet each (replicated), or a subdomain each (distributed: needs system 3, "
                "coulomb tree or auto); auto: a subdomain where that can be and a rank has beads enough",
     .heading = "Ranks"},

    {.words = "print time", .member = &P::print_time, .unit = "s", .check = positive,
     .meaning = "interval of the tables", .absent = "1000 timesteps; a hundredth of final time with tolerance",
     .example = "1.d-2", .heading = "Output"},
    {.words = "print list", .member = &P::print_list,
     .meaning = "keys of the table on the terminal", .absent = "no table", .example = "t x vn vc yz n curn curc"},
    {.words = "printstat list", .member = &P::printstat_list,
     .meaning = "keys of the table in the statistics file", .absent = "no file", .example = "t x vn vc yz n rc lp"},
    {.words = "print xyz", .member = &P::print_xyz, .unit = "s", .check = positive,
     .meaning = "interval of the frames of the XYZ trajectory", .absent = "no file"},
    {.words = "print xyz maxnum", .member = &P::xyz_maxnum, .check = a_count,
     .meaning = "beads in a frame, from the collector on", .synonyms = "print xyz maxnumber"},
    {.words = "print xyz rescale", .member = &P::xyz_rescale, .check = a_factor,
     .meaning = "factor on the coordinates, which are in cm", .synonyms = "print xyz rescalexyz"},
    {.words = "print hdf5", .member = &P::print_hdf5, .unit = "s", .check = positive,
     .meaning = "interval of the frames of the HDF5 trajectory (H5MD), for all tools that read HDF5 and for ParaView",
     .absent = "no file"},
    {.words = "checkpoint", .member = &P::checkpoint, .unit = "s", .check = positive,
     .meaning = "wall-clock time between checkpoints, from which `treejet run --resume` continues",
     .absent = "one when a signal or --walltime stops the run, and one at the end"},
};
// clang-format on

}  // namespace

std::span<const Directive> directives() {
  return table;
}

std::string_view bare_unit(const Directive& d, Units units) {
  return units == Units::real && !d.real_unit.empty() ? d.real_unit : d.unit;
}

const Directive& directive(std::string_view words) {
  for (const Directive& d : table)
    if (d.words == words) return d;
  throw std::logic_error("no directive " + std::string(words));
}

}  // namespace treejet

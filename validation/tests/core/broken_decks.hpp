#pragma once
/// A sound deck and the ways to break it: one line replaced (or added, or left out), the line that is blamed,
/// and the essential words of the one message it must get.

#include <string>
#include <vector>

namespace treejet {

inline const std::string sound_deck = R"(# A PVP jet, for the tests of the deck
system 3
integrator 2
timestep 1.d-8
final time 0.5
print time 1.d-2
print list t x n
inserting yes
removing yes
points 1
initial length 0.02
nozzle cross 5.d-3
density mass 0.84
density charge 44000.
viscosity 20.
elastic modulus 50000.
collector distance 16.
external potential 30.02
surface tension 21.13
finish
)";

struct Broken {
  std::string was;  ///< line of the sound deck; empty: `is` is added before finish
  std::string is;   ///< what stands there instead; empty: the line is left out
  std::vector<std::string> says;
  std::string blamed = {};  ///< the line the message names if it is not `is`; "deck" if no line is named
};

// clang-format off
inline const std::vector<Broken> broken_decks = {
    // words
    {"viscosity 20.", "viscosty 20.", {"'viscosty 20.'", "unknown directive", "did you mean viscosity?"}},
    {"", "ultimate strength 5", {"jets do not break"}},
    {"", "ultimately 5", {"'ultimately'", "unknown directive", "treejet template"}},
    {"viscosity 20.", "visc 20.", {"'visc 20.'", "did you mean viscosity?"}},
    {"viscosity 20.", "eta 20.", {"'eta'", "unknown directive", "viscosity: missing"}},
    {"viscosity 20.", "viscosity20. 20.", {"did you mean viscosity?"}},
    {"viscosity 20.", "viscosity = 20.", {"'viscosity = 20.'", "expected blanks, not ="}},
    {"viscosity 20.", "viscosity=20.", {"'viscosity=20.'", "expected blanks, not ="}},
    {"collector distance 16.", "colector distence 16.", {"did you mean collector distance?"}},
    {"collector distance 16.", "collectordistance 16.", {"did you mean collector distance?"}},
    {"collector distance 16.", "collector_distance 16.", {"did you mean collector distance?"}},
    {"final time 0.5", "final tiem 0.5", {"did you mean final time?"}},
    {"", "density 5", {"density: expected density mass, or density charge"}},
    {"", "print 5", {"expected print time, or print list, or print xyz"}},
    {"", "nozle velocity 1.", {"did you mean nozzle velocity?"}},
    {"", "nozzle velocty 1.", {"did you mean nozzle velocity?"}},
    {"", "banana 3", {"'banana'", "unknown directive", "treejet template"}},
    {"", "\xc2\xa0gravity yes", {"'\\xc2\\xa0gravity yes'", "did you mean gravity?"}},
    {"", "grav yes", {"'grav yes'", "unknown directive; did you mean gravity?"}},
    {"external potential 30.02", "ext pot 30.02", {"did you mean external potential?"}},
    {"surface tension 21.13", "surfacetension 21.13", {"did you mean surface tension?"}},
    {"", "perturbing yes", {"did you mean perturb?"}},
    {"", "perturbation frequncy 1.d4", {"unknown directive", "'perturbation frequncy 1.d4'", "did you mean perturbation frequency?"}},
    {"", "print xyz maxnumb 400", {"unknown directive", "'print xyz maxnumb 400'", "did you mean print xyz maxnum?"}},
    {"finish", "finsh", {"'finsh'", "did you mean finish?"}},
    {"finish", "", {"finish: missing"}, "deck"},
    {"finish", "finish now", {"finish: expected nothing after it", "'now'"}},
    {"finish", "finish\ngravity yes", {"finish: expected nothing after it", "'gravity'"}, "gravity yes"},
    // arguments
    {"viscosity 20.", "viscosity", {"viscosity: expected a real number (g/(cm s)), found nothing"}},
    {"viscosity 20.", "viscosity 20. Volt", {"viscosity: expected a dynamic viscosity (in g/(cm s) or Pa s, mPa s, P)", "'Volt'", "no unit"}},
    {"viscosity 20.", "viscosity 20. mm", {"viscosity: expected a dynamic viscosity", "found '20. mm', a length"}},
    {"", "print xyz maxnum 5 cm", {"expected nothing after 5", "'cm'"}},
    {"density mass 0.84", "density mass 840 kg/m2", {"expected a mass density", "a quantity in cm^-2 g"}},
    {"collector distance 16.", "collector distance -16 mm", {"expected a value that is positive"}},
    {"viscosity 20.", "viscosity 20 g/cm s", {"'g/cm s'", "no unit"}},
    {"viscosity 20.", "viscosity twenty", {"expected a real number", "'twenty'"}},
    {"viscosity 20.", "viscosity 20,5", {"'20,5'", "did you mean 20.5?"}},
    {"viscosity 20.", "viscosity 1.0-8", {"'1.0-8'", "did you mean 1.0d-8?"}},
    {"viscosity 20.", "viscosity 20.P", {"'20.P'", "did you mean 20. P?"}},
    {"viscosity 20.", "viscosity 20.\xce\xbcP", {"'20.\\xce\\xbcP'", "a blank is missing behind 20."}},
    {"viscosity 20.", "viscosity 1..5", {"did you mean 1.5?"}},
    {"viscosity 20.", "viscosity 0x10", {"expected a real number", "'0x10'"}},
    {"viscosity 20.", "viscosity .", {"expected a real number", "'.'"}},
    {"viscosity 20.", "viscosity 1.d+", {"expected a real number", "'1.d+'"}},
    {"viscosity 20.", "viscosity nan", {"'nan'", "not finite"}},
    {"viscosity 20.", "viscosity +Inf", {"'+Inf'", "not finite"}},
    {"viscosity 20.", "viscosity 1.d400", {"'1.d400'", "beyond the range of double precision"}},
    {"viscosity 20.", "viscosity 1.d-400", {"'1.d-400'", "beyond the range of double precision"}},
    {"initial length 0.02", "initial length 0.02.d0", {"initial length: expected a real number (cm)", "'0.02.d0'", "did you mean 0.02d0?"}},
    {"points 1", "points 2.7", {"points: expected an integer", "'2.7'"}},
    {"points 1", "points 1.", {"points: expected an integer", "did you mean 1?"}},
    {"points 1", "points 99999999999", {"beyond the range of an integer"}},
    {"points 1", "points 0", {"points: expected a value that is from 1 to 100000000"}},
    {"points 1", "points -3", {"points: expected a value that is from 1"}},
    {"inserting yes", "inserting", {"inserting: expected yes|no, found nothing"}},
    {"inserting yes", "inserting ye", {"inserting: expected yes|no", "did you mean yes?"}},
    {"inserting yes", "inserting true", {"inserting: expected yes|no", "'true'"}},
    {"inserting yes", "inserting yes please", {"expected nothing after yes", "'please'"}},
    {"integrator 2", "integrator 5", {"integrator: expected auto|euler|heun", "'5'"}},
    {"integrator 2", "integrator huen", {"integrator: expected auto|euler|heun", "'huen'"}},
    {"", "units si", {"units: expected cgs|real"}},
    {"", "events exact", {"events: expected located|step"}},
    {"", "multirate yes", {"multirate: expected auto|no"}},
    {"", "parallel shared", {"parallel: expected replicated|distributed"}},
    {"", "parallel distributed", {"parallel distributed: expected coulomb tree or coulomb auto"}},
    {"", "seed abc", {"seed: expected an integer"}},
    {"system 3", "system 5", {"system: expected a value that is 1 (straight jet), 3 (three dimensions) or 4"}},
    {"print list t x n", "print list", {"print list: expected keys of observables, found nothing"}},
    {"print list t x n", "print list t xx n", {"print list", "'xx'", "they are t ts x"}},
    {"print list t x n", "print list t velocity n", {"print list", "'velocity'", "they are t ts x"}},
    {"", "printstat list cuurn", {"printstat list", "'cuurn'", "they are t ts x"}},
    // signs and sizes
    {"viscosity 20.", "viscosity 0.", {"viscosity: expected a value that is positive", "'0.'"}},
    {"viscosity 20.", "viscosity -20.", {"viscosity: expected a value that is positive"}},
    {"elastic modulus 50000.", "elastic modulus -1.", {"elastic modulus: expected a value that is positive"}},
    {"density mass 0.84", "density mass 0", {"density mass: expected a value that is positive"}},
    {"surface tension 21.13", "surface tension -1.", {"surface tension: expected a value that is zero or positive"}},
    {"nozzle cross 5.d-3", "nozzle cross 0.d0", {"nozzle cross: expected a value that is positive"}},
    {"collector distance 16.", "collector distance -16.", {"collector distance: expected a value that is positive"}},
    {"final time 0.5", "final time 0.", {"final time: expected a value that is positive"}},
    {"timestep 1.d-8", "timestep 0.", {"timestep: expected a value that is positive"}},
    {"print time 1.d-2", "print time 0.", {"print time: expected a value that is positive"}},
    {"", "cutoff 0.", {"cutoff: expected a value that is positive"}},
    {"", "print xyz 0.", {"print xyz: expected a value that is positive"}},
    {"", "print xyz rescale 0.", {"print xyz rescale: expected a value that is from 1e-100"}},
    {"", "print xyz maxnum 0", {"print xyz maxnum: expected a value that is from 1"}},
    {"", "nozzle velocity -1.", {"nozzle velocity: expected a value that is zero or positive"}},
    // presence
    {"system 3", "", {"system: missing; it is mandatory", "system <integer>"}, "deck"},
    {"final time 0.5", "", {"final time: missing; it is mandatory", "final time <real, s>"}, "deck"},
    {"initial length 0.02", "", {"initial length: missing; it is mandatory"}, "deck"},
    {"nozzle cross 5.d-3", "", {"nozzle cross: missing; it is mandatory"}, "deck"},
    {"density mass 0.84", "", {"density mass: missing; it is mandatory"}, "deck"},
    {"density charge 44000.", "", {"density charge: missing; it is mandatory"}, "deck"},
    {"viscosity 20.", "", {"viscosity: missing; it is mandatory"}, "deck"},
    {"elastic modulus 50000.", "", {"elastic modulus: missing; it is mandatory"}, "deck"},
    {"collector distance 16.", "", {"collector distance: missing; it is mandatory"}, "deck"},
    {"timestep 1.d-8", "", {"missing; expected either tolerance <real> or timestep <real, s>"}, "deck"},
    {"points 1", "", {"missing; expected either points <integer> or resolution <real, cm>"}, "deck"},
    {"integrator 2", "", {"integrator", "timestep needs integrator 1 (euler), 2 (heun), 3 (rk4) or 4 (sra1)"}, "deck"},
    {"", "resolution 0.02", {"resolution: expected either this or points, which is given at jet.dat:10"}},
    {"", "tolerance 1.d-6", {"tolerance: expected either this or timestep, which is given at jet.dat:4"}},
    {"", "viscosity 20.", {"viscosity: given twice, first at jet.dat:15"}, "last"},
    {"", "nozzle cross section 5.d-3", {"nozzle cross: given twice, first at jet.dat:12"}},
    {"", "systype 3", {"system: given twice, first at jet.dat:2"}},
    // relations
    {"initial length 0.02", "initial length 16.1", {"initial length 16.1: expected at most collector distance (16 cm)"}},
    {"points 1", "resolution 0.007", {"resolution 0.007: expected a divisor of initial length (0.02 cm)", "0.01 or 0.006666666667"}},
    {"points 1", "resolution 0.03", {"resolution 0.03: expected a divisor", "did you mean 0.02?"}},
    {"points 1", "resolution 1.d-12", {"resolution 1.d-12: expected at most 1e+08 elements"}},
    {"collector distance 16.", "collector distance 0.04", {"inserting yes: expected a collector distance above two elements (0.04 cm)"}, "inserting yes"},
    {"timestep 1.d-8", "timestep 0.5", {"timestep 0.5: expected less than final time (0.5 s)"}},
    {"", "print xyz rescale 1.7e308", {"print xyz rescale: expected a value that is from 1e-100"}},
    {"density charge 44000.", "density charge 1e-200", {"too far apart for double precision"}, "deck"},
    {"viscosity 20.", "viscosity 1e232", {"too far apart for double precision"}, "deck"},
    {"print time 1.d-2", "print time 1.d-216", {"print time 1.d-216: expected at least 5e-10 s: at most 1e+09 samples of final time (0.5 s)"}},
    {"", "print xyz 1.d-10", {"print xyz 1.d-10: expected at least 5e-10 s"}},
    {"", "print hdf5 1.d-52", {"print hdf5 1.d-52: expected at least 5e-10 s"}},
    {"timestep 1.d-8", "timestep 1.d-3\nprint xyz 1.d-9", {"print xyz 1.d-9: expected at least 1e-08 s: at most 1e+05 samples of a step (0.001 s)"}, "print xyz 1.d-9"},
    {"integrator 2", "integrator dopri5", {"integrator dopri5: timestep needs integrator 1 (euler)"}},
    {"integrator 2", "integrator auto", {"integrator auto: timestep needs integrator 1 (euler)"}},
    {"timestep 1.d-8", "tolerance 1.d-6", {"integrator 2: tolerance needs integrator auto"}, "integrator 2"},
    {"", "hbfluid consistency 2.", {"hbfluid consistency 2.: expected hbfluid yes"}},
    {"", "hbfluid index 2.", {"hbfluid index 2.: expected hbfluid yes"}},
    {"", "hbfluid yes\nhbfluid index 2.", {"hbfluid yes: expected hbfluid consistency"}, "hbfluid yes"},
    {"", "hbfluid yes\nhbfluid consistency 2.", {"hbfluid yes: expected hbfluid index"}, "hbfluid yes"},
    {"", "perturb yes\nperturb freq 1.d4", {"perturb yes: expected perturb ampl"}, "perturb yes"},
    {"", "perturb yes\nperturb ampl 1.d-3", {"perturb yes: expected perturb freq"}, "perturb yes"},
    {"", "perturb yes\nperturb freq 1.d4\nperturb ampl 0.03", {"perturb ampl 0.03: expected at most initial length"}, "perturb ampl 0.03"},
    {"system 3", "system 1\nperturb yes\nperturb freq 1.d4\nperturb ampl 1.d-3", {"perturb yes: expected no in system 1"}, "perturb yes"},
    {"system 3", "system 4\nairdrag no", {"system 4: expected airdrag yes, which system 4 means, or system 3"}, "system 4"},
    {"", "airdrag airdensity 0.", {"airdrag airdensity", "positive"}},
    {"", "airdrag model stokes", {"airdrag model: expected jetspin|jetspin-1.20|full, found 'stokes'"}},
    {"system 3", "system 1\nairdrag yes\nairdrag lift yes", {"airdrag lift yes: expected no in system 1"}, "airdrag lift yes"},
    {"", "external potential type 1", {"field wave 1: expected field frequency to be given, too"}},
    {"", "field wave ramp", {"field wave ramp: expected field time to be given, too"}},
    {"", "field wave table\nfield table 0 1 0 2", {"field table 0 1 0 2: expected pairs of a time, later each time"}, "field table 0 1 0 2"},
    {"external potential 30.02", "external potential vector 30. 10.", {"field vector 30. 10.: expected three numbers"}},
    {"", "external potential vector 1. 2. 3.", {"field vector 1. 2. 3.: expected no external potential besides"}},
    {"", "field needle 0.", {"field needle: expected a value that is positive"}},
    {"", "magnetic field 1. 2.", {"magnetic field 1. 2.: expected three numbers"}},
    {"", "magnetic field 0 0 0 1", {"magnetic field 0 0 0 1: expected three numbers"}},
    {"system 3", "system 1\nmagnetic field 0 0 1", {"magnetic field 0 0 1: expected system 3"}, "magnetic field 0 0 1"},
    {"", "magnetic field 0 0 1.d30", {"magnetic field 0 0 1.d30: beads would go round"}},
    {"", "lorentz yes", {"write magnetic field and its three components"}},
    {"", "noise yes", {"noise yes: expected noise diffusivity to be given, too"}},
    {"", "noise yes\nnoise diffusivity 1.\nnoise interval 1.d-20", {"noise interval 1.d-20: expected at least", "intervals of final time"}, "noise interval 1.d-20"},
    {"", "flow rate 2 mL/h", {"flow rate 2 mL/h: expected feed flow to be given, too"}},
    {"", "feed flow", {"feed flow: expected flow rate to be given, too, as 2 mL/h"}},
    {"inserting yes", "feed flow\nflow rate 2 mL/h", {"feed flow: expected inserting yes"}, "feed flow"},
    {"inserting yes", "model slender\nflow rate 2 mL/h", {"model slender: expected inserting yes; a jet without it is self field slender"}, "model slender"},
    {"", "feed flow\nflow rate 2 mL/h\nnozzle velocity 3", {"nozzle velocity 3: expected none: it is 7.07355 cm/s"}, "nozzle velocity 3"},
    {"", "model slender", {"model slender: expected flow rate to be given, too"}},
    {"", "model slender\nflow rate 2 mL/h\nself field point", {"self field point: expected slender, as model slender at jet.dat:20 says"}, "self field point"},
    {"", "model slender\nflow rate 2 mL/h\nfeed pull", {"feed pull: expected flow"}, "feed pull"},
    {"", "model slender\nflow rate 2 mL/h\ncutoff 1", {"model slender: expected no cutoff"}, "model slender"},
    {"", "flow rate 2 kV", {"expected a flow rate (in cm^3/s or mL/h, uL/min)"}},
    // JETSPIN's own
    {"", "cutoff points 5", {"cutoff points", "length in cm", "write cutoff and that length"}},
    {"system 3", "system 2", {"system 2", "write system 1 or system 3"}},
    {"", "variable mass deviation 0.1", {"variable mass", "leave the line out"}},
    {"", "kvfluid yes\nstress law oldroyd-b", {"kvfluid yes: expected stress law kelvin-voigt"}, "kvfluid yes"},
    {"", "stress law oldroyd", {"expected maxwell|kelvin-voigt", "did you mean oldroyd-b?"}},
    {"", "stress law giesekus", {"expected stress law mobility to be given, too"}},
    {"", "stress law mobility 0.1", {"expected stress law giesekus"}},
    {"", "stress law giesekus\nstress law mobility 1.5", {"at most 1"}, "stress law mobility 1.5"},
    {"", "stress law fene-p", {"expected stress law extensibility to be given, too"}},
    {"", "stress law extensibility 9", {"expected stress law fene-p"}},
    {"", "stress law oldroyd-b\nyield stress 100", {"the others do not yield"}, "yield stress 100"},
    {"", "stress law herschel-bulkley\nhbfluid consistency 1\nhbfluid index 1", {"expected yield stress to be given, too"}, "stress law herschel-bulkley"},
    {"", "stress law power-law\nhbfluid consistency 1", {"expected hbfluid index to be given, too"}, "stress law power-law"},
    {"", "stress law kelvin-voigt\nsolvent viscosity 1", {"viscosity is all of the viscous stress"}, "solvent viscosity 1"},
    {"", "hbfluid yes\nhbfluid consistency 1\nhbfluid index 1\nstress law oldroyd-b", {"expected stress law maxwell, to which it adds"}, "hbfluid yes"},
    {"", "dynamic refinement yes", {"dynamic refinement yes: expected dynamic refinement tolerance or dynamic refinement threshold"}, "dynamic refinement yes"},
    {"", "dynamic refinement yes\ndynamic refinement threshold 0.03", {"dynamic refinement threshold 0.03: expected at least 0.04 cm"}, "dynamic refinement threshold 0.03"},
    {"inserting yes", "dynamic refinement yes\ndynamic refinement tolerance 1.d-2", {"expected dynamic refinement every to be given"}, "dynamic refinement yes"},
    {"", "cutoff 1.\ndynamic refinement yes\ndynamic refinement tolerance 1.d-2", {"dynamic refinement yes: expected no cutoff"}, "dynamic refinement yes"},
    {"", "restart yes", {"restart"}},
    {"", "dragvel on", {"dragvel: expected yes|no, found 'on'"}},
    {"", "coulomb law soft", {"coulomb law: expected point|softened, found 'soft'; did you mean softened?"}},
    {"", "coulomb law softened\ncoulomb tree", {"coulomb law softened: expected coulomb direct, or coulomb law point, which trees have"}, "coulomb law softened"},
    {"", "coulomb law softened\ncutoff 1.", {"coulomb law softened: expected no cutoff, or coulomb law point"}, "coulomb law softened"},
    {"", "coulomb law softened\nself field slender", {"self field slender: expected coulomb law point"}, "self field slender"},
    {"", "coulomb law softened\nfeed flow\nflow rate 2 mL/h", {"coulomb law softened: expected feed pull"}, "coulomb law softened"},
    {"", "evaporation yes\nevaporation model vapour", {"expected evaporation polymer frac to be given, too"}, "evaporation yes"},
    {"", "evaporation yes\nevaporation polymer frac 0.1\nevaporation model jetspin\nevaporation solvent dmf", {"expected evaporation model vapour"}, "evaporation solvent dmf"},
    {"", "evaporation yes\nevaporation polymer frac 0.1\nevaporation model vapour\nevaporation solvent dmf", {"expected evaporation diffusivity"}, "evaporation solvent dmf"},
    {"", "evaporation yes\nevaporation polymer frac 0.1\nevaporation model vapour\nstress law oldroyd-b", {"expected stress law maxwell"}, "evaporation yes"},
    {"", "evaporation yes\nevaporation polymer frac 0.1\nevaporation model vapour\nevaporation temperature 20.", {"from 223.15 to 373.15"}, "evaporation temperature 20."},
};
// clang-format on

}  // namespace treejet

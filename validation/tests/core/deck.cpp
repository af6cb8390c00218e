#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <catch2/catch.hpp>
#include <cmath>
#include <fstream>
#include <map>
#include <sstream>

#include "core/base/error.hpp"
#include "core/base/lines.hpp"
#include "core/base/number.hpp"
#include "core/deck/deck.hpp"
#include "core/deck/directives.hpp"
#include "core/deck/foreign.hpp"
#include "core/deck/observable_keys.hpp"
#include "core/deck/subdomains.hpp"
#include "core/deck/suggestion.hpp"
#include "core/jet/scales.hpp"
#include "validation/tests/core/broken_decks.hpp"

using namespace treejet;

namespace {

const std::string name = "jet.dat";

std::vector<std::string> lines(const std::string& text) {
  std::vector<std::string> all;
  std::istringstream in(text);
  for (std::string line; std::getline(in, line);) all.push_back(line);
  return all;
}

std::string joined(const std::vector<std::string>& all) {
  std::string text;
  for (const std::string& line : all) text += line + "\n";
  return text;
}

/// The sound deck with one line replaced, added or left out.
std::string altered(const std::string& was, const std::string& is) {
  std::vector<std::string> all = lines(sound_deck);
  const auto place = std::find(all.begin(), all.end(), was.empty() ? "finish" : was);
  REQUIRE(place != all.end());
  if (was.empty())
    all.insert(place, is);
  else if (is.empty())
    all.erase(place);
  else
    *place = is;
  return joined(all);
}

std::string message(const std::string& text, const std::vector<std::string>& overrides = {}) {
  try {
    parse_deck(text, name, overrides);
  } catch (const InputError& error) {
    CHECK(error.exit_code() == 2);
    return error.what();
  }
  return "";
}

long line_number(const std::string& text, const std::string& line, bool last) {
  const std::vector<std::string> all = lines(text);
  if (last) return all.rend() - std::find(all.rbegin(), all.rend(), line);
  return std::find(all.begin(), all.end(), line) - all.begin() + 1;
}

/// Every member as the deck spells it.
std::map<std::string, std::string> values(const Parameters& parameters) {
  std::map<std::string, std::string> all;
  for (const Directive& d : directives()) all[std::string(d.words)] = value_text(d, parameters);
  return all;
}

std::string source_file(const std::string& path) {
  return std::string(TREEJET_SOURCE_DIR) + "/" + path;
}

}  // namespace

TEST_CASE("A broken deck gets one message that names file, line, directive, expectation and the nearest fix",
          "[deck]") {
  for (const Broken& broken : broken_decks) {
    const std::string text = altered(broken.was, broken.is);
    const std::string said = message(text);
    INFO(broken.was + " -> " + broken.is);
    INFO(said);
    for (const std::string& essential : broken.says) CHECK(said.find(essential) != std::string::npos);
    const bool no_guess = broken.is.starts_with("eta ");  // nothing is near, so the directive is missing, too
    CHECK(lines(said).size() == (no_guess ? 2u : 1u));
    const std::string blamed = broken.blamed.empty() || broken.blamed == "last" ? broken.is : broken.blamed;
    const std::string where =
        blamed == "deck" ? name + ": "
                         : fmt::format("{}:{}: ", name, line_number(text, blamed, broken.blamed == "last"));
    CHECK(said.starts_with(where));
  }
  CHECK(broken_decks.size() >= 60);
}

TEST_CASE("All errors of a deck are reported together, in the order of the lines, what is missing last",
          "[deck]") {
  const std::string said = message("system 3\nviscosty 20.\nfinal time 1.0.0\npoints 2.7\nbanana\n");
  INFO(said);
  const std::vector<std::string> all = lines(said);
  const std::vector<std::string> first = {"jet.dat:2: 'viscosty 20.'", "jet.dat:3: final time",
                                          "jet.dat:4: points", "jet.dat:5: 'banana'",
                                          "jet.dat: finish: missing"};
  REQUIRE(all.size() > first.size());
  for (std::size_t i = 0; i < first.size(); ++i) CHECK(all[i].starts_with(first[i]));
  CHECK(said.find("elastic modulus: missing") != std::string::npos);
  CHECK(said.find("viscosity: missing") == std::string::npos);  // it is there, misspelt
  CHECK(said.find("initial length: missing") != std::string::npos);
}

TEST_CASE("A deck that is no text gets a short message", "[deck]") {
  CHECK(lines(message(std::string("\x7f"
                                  "ELF\0\0",
                                  6)))
            .size() == 1);
  CHECK(lines(message(std::string(1 << 19, 'x'))).size() == 1);
  std::string garbage;
  for (int i = 0; i < 5000; ++i) garbage += fmt::format("\x01{}\n", i);
  CHECK(lines(message(garbage)).size() == 101);  // a hundred errors and how many more there are
  CHECK_THROWS_AS(read_deck("/nonexistent/input.dat"), FileError);
  CHECK_THROWS_AS(read_deck("/"), FileError);
}

TEST_CASE("Numbers are read as Fortran users write them and rounded correctly", "[deck]") {
  const std::map<std::string, double> written = {{"1.d-8", 1e-8},
                                                 {"10000.d", 10000},
                                                 {"0.02d0", 0.02},
                                                 {"1.E+2", 100},
                                                 {"+.5", 0.5},
                                                 {"5.", 5},
                                                 {"-3", -3},
                                                 {"1D5", 1e5},
                                                 {"1e-8", 1e-8},
                                                 {"3.19d-1", 0.319},
                                                 {"8.18912288d-1", 0.818912288},
                                                 {"0.", 0},
                                                 {"0e99", 0},
                                                 {"-.5E1", -5},
                                                 {"00012", 12},
                                                 {"1.d+4", 1e4},
                                                 {"5e", 5},
                                                 {"0.1", 0.1},
                                                 {"2.2250738585072014d-308", 2.2250738585072014e-308},
                                                 {"9007199254740993", 9007199254740992.0},
                                                 {"1.7976931348623157D+308", 1.7976931348623157e308}};
  for (const auto& [word, value] : written) {
    INFO(word);
    const Reading<double> reading = real_number(word);
    CHECK(reading.problem == "");
    CHECK(reading.value == value);  // bit for bit: the compiler's own conversion rounds correctly, too
  }
}

TEST_CASE("What is not a number is never read as one", "[deck]") {
  for (const char* word : {"",
                           ".",
                           "+",
                           "-",
                           "d5",
                           ".d0",
                           "1.2.3",
                           "1d5.",
                           "1,5",
                           "1d+",
                           "1 5",
                           "0x1p3",
                           "nan",
                           "-inf",
                           "infinity",
                           "1_000",
                           "--1",
                           "+-1",
                           "1e5e5",
                           "1.d400",
                           "-1.d400",
                           "1.d-400",
                           "1e99999999999999999999",
                           "\xff"}) {
    INFO(word);
    CHECK(real_number(word).problem.starts_with("found "));
  }
  for (const char* word :
       {"", "+", "-", "2.7", "2.", "1e3", "0x10", "99999999999", "-99999999999", "+-3", "--3", "3a"}) {
    INFO(word);
    CHECK(integer(word).problem.starts_with("found "));
  }
  CHECK(integer("+3").value == 3);
  CHECK(integer("-3").value == -3);
  CHECK(integer("2147483647").value == 2147483647);
}

TEST_CASE("A hint names the same number well spelt, and none where two could be meant", "[deck]") {
  const auto hint = [](const char* word) {
    const std::string problem = real_number(word).problem, question = "; did you mean ";
    const std::size_t at = problem.find(question);
    return at == std::string::npos ? "" : problem.substr(at + question.size());
  };
  CHECK(hint("1.q4") == "1.d4?");
  CHECK(hint("1x10^4") == "1d4?");
  CHECK(hint("2.5*10**-3") == "2.5d-3?");
  CHECK(hint("1.0-8") == "1.0d-8?");
  CHECK(hint("20,5") == "20.5?");
  CHECK(hint("1,5d3") == "1.5d3?");
  CHECK(hint("0.02.d0") == "0.02d0?");
  CHECK(hint("1.d\xe2\x88\x92"
             "3") == "1.d-3?");  // U+2212
  CHECK(hint("\xe2\x80\x93"
             "5.") == "-5.?");  // en dash: the sign is kept
  CHECK(real_number("1.d\xe2\x88\x92"
                    "3")
            .problem.find("U+2212") != std::string::npos);
  for (const char* ambiguous : {"44,000", "1,234,567", "0x14", "2o", "1.2.3", "12a", "5O.", "1d4d"}) {
    INFO(ambiguous);
    CHECK(hint(ambiguous) == "");
  }
  CHECK(real_number("44,000").problem.find("write a decimal point") != std::string::npos);
}

TEST_CASE("No value is guessed by its letters: on is not no, gc is not vc", "[deck]") {
  for (const char* line :
       {"gravity on", "gravity ys", "printstat list t gd", "multirate off", "integrator huen"}) {
    INFO(line);
    const std::string said = message(sound_deck, {line});
    CHECK(said.find("found '") != std::string::npos);
    CHECK(said.find("did you mean") == std::string::npos);
  }
  CHECK(message(altered("", "gravity ye")).find("did you mean yes?") != std::string::npos);
}

TEST_CASE(
    "A feature that is switched off, or concerns files alone, is one note whatever the number of its lines",
    "[deck]") {
  for (const char* line :
       {"multiple step no", "multiple step yes", "primary cutoff 5.", "maximum displ 5.", "restart no",
        "variable mass no", "noise pool 10", "lorentz no", "mirror no", "job time 3600",
        "print binary 1.d-4 style 3", "printstat binary", "print pdb frame 1.d-3", "print xyz frame 1.d-2",
        "print rescalexyz", "cutoff points 1000"}) {
    INFO(line);
    const Deck deck = parse_deck(altered("", line), name);
    const auto about = [&](const std::string& note) { return note.find(": left out") != std::string::npos; };
    CHECK(std::count_if(deck.notes.begin(), deck.notes.end(), about) == 1);
    CHECK(values(deck.parameters) == values(parse_deck(sound_deck, name).parameters));
  }
  const std::vector<std::string> notes =
      parse_deck(altered("", "mirror no\nmirror 5.\nmirror 6."), name).notes;
  REQUIRE(notes.size() == 2);
  CHECK(notes[0].starts_with("jet.dat:20: mirror no: left out (3 lines on image charges)"));
  CHECK(notes[1].find("1/R^2") != std::string::npos);  // such a deck means another Coulomb law
}

TEST_CASE("Keys of what is not modelled are left out of the tables with a note; others are errors",
          "[deck]") {
  const Deck deck = parse_deck(sound_deck, name, {"printstat list t mxst rc erms"});
  CHECK(deck.parameters.printstat_list == std::vector<std::string>{"t", "rc"});
  REQUIRE(deck.notes.size() == 2);
  CHECK(deck.notes[0].find("mxst (largest stress), erms (multiple step)") != std::string::npos);
  CHECK(message(sound_deck, {"printstat list mxst"}).find("expected keys of observables") !=
        std::string::npos);
}

TEST_CASE("A jet may reach from nozzle to collector, and no farther", "[deck]") {
  CHECK(parse_deck(sound_deck, name, {"initial length 16.", "points 100"}).parameters.initial_length == 16);
  CHECK(message(sound_deck, {"initial length 17."}).find("expected at most") != std::string::npos);
}

TEST_CASE("A deck of a later JETSPIN is told in one line which Coulomb law it gets, unless it names it",
          "[deck]") {
  const auto told = [](const std::vector<std::string>& lines) {
    std::vector<std::string> laws;
    for (const std::string& note : parse_deck(sound_deck, name, lines).notes)
      if (note.find("the Coulomb law is") != std::string::npos) laws.push_back(note);
    return laws;
  };
  CHECK(told({}).empty());  // of JETSPIN 1.00
  REQUIRE(told({"multiple step yes"}).size() == 1);
  CHECK(told({"multiple step yes"})[0].find("point, 1/R^2, and beads are released with the") !=
        std::string::npos);
  REQUIRE(told({"dragvel no"}).size() == 1);
  CHECK(told({"dragvel no"})[0].find("released without the paper's dragging velocity") != std::string::npos);
  REQUIRE(told({"mirror no", "coulomb law softened"}).size() == 1);
  CHECK(told({"mirror no", "coulomb law softened"})[0].find("softened, 1/(R + a)^2") != std::string::npos);
  CHECK(told({"multiple step yes", "coulomb law point", "dragvel yes"}).empty());
}

TEST_CASE("An interval longer than the run is noted, whichever file it is of", "[deck]") {
  for (const char* line : {"print time 1.", "print xyz 1.", "print hdf5 1."}) {
    const std::vector<std::string> notes = parse_deck(sound_deck, name, {line}).notes;
    REQUIRE(notes.size() == 1);
    CHECK(notes[0].find(std::string(line) + ": longer than final time (0.5 s)") != std::string::npos);
  }
}

TEST_CASE("A relation is judged only where everything it rests on is sound", "[deck]") {
  const std::string said =
      message(altered("points 1", "points ten"),
              {"coulomb tree", "parallel distributed", "tolerance 1e-5", "integrator auto", "multirate no"});
  CHECK(lines(said).size() == 1);
  CHECK(said.starts_with("jet.dat:10: points: expected an integer"));
}

TEST_CASE("A deck in laboratory units is the deck in CGS", "[deck]") {
  const Parameters cgs = parse_deck(sound_deck, name).parameters;
  const Parameters lab =
      parse_deck(
          sound_deck, name,
          {"external potential = 9 kV", "viscosity 2 Pa s", "elastic modulus 5 kPa", "density mass 840 kg/m3",
           "density charge 14.7 mC/L", "surface tension 21.13 mN/m", "nozzle cross 50 um",
           "collector distance 160 mm", "final time 500 ms", "initial length 0.2 mm"})
          .parameters;
  constexpr double round_off = 4e-16;  // two roundings of a number and a quotient
  const auto alike = [&](double a, double b) { CHECK(std::abs(a / b - 1) <= round_off); };
  alike(lab.external_potential, 9000 / 299.792458);
  alike(lab.viscosity, cgs.viscosity);
  alike(lab.elastic_modulus, cgs.elastic_modulus);
  alike(lab.density_mass, cgs.density_mass);
  alike(lab.density_charge, 14.7 * 2997.92458);
  alike(lab.surface_tension, cgs.surface_tension);
  alike(lab.nozzle_cross, cgs.nozzle_cross);
  alike(lab.collector_distance, cgs.collector_distance);
  alike(lab.final_time, cgs.final_time);
  alike(lab.initial_length, cgs.initial_length);
  const Parameters turning = parse_deck(sound_deck, name, {"perturb freq 10 kHz"}).parameters;
  alike(turning.perturb_frequency, 62831.853071795864769);  // 2 pi 10^4
}

TEST_CASE("units real and units at the numbers give the same groups as CGS", "[deck]") {
  // 0.0147 C/L are 14.7 C/m^3; 300 V are 300/299.792458 statV
  const std::vector<std::string> real = {"units real", "density charge 0.0147", "external potential 300"};
  const std::vector<std::string> carried = {"units real", "density charge 14.7 mC/L",
                                            "external potential 0.3 kV"};
  const std::vector<std::string> cgs = {"density charge 44069.491326",
                                        "external potential 1.000692285594456"};
  const Groups want = groups(parse_deck(sound_deck, name, cgs).parameters);
  for (const auto& overrides : {real, carried}) {
    const Groups got = groups(parse_deck(sound_deck, name, overrides).parameters);
    constexpr double digits = 1e-12;  // the CGS numbers are written with 13 digits and more
    CHECK(std::abs(got.Q / want.Q - 1) < digits);
    CHECK(std::abs(got.V / want.V - 1) < digits);
    CHECK(std::abs(got.H / want.H - 1) < digits);
  }
}

TEST_CASE("A bare number that is absurd in its unit gets a note with the unit that was likely meant",
          "[deck]") {
  for (const auto& [line, likely] :
       std::map<std::string, std::string>{{"density mass 839", "if kg/m3 are meant, write 839 kg/m3"},
                                          {"external potential 9000", "if V are meant, write 9000 V"},
                                          {"collector distance 0.16", "if m are meant, write 0.16 m"},
                                          {"surface tension 0.021", "if N/m are meant, write 0.021 N/m"},
                                          {"nozzle cross 0.26", "if mm are meant, write 0.26 mm"},
                                          {"density charge 14.7", "if C/m3 are meant, write 14.7 C/m3"}}) {
    INFO(line);
    const std::string bare =
        fmt::format("{}", fmt::join(parse_deck(sound_deck, name, {line, "resolution 0.02"}).notes, "\n"));
    INFO(bare);
    CHECK(bare.find(likely) != std::string::npos);
    const std::string written = likely.substr(likely.find("write ") + 6);
    const std::string words = line.substr(0, line.find_last_of(' '));
    const std::vector<std::string> meant = parse_deck(sound_deck, name, {words + " " + written}).notes;
    CHECK(fmt::format("{}", fmt::join(meant, "\n")).find("taken as") == std::string::npos);
  }
}

TEST_CASE("Numbers are in the units that a deck names, before and behind its line", "[deck]") {
  const std::vector<std::string> numbers = {"density charge 14.7 mC/L", "external potential 9 kV"};
  std::vector<std::string> before = numbers, behind = numbers;
  before.insert(before.begin(), "units real");
  behind.push_back("units real");
  const Parameters a = parse_deck(sound_deck, name, before).parameters,
                   b = parse_deck(sound_deck, name, behind).parameters;
  CHECK(differences(a, b).empty());
  CHECK(scales(a).charge == scales(b).charge);
  std::string last = altered("", "units real");
  CHECK(scales(parse_deck(last, name, numbers).parameters).charge == scales(a).charge);
}

TEST_CASE("A field turns at most a thousand million times in a run", "[deck]") {
  const auto wave = [](const char* frequency) {
    return message(sound_deck,
                   {"field wave square", std::string("field frequency ") + frequency, "final time 1."});
  };
  CHECK_THAT(wave("5.1d8 Hz"), Catch::Contains("expected at most 5e+08 Hz: at most 1e+09 half periods"));
  CHECK_THAT(wave("4.9d8 Hz"), !Catch::Contains("half periods"));
}

TEST_CASE("A comment in Latin-1 is kept in UTF-8, which all files are written in", "[deck]") {
  const std::string latin = altered("viscosity 20.", "viscosity 20. ! Viskosit\xe4t");
  const Deck deck = parse_deck(latin, name, {"gravity yes # \xe9t\xe9"});
  CHECK(deck.text.find("! Viskosit\xc3\xa4t") != std::string::npos);
  CHECK(deck.overrides[0] == "gravity yes # \xc3\xa9t\xc3\xa9");
  CHECK(parse_deck(deck.text, name, deck.overrides).text == deck.text);  // a resumed run reads the same
}

TEST_CASE(
    "What is shown on a terminal commands none: control characters, those of UTF-8 too, are question marks",
    "[deck]") {
  CHECK(printable("a\tb\n\xc3\xa4\xe2\x88\x92~") == "a\tb\n\xc3\xa4\xe2\x88\x92~");
  CHECK(printable("\x1b[2J\x07\r\x7f") == "?[2J???");
  CHECK(printable("\xc2\x9b"
                  "2J") == "??2J");  // U+009B opens a command as ESC [ does
  CHECK(printable(std::string(1, '\0')) == "?");
}

TEST_CASE("UTF-8 stays as it is, anything else is read as Latin-1", "[deck]") {
  for (const char* valid :
       {"", "plain", "\xc3\xa4", "\xe2\x88\x92", "\xf0\x9f\x8c\x80", "\xef\xbf\xbd", "\xf4\x8f\xbf\xbf"})
    CHECK(utf8(valid) == valid);
  CHECK(utf8("\xe4") == "\xc3\xa4");
  CHECK(utf8("\xff") == "\xc3\xbf");
  // overlong, surrogate, beyond U+10FFFF, cut short: RFC 3629 allows none of them
  for (const char* invalid : {"\xc0\x80", "\xe0\x80\x80", "\xed\xa0\x80", "\xf4\x90\x80\x80", "\xe2\x88"}) {
    CHECK(utf8(invalid) != invalid);
    CHECK(utf8(utf8(invalid)) == utf8(invalid));
  }
}

TEST_CASE("Blanks, tabs, case, comments and line ends do not matter", "[deck]") {
  const auto reference = values(parse_deck(sound_deck, name).parameters);
  std::string shouted, tabbed, dos, old_mac, commented;
  for (const std::string& line : lines(sound_deck)) {
    for (const char c : line) shouted += static_cast<char>(std::toupper(c));
    shouted += "\n";
    tabbed += "\t ";
    for (const char c : line) tabbed += c == ' ' ? std::string("\t  ") : std::string(1, c);
    tabbed += " \t\n\n";
    dos += line + "\r\n";
    old_mac += line + "\r";
    commented += line + (line[0] == '#' ? "\n" : "! said: viscosity 3 # finish\n");
  }
  for (const std::string& text :
       {shouted, tabbed, dos, old_mac, commented, "\xEF\xBB\xBF" + sound_deck,
        sound_deck.substr(0, sound_deck.size() - 1), sound_deck + "\n# the end\n \t! really\n"})
    CHECK(values(parse_deck(text, name).parameters) == reference);
  CHECK(message(dos + "gravity yes\r\n").starts_with("jet.dat:21: finish"));
}

TEST_CASE("A deck says what it says: every directive reaches its member", "[deck]") {
  const Parameters p = parse_deck(R"(system 1
    units real
    tolerance 2.d-7
    integrator Verner6
    events step
    multirate no
    final time 3.
    resolution 0.05
    initial length 0.2
    nozzle cross section 0.01
    nozzle stress -4.
    nozzle velocity 5.
    density mass 6.
    density charge 7.
    viscosity 8.
    elastic modulus 9.
    collector distance 10.
    external potential 11.
    surface tension 12.
    yield stress 13.
    hbfluid yes
    hbfluid consistency 14.
    hbfluid index 0.5
    gravity yes
    inserting yes
    removing yes
    cutoff 15.
    perturbation no
    perturbation frequency 16.
    perturb amplitude 0.1
    print time 0.17
    print list T X cpu t
    printstat list curn curc
    print xyz 0.18
    print xyz maxnumber 19
    print xyz rescale 20.
    finish)",
                                  name)
                           .parameters;
  CHECK(p.system == 1);
  CHECK(p.units == Units::real);
  CHECK(p.tolerance == 2e-7);
  CHECK(!p.timestep);
  CHECK(p.integrator == Scheme::verner6);
  CHECK(p.events == EventRule::step);
  CHECK(p.multirate == Multirate::no);
  CHECK(p.final_time == 3);
  CHECK(p.resolution == 0.05);
  CHECK(!p.points);
  CHECK(p.initial_length == 0.2);
  CHECK(p.nozzle_cross == 0.01);
  CHECK(p.nozzle_stress == -4);
  CHECK(p.nozzle_velocity == 5);
  CHECK(p.density_mass == 6);
  CHECK(p.density_charge == 7);
  CHECK(p.viscosity == 8);
  CHECK(p.elastic_modulus == 9);
  CHECK(p.collector_distance == 10);
  CHECK(p.external_potential == 11);
  CHECK(p.surface_tension == 12);
  CHECK(p.yield_stress == 13);
  CHECK(p.hbfluid);
  CHECK(p.hb_consistency == 14);
  CHECK(p.hb_index == 0.5);
  CHECK(p.gravity);
  CHECK(p.inserting);
  CHECK(p.removing);
  CHECK(p.cutoff == 15.);
  CHECK(!p.perturb);
  CHECK(p.perturb_frequency == 16);
  CHECK(p.perturb_amplitude == 0.1);
  CHECK(p.print_time == 0.17);
  CHECK(p.print_list == std::vector<std::string>{"t", "x", "cpu", "t"});
  CHECK(p.printstat_list == std::vector<std::string>{"curn", "curc"});
  CHECK(p.print_xyz == 0.18);
  CHECK(p.xyz_maxnum == 19);
  CHECK(p.xyz_rescale == 20);
}

TEST_CASE("Each integrator answers to its number and its name", "[deck]") {
  for (const auto& [word, scheme] : std::map<std::string, Scheme>{{"1", Scheme::euler},
                                                                  {"euler", Scheme::euler},
                                                                  {"2", Scheme::heun},
                                                                  {"heun", Scheme::heun},
                                                                  {"3", Scheme::rk4},
                                                                  {"RK4", Scheme::rk4},
                                                                  {"4", Scheme::sra1},
                                                                  {"sra1", Scheme::sra1}})
    CHECK(parse_deck(altered("integrator 2", "integrator " + word), name).parameters.integrator == scheme);
  for (const auto& [word, scheme] : std::map<std::string, Scheme>{{"auto", Scheme::automatic},
                                                                  {"dopri5", Scheme::dopri5},
                                                                  {"verner6", Scheme::verner6},
                                                                  {"kencarp5", Scheme::kencarp5}})
    CHECK(parse_deck(sound_deck, name, {"tolerance 1.d-6", "integrator " + word}).parameters.integrator ==
          scheme);
}

TEST_CASE("What a deck leaves out has the default of Appendix A", "[deck]") {
  const Parameters p = parse_deck(R"(system 3
    tolerance 1.d-6
    final time 1.
    points 1
    initial length 0.02
    nozzle cross 5.d-3
    density mass 0.84
    density charge 0
    viscosity 20.
    elastic modulus 5.d4
    collector distance 16.
    finish)",
                                  name)
                           .parameters;
  for (const double zero : {p.nozzle_stress, p.nozzle_velocity, p.external_potential, p.surface_tension,
                            p.yield_stress, p.perturb_frequency, p.perturb_amplitude})
    CHECK(zero == 0);
  for (const bool no : {p.hbfluid, p.gravity, p.inserting, p.removing, p.perturb}) CHECK(!no);
  CHECK((!p.cutoff && !p.print_time && !p.print_xyz && p.print_list.empty() && p.printstat_list.empty()));
  CHECK(p.units == Units::cgs);
  CHECK(p.integrator == Scheme::automatic);
  CHECK(p.events == EventRule::located);
  CHECK(p.multirate == Multirate::automatic);
  CHECK(p.xyz_maxnum == 100);
  CHECK(p.xyz_rescale == 1);
  CHECK(p.hb_consistency == 1);
  CHECK(p.hb_index == 1);
  CHECK(print_interval(p) == Approx(0.01));
  CHECK(print_interval(parse_deck(altered("print time 1.d-2", ""), name).parameters) == Approx(1e-5));
}

TEST_CASE("A resolution that divides the initial length up to round-off is accepted", "[deck]") {
  for (const char* resolution : {"0.02", "0.01", "6.66666666667d-3", "0.005"})
    CHECK(message(altered("points 1", std::string("resolution ") + resolution)) == "");
}

TEST_CASE("Overrides replace the deck's line, add one, and are checked like the deck", "[deck]") {
  const auto with = [](const std::vector<std::string>& overrides) {
    return parse_deck(sound_deck, name, overrides).parameters;
  };
  CHECK(with({"viscosity 30. # thicker"}).viscosity == 30);
  CHECK(with({"GRAVITY yes", "nozzle cross section 6.d-3"}).gravity);
  CHECK(with({"nozzle cross section 6.d-3"}).nozzle_cross == 6e-3);
  const Parameters finer = with({"resolution 0.01"});
  CHECK(finer.resolution == 0.01);
  CHECK(!finer.points);
  const Parameters adaptive = with({"tolerance 1.d-7", "integrator auto"});
  CHECK(!adaptive.timestep);
  CHECK(message(altered("viscosity 20.", "viscosity 2o"), {"viscosity 20."}) == "");

  CHECK(message(sound_deck, {"viscosity 2o"})
            .starts_with("--set 'viscosity 2o': viscosity: expected a real number"));
  CHECK(message(sound_deck, {"viscosty 2"}).find("did you mean viscosity?") != std::string::npos);
  CHECK(message(sound_deck, {"viscosity 1.", "viscosity 2."})
            .find("given twice, first at --set 'viscosity 1.'") != std::string::npos);
  CHECK(message(sound_deck, {"points 1", "resolution 0.02"}).find("expected either this or points") !=
        std::string::npos);
  CHECK(message(sound_deck, {"tolerance 1.d-6"}).find("jet.dat:3: integrator 2: tolerance needs") !=
        std::string::npos);
  const Parameters pumped = parse_deck(altered("points 1", "points 1\nnozzle velocity 3"), name,
                                       {"model slender", "flow rate 2 mL/h"})
                                .parameters;
  CHECK(pumped.flow_rate == Approx(2.0 / 3600).epsilon(1e-15));
  CHECK(pumped.feed == Feed::flow);
  CHECK(pumped.self_field == SelfField::slender);
  CHECK(pumped.surface_model == SurfaceModel::energy);
  for (const char* nothing : {"", "# viscosity 3", "finish", "gravity yes\nviscosity 3."})
    CHECK(message(sound_deck, {nothing}).find("expected one directive and its value") != std::string::npos);
}

TEST_CASE("A deck keeps its source, its name and its overrides", "[deck]") {
  const Deck deck = parse_deck(sound_deck, name, {"viscosity 30."});
  CHECK(deck.text == sound_deck);
  CHECK(deck.name == name);
  CHECK(deck.overrides == std::vector<std::string>{"viscosity 30."});
  CHECK(deck.notes.empty());
}

TEST_CASE("Refinement by curvature of a jet that noise bends from bead to bead is noted", "[deck]") {
  const auto notes = [](const char* refining) {
    const std::vector<std::string> lines = {
        "airdrag yes",        "airdrag amplitude 1.",           "dynamic refinement yes",
        "self field slender", "dynamic refinement every 1.d-3", refining};
    return fmt::format("{}", fmt::join(parse_deck(sound_deck, name, lines).notes, "\n"));
  };
  const char* says = "split down to twice their radius";
  CHECK(notes("dynamic refinement tolerance 1.d-2").find(says) != std::string::npos);
  CHECK(notes("dynamic refinement threshold 0.5").find(says) == std::string::npos);
}

TEST_CASE("What has no effect is noted, not refused", "[deck]") {
  for (const auto& [line, essential] :
       std::map<std::string, std::string>{{"seed 317", "jet.dat:20: seed 317: no effect"},
                                          {"perturb freq 1.d4", "no effect without perturb yes"},
                                          {"airdrag airvelocity -1.d3", "no effect without airdrag yes"},
                                          {"noise variance 1.", "no effect without noise yes"},
                                          {"noise interval 1.d-6", "no effect: nothing here is random"},
                                          {"print xyz maxnum 400", "no effect without print xyz"}}) {
    const std::vector<std::string> notes = parse_deck(altered("", line), name).notes;
    REQUIRE(notes.size() == 1);
    CHECK(notes[0].find(essential) != std::string::npos);
  }
  const std::vector<std::string> notes = parse_deck(altered("system 3", "system 1"), name).notes;
  REQUIRE(notes.size() == 1);
  CHECK(notes[0].find("surface tension 21.13: no effect in system 1") != std::string::npos);
  const std::vector<std::string> shorter = parse_deck(altered("points 1", "points 5"), name).notes;
  REQUIRE(shorter.size() == 1);
  CHECK(shorter[0].find("points 5: elements (0.004 cm) are shorter than nozzle cross (0.005 cm)") !=
        std::string::npos);
  const std::vector<std::string> wide =
      parse_deck(altered("points 1", "points 4\nperturb yes\nperturb freq 1.d4\nperturb ampl 0.01"), name)
          .notes;
  REQUIRE(wide.size() == 1);
  CHECK(wide[0].find("perturb ampl 0.01: the nozzle begins 2.24 elements from the bead next to it") !=
        std::string::npos);
}

TEST_CASE("The paper's listings run as printed, or lead to the fix in one step", "[deck]") {
  CHECK(read_deck(source_file("validation/decks/paper-input-1.dat")).parameters.elastic_modulus == 10000);
  CHECK(read_deck(source_file("validation/decks/paper-input-2.dat")).parameters.density_charge == 37607.35);
  const std::string third = source_file("validation/decks/paper-input-3.dat");
  CHECK_THROWS_WITH(read_deck(third),
                    third +
                        ":18: initial length: expected a real number (cm), found '0.02.d0'; "
                        "did you mean 0.02d0?");
  const Parameters p = read_deck(third, {"initial length 0.02d0"}).parameters;
  CHECK(p.initial_length == 0.02);
  CHECK(p.perturb);
  CHECK(p.perturb_frequency == 1e4);
  CHECK(p.xyz_maxnum == 400);
}

TEST_CASE("The example decks are the paper's cases", "[deck]") {
  const Deck one = read_deck(source_file("examples/single-bead/input.dat"));
  CHECK(one.notes.empty());
  CHECK(one.parameters.timestep == 1e-8);
  CHECK(one.parameters.integrator == Scheme::heun);
  const Deck two = read_deck(source_file("examples/straight-jet/input.dat"));
  CHECK(two.notes.empty());
  CHECK(two.parameters.density_charge == 3761.26389);
  CHECK(two.parameters.density_mass == 0.818912288);
  const Deck three = read_deck(source_file("examples/pvp/input.dat"));
  CHECK(three.notes.empty());
  CHECK(three.parameters.perturb);
  CHECK(three.parameters.nozzle_velocity == 0.282942121);
}

TEST_CASE("The template is a valid deck that shows every directive with its default or an example",
          "[deck]") {
  const std::string text = deck_template();
  const Deck deck = parse_deck(text, "template");
  CHECK(deck.notes.empty());
  auto said = values(deck.parameters);
  const auto defaults = values(Parameters{});
  for (const Directive& d : directives()) {
    const std::string words(d.words);
    INFO(words);
    CHECK(text.find(fmt::format("\n{}{} ", d.example.empty() ? "# " : "", words)) != std::string::npos);
    if (d.example.empty()) CHECK(said[words] == defaults.at(words));
    if (d.mandatory) CHECK(!d.example.empty());
  }
}

TEST_CASE("A commented line of the template that is switched on changes nothing", "[deck]") {
  const std::string text = deck_template();
  const auto reference = values(parse_deck(text, "template").parameters);
  for (const Directive& d : directives()) {
    const bool needs_company = d.words.starts_with("hbfluid ");  // hbfluid yes and its partner
    if (!d.example.empty() || value_text(d, Parameters{}).empty() || needs_company) continue;
    std::string active = text;
    active.erase(active.find(fmt::format("\n# {} ", d.words)) + 1, 2);
    INFO(d.words);
    CHECK(values(parse_deck(active, "template").parameters) == reference);
  }
}

TEST_CASE("What a run's parameters spell reads back as the same parameters", "[deck]") {
  for (const char* path :
       {"examples/single-bead/input.dat", "examples/straight-jet/input.dat", "examples/pvp/input.dat"}) {
    const Parameters p = read_deck(source_file(path)).parameters;
    std::string text;
    for (const Directive& d : directives()) {
      const std::string value = value_text(d, p);
      const bool needs_company = d.words.starts_with("hbfluid ");
      if (!value.empty() && !needs_company) text += std::string(d.words) + " " + value + "\n";
    }
    CHECK(values(parse_deck(text + "finish", path).parameters) == values(p));
  }
}

TEST_CASE("The reference has a row for every directive, with synonym, unit and default", "[deck]") {
  const std::string table = directive_reference();
  for (const Directive& d : directives()) {
    const std::size_t row = table.find(fmt::format("| `{}` |", d.words));
    INFO(d.words);
    REQUIRE(row != std::string::npos);
    const std::string line = table.substr(row, table.find('\n', row) - row);
    CHECK(line.find(d.unit) != std::string::npos);
    CHECK(line.find(d.synonyms) != std::string::npos);
    CHECK(line.find(d.meaning) != std::string::npos);
    if (d.mandatory) CHECK(line.find("mandatory") != std::string::npos);
  }
  for (const Foreign& f : foreign_directives())
    CHECK(table.find(fmt::format("| `{}` |", f.words)) != std::string::npos);
  const std::string keys = key_reference();
  for (const ObservableKey& k : observable_keys)
    CHECK(keys.find(fmt::format("| `{}` |", k.key)) != std::string::npos);
}

TEST_CASE("Each way of the Coulomb sum can be named: no value hides behind a longer directive", "[deck]") {
  for (const auto& [line, sum] :
       {std::pair{"coulomb direct", CoulombSum::direct}, std::pair{"coulomb tree", CoulombSum::tree},
        std::pair{"coulomb auto", CoulombSum::automatic}})
    CHECK(parse_deck(altered("", line), name).parameters.coulomb == sum);

  const Parameters both = parse_deck(altered("", "coulomb tree\ncoulomb tree space"), name).parameters;
  CHECK(both.coulomb == CoulombSum::tree);
  CHECK(both.coulomb_tree == TreeOrder::space);
  CHECK_THROWS_WITH(parse_deck(altered("", "coulomb tree spcae"), name), Catch::Contains("space"));
}

TEST_CASE("What a jet held in subdomains cannot do is refused by name", "[deck]") {
  const std::string subdomains = "coulomb tree\nparallel distributed\n";
  CHECK(parse_deck(altered("", subdomains), name).parameters.parallel == ParallelData::distributed);
  for (const auto& [lines, says] :
       {std::pair{"coulomb expansions none", "parallel distributed: expected coulomb expansions local"},
        std::pair{"cutoff 1.", "expected no cutoff"}})
    CHECK_THROWS_WITH(parse_deck(altered("", subdomains + lines), name), Catch::Contains(says));
  const auto adaptive = [&](const std::string& integrator, const std::string& lines) {
    std::string text = altered("timestep 1.d-8", "tolerance 1.d-6\n" + subdomains + lines);
    const std::string was = "integrator 2";
    return parse_deck(text.replace(text.find(was), was.size(), "integrator " + integrator), name).parameters;
  };
  CHECK(adaptive("auto", "").parallel == ParallelData::distributed);
  CHECK(adaptive("kencarp5", "").parallel == ParallelData::distributed);
}

TEST_CASE("parallel auto takes subdomains of five thousand beads and more, where the scene lets it",
          "[deck]") {
  const auto on_two = [](const std::string& lines) {
    return data_of_ranks(parse_deck(altered("points 1", "points 10000\n" + lines), name).parameters, 2);
  };
  CHECK(on_two("parallel auto\ncoulomb auto") == ParallelData::distributed);
  CHECK(on_two("coulomb auto") == ParallelData::replicated);
  CHECK(on_two("parallel auto") == ParallelData::replicated);  // a direct sum
  const Parameters p =
      parse_deck(altered("points 1", "points 10000\nparallel auto\ncoulomb auto"), name).parameters;
  CHECK(data_of_ranks(p, 1) == ParallelData::replicated);
  CHECK(data_of_ranks(p, 3) == ParallelData::replicated);  // 3333 beads a rank
}

TEST_CASE("Each obstacle to subdomains is told alone, and keeps parallel auto from them", "[deck]") {
  const Parameters free =
      parse_deck(altered("points 1", "points 10000\nparallel auto\ncoulomb auto"), name).parameters;
  REQUIRE(obstacles_to_subdomains(free).empty());
  const auto met = [&](auto member, auto value, const char* says) {
    Parameters p = free;
    p.*member = value;
    INFO(says);
    const auto found = obstacles_to_subdomains(p);
    REQUIRE(found.size() == 1);
    CHECK_THAT(found[0].message, Catch::Contains(says));
    CHECK(data_of_ranks(p, 2) == ParallelData::replicated);
  };
  met(&Parameters::system, 1, "system 1");
  met(&Parameters::coulomb, CoulombSum::direct, "direct sum needs all beads");
  met(&Parameters::coulomb_expansions, ExpansionKind::none, "coulomb expansions local");
}

TEST_CASE("No two directives share a spelling, and no two observables a key", "[deck]") {
  std::map<std::string, int> seen;
  for (const Directive& d : directives()) {
    ++seen[std::string(d.words)];
    std::istringstream synonyms{std::string(d.synonyms)};
    for (std::string s; std::getline(synonyms >> std::ws, s, ',');) ++seen[s];
  }
  for (const Foreign& f : foreign_directives()) ++seen[std::string(f.words)];
  for (const ObservableKey& k : observable_keys) ++seen[fmt::format("key {}", k.key)];
  for (const auto& [spelling, times] : seen) {
    INFO(spelling);
    CHECK(times == 1);
  }
}

TEST_CASE("Every synonym in the table is understood", "[deck]") {
  std::string deck = deck_template();
  deck.insert(deck.find("\nexternal potential") + 1, "# ");  // which excludes a vector
  const auto numbers = [](const Directive& d) { return argument(d) == "reals" ? "1. 2. 3." : "1."; };
  for (const Directive& d : directives()) {
    std::istringstream synonyms{std::string(d.synonyms)};
    for (std::string s; std::getline(synonyms >> std::ws, s, ',');) {
      std::string value = d.example.empty() ? value_text(d, Parameters{}) : std::string(d.example);
      if (value.empty()) value = numbers(d);
      INFO(s);
      CHECK(values(parse_deck(deck, "template", {s + " " + value}).parameters) ==
            values(parse_deck(deck, "template", {std::string(d.words) + " " + value}).parameters));
    }
  }
}

TEST_CASE("The edit distance counts insertions, deletions, replacements and swaps", "[deck]") {
  CHECK(edit_distance("", "abc") == 3);
  CHECK(edit_distance("viscosity", "viscosity") == 0);
  CHECK(edit_distance("viscosty", "viscosity") == 1);
  CHECK(edit_distance("huen", "heun") == 1);
  CHECK(edit_distance("kitten", "sitting") == 3);
}

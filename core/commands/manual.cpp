#include "core/commands/manual.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "core/base/lines.hpp"
#include "core/base/version.hpp"
#include "core/deck/directives.hpp"
#include "core/deck/observable_keys.hpp"

namespace treejet {

namespace {

/// Text as roff reads it: minus signs, not hyphens; no commands at the start of a line.
std::string roff(std::string_view text) {
  std::string escaped;
  for (const char c : text) {
    if (c == '\\')
      escaped += "\\e";
    else if (c == '-')
      escaped += "\\-";
    else
      escaped += c;
  }
  return escaped.starts_with('.') || escaped.starts_with('\'') ? "\\&" + escaped : escaped;
}

std::string header(const char* name, int section, const char* what) {
  return fmt::format(".TH {} {} \"\" \"treejet {}\"\n.SH NAME\n{} \\- {}\n", name, section, version().number,
                     name, what);
}

std::string entry(const std::string& term, std::string_view text) {
  return fmt::format(".TP\n.B {}\n{}\n", roff(term), roff(text));
}

}  // namespace

std::string program_manual(const std::vector<CommandHelp>& commands, const std::string& lesson) {
  std::string page = header("treejet", 1, "electrospinning jets as chains of charged viscoelastic beads");
  page += ".SH SYNOPSIS\n";
  for (const CommandHelp& c : commands) page += fmt::format(".B treejet {}\n[options]\n.br\n", c.name);
  page += ".SH DESCRIPTION\n.nf\n";
  for (const std::string_view line : lines_of(lesson)) page += roff(line) + "\n";
  page += ".fi\n";
  for (const CommandHelp& c : commands) {
    page += fmt::format(".SH \"treejet {}\"\n{}.\n", c.name, roff(c.meaning));
    for (const OptionHelp& o : c.options)
      page += entry(o.argument.empty() ? o.name : fmt::format("{} {}", o.name, o.argument), o.meaning);
  }
  return page + ".SH SEE ALSO\n.BR treejet\\-deck (5)\n";
}

std::string deck_manual() {
  std::string page = header("treejet-deck", 5, "the directives of a deck and the keys of its tables");
  page +=
      ".SH DESCRIPTION\nA deck is a text file with a directive a line, in CGS or with a unit behind the "
      "number, comments "
      "from # or ! on, and\n.B finish\nas its last line.\n";
  for (const Directive& d : directives()) {
    if (!d.heading.empty()) page += fmt::format(".SH \"{}\"\n", roff(d.heading));
    const std::string value =
        fmt::format("{} <{}{}{}>", d.words, argument(d), d.unit.empty() ? "" : ", ", d.unit);
    const std::string standard = d.mandatory         ? "mandatory"
                                 : !d.absent.empty() ? std::string(d.absent)
                                 : value_text(d, Parameters{}).empty()
                                     ? "no default"
                                     : "default " + value_text(d, Parameters{});
    page += entry(value, fmt::format("{}; {}", d.meaning, standard));
  }
  page += ".SH OBSERVABLES\nKeys of\n.B print list\nand\n.B printstat list\n";
  for (const ObservableKey& k : observable_keys)
    page += entry(fmt::format("{} [{}]", k.key, k.unit), k.meaning);
  return page + ".SH SEE ALSO\n.BR treejet (1)\n";
}

std::string bash_completion(const std::vector<CommandHelp>& commands) {
  std::vector<std::string> names;
  std::string cases;
  for (const CommandHelp& c : commands) {
    names.push_back(c.name);
    std::vector<std::string> options{"--help"};
    for (const OptionHelp& o : c.options)
      if (o.name.starts_with("--")) options.push_back(o.name);
    cases += fmt::format("    {}) words=\"{}\" ;;\n", c.name, fmt::join(options, " "));
  }
  return fmt::format(R"(# Completion of treejet for bash.
_treejet() {{
  local words word=${{COMP_WORDS[COMP_CWORD]}}
  if [ "$COMP_CWORD" = 1 ]; then
    COMPREPLY=($(compgen -W "{} --help --version" -- "$word"))
    return
  fi
  case ${{COMP_WORDS[1]}} in
{}  esac
  case $word in
    -*) COMPREPLY=($(compgen -W "$words" -- "$word")) ;;
    *) COMPREPLY=($(compgen -f -- "$word")) ;;
  esac
}}
complete -o filenames -F _treejet treejet
)",
                     fmt::join(names, " "), cases);
}

}  // namespace treejet

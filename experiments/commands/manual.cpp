#include "experiments/commands/manual.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <array>
#include <vector>

#include "results/report/citation.h"
#include "terrain/error.h"

namespace terrabench {
namespace {

std::vector<const CLI::App*> commands_of(const CLI::App& app) {
  return app.get_subcommands([](const CLI::App*) { return true; });
}

// "--claims" and "--rows"; of a positional, nothing.
std::vector<std::string> spellings(const CLI::Option& option) {
  std::vector<std::string> all;
  for (const std::string& name : option.get_snames()) all.push_back("-" + name);
  for (const std::string& name : option.get_lnames()) all.push_back("--" + name);
  return all;
}

bool takes_value(const CLI::Option& option) { return option.get_items_expected_max() > 0; }

// "INT in [1 - 4096]" of "INT:INT in [1 - 4096]": what a validator says is more than the type.
std::string value_of(const CLI::Option& option) {
  const std::string type = option.get_type_name();
  return type.substr(type.find(':') + 1);
}

// "quick paper scale" of "{quick,paper,scale}"; of others, nothing.
std::string words_of(const CLI::Option& option) {
  std::string words = value_of(option);
  if (!words.starts_with('{')) return "";
  words = words.substr(1, words.find('}') - 1);
  std::replace(words.begin(), words.end(), ',', ' ');
  return words;
}

// "terrains models" of "A name from `terrabench list terrains` or `list models`"; of others, nothing.
std::string lists_of(const CLI::Option& option) {
  const std::string& help = option.get_description();
  std::string lists;
  for (const std::string_view before : {"from `terrabench list ", "or `list "}) {
    const std::size_t at = help.find(before);
    if (at == help.npos) continue;
    const std::size_t begin = at + before.size();
    lists += (lists.empty() ? "" : " ") + help.substr(begin, help.find('`', begin) - begin);
  }
  return lists;
}

std::string shell_quoted(std::string_view text) {
  std::string all = "'";
  for (const char c : text) all += c == '\'' ? std::string("'\\''") : std::string(1, c);
  return all + "'";
}

// The first sentence, for a line beside the word.
std::string summary(const std::string& help) {
  return help.substr(0, std::min({help.find(". "), help.find("; "), help.find(" (default")}));
}

// ---- man

std::string roff(std::string_view text) {
  std::string all;
  for (const char c : text) {
    // A line that begins so would be a request.
    if ((c == '.' || c == '\'') && (all.empty() || all.back() == '\n')) all += "\\&";
    if (c == '\\') {
      all += "\\e";
    } else if (c == '-') {
      all += "\\-";
    } else {
      all += c;
    }
  }
  return all;
}

std::string page_entry(const CLI::Option& option) {
  std::string head = fmt::format(
      "\\fB{}\\fR", roff(option.get_positional() ? option.get_name(true)
                                                 : fmt::format("{}", fmt::join(spellings(option), ", "))));
  if (takes_value(option)) head += fmt::format(" \\fI{}\\fR", roff(value_of(option)));
  if (const std::string preset = option.get_default_str(); takes_value(option) && !preset.empty())
    head += fmt::format(" (default: {})", roff(preset));
  return fmt::format(".TP\n{}\n{}\n", head, roff(option.get_description()));
}

std::string page_entries(const CLI::App& app) {
  std::string text;
  for (const bool positional : {true, false}) {
    for (const CLI::Option* const option : app.get_options()) {
      if (option->get_positional() == positional) text += page_entry(*option);
    }
  }
  return text;
}

std::string page_section(const CLI::App& command) {
  std::string usage = "terrabench " + command.get_name() + " [OPTIONS]";
  for (const CLI::Option* const option : command.get_options()) {
    if (!option->get_positional()) continue;
    const std::string name = option->get_name(true) + (option->get_expected_max() > 1 ? "..." : "");
    usage += option->get_required() ? " " + name : fmt::format(" [{}]", name);
  }
  std::string text =
      fmt::format(".SS {}\n{}\n{}", roff(usage), roff(command.get_description()), page_entries(command));
  const std::string footer = command.get_footer();
  constexpr std::string_view kExamples = "Examples:\n";
  if (const std::size_t at = footer.find(kExamples); at != footer.npos)
    text += fmt::format(".PP\nExamples:\n.PP\n.EX\n{}\n.EE\n", roff(footer.substr(at + kExamples.size())));
  return text;
}

std::string man(const CLI::App& app) {
  const std::string whole_version = version(), number = whole_version.substr(0, whole_version.find(','));
  const std::string about = app.get_description().substr(std::string_view("terrabench ").size());
  std::string text = fmt::format(
      ".TH TERRABENCH 1 \"\" \"terrabench {}\" \"User commands\"\n.SH NAME\nterrabench \\- {}\n"
      ".SH SYNOPSIS\n.B terrabench\n[OPTIONS] COMMAND [OPTIONS OF THE COMMAND]\n.SH OPTIONS\n{}.SH "
      "COMMANDS\n",
      roff(number), roff(about), page_entries(app));
  for (const CLI::App* const command : commands_of(app)) text += page_section(*command);
  return text +
         fmt::format(
             ".SH EXIT STATUS\n{}\n.SH FILES\nThe pages that options name, such as docs/grounds.md, lie "
             "in the source tree, and installed in /usr/share/doc/terrabench.\n",
             roff(app.get_footer()));
}

// ---- bash

// Prints the names of lists, without "dem:FILE" and the like.
constexpr std::string_view kNames = R"(_terrabench_names() {
  local list
  for list; do terrabench list "$list" 2>/dev/null | sed -n 's/^  \([[:alnum:]][^ :]*\) .*/\1/p'; done
}
)";

// One branch: what may stand where the pattern matches "COMMAND WORD-BEFORE WORD".
std::string bash_branch(const std::string& pattern, std::string words, const std::string& lists) {
  if (lists.find_first_not_of(' ') != lists.npos) words += fmt::format("$(_terrabench_names {})", lists);
  return fmt::format("    {}) words=\"{}\" ;;\n", pattern, words);
}

std::string bash_branches(const CLI::App& command) {
  std::string branches, options, words, lists;
  for (const CLI::Option* const option : command.get_options()) {
    if (option->get_positional()) {
      words += words_of(*option) + " ", lists += lists_of(*option) + " ";
      continue;
    }
    for (const std::string& spelling : spellings(*option)) {
      options += spelling + " ";
      if (!takes_value(*option)) continue;
      branches += bash_branch(fmt::format("'{} {} '*", command.get_name(), spelling), words_of(*option),
                              lists_of(*option));
    }
  }
  return branches + bash_branch(fmt::format("'{} '*' -'*", command.get_name()), options, "") +
         bash_branch(fmt::format("'{} '*", command.get_name()), words, lists);
}

std::string bash(const CLI::App& app) {
  std::string first, branches;
  for (const CLI::Option* const option : app.get_options())
    first += fmt::format("{} ", fmt::join(spellings(*option), " "));
  for (const CLI::App* const command : commands_of(app)) {
    first += command->get_name() + " ";
    branches += bash_branches(*command);
  }
  return fmt::format(R"(# Completion of terrabench for bash, written by `terrabench help --format bash`.
{}_terrabench() {{
  local word=${{COMP_WORDS[COMP_CWORD]}} before=${{COMP_WORDS[COMP_CWORD - 1]}} command='' words='' at
  # --profile=quick is three words.
  if [[ $word == = ]]; then word=''; elif [[ $before == = ]]; then before=${{COMP_WORDS[COMP_CWORD - 2]}}; fi
  for ((at = 1; at < COMP_CWORD; ++at)); do
    if [[ ${{COMP_WORDS[at]}} != -* ]]; then command=${{COMP_WORDS[at]}} && break; fi
  done
  case "$command $before $word" in
{}{}  esac
  mapfile -t COMPREPLY < <(compgen -W "$words" -- "$word")
}}
complete -o bashdefault -o default -F _terrabench terrabench
)",
                     kNames, branches, bash_branch("' '*", first, ""));
}

// ---- zsh

// Of a part of a specification, which brackets and colons divide.
std::string zsh_text(const std::string& text) {
  std::string all;
  for (const char c : text) {
    if (c == '[' || c == ']' || c == ':' || c == '\\') all += '\\';
    all += c;
  }
  return all;
}

// ":MESSAGE:ACTION" for a value.
std::string zsh_value(const CLI::Option& option) {
  const std::string words = words_of(option), lists = lists_of(option);
  std::string action = "_files";
  if (!words.empty()) action = fmt::format("({})", words);
  if (!lists.empty()) action = fmt::format("{{compadd -- $(_terrabench_names {}); _files}}", lists);
  return fmt::format(":{}:{}", option.get_positional() ? option.get_name(true) : "value", action);
}

std::string zsh_specs(const CLI::App& app) {
  std::string specs;
  for (const CLI::Option* const option : app.get_options()) {
    const std::string value = takes_value(*option) ? zsh_value(*option) : "";
    if (option->get_positional()) specs += " \\\n      " + shell_quoted("*" + value);
    for (const std::string& spelling : spellings(*option)) {
      specs += " \\\n      " + shell_quoted(fmt::format("*{}{}[{}]{}", spelling, value.empty() ? "" : "=",
                                                        zsh_text(summary(option->get_description())), value));
    }
  }
  return specs;
}

std::string zsh(const CLI::App& app) {
  std::string commands, branches;
  for (const CLI::App* const command : commands_of(app)) {
    commands +=
        fmt::format("      {}\n", shell_quoted(fmt::format("{}:{}", command->get_name(),
                                                           zsh_text(summary(command->get_description())))));
    branches += fmt::format("    {}) _arguments{} ;;\n", command->get_name(), zsh_specs(*command));
  }
  return fmt::format(R"(#compdef terrabench
# Completion of terrabench for zsh, written by `terrabench help --format zsh`.
{}_terrabench() {{
  local context state state_descr line
  typeset -A opt_args
  _arguments -C{} \
      '1:command:->command' '*::argument:->arguments'
  if [[ $state == command ]]; then
    local -a commands=(
{}    )
    _describe command commands
    return
  fi
  [[ $state == arguments ]] || return
  case $words[1] in
{}  esac
}}
# The first when zsh loads this file as a function, the second when it is sourced.
if [[ $funcstack[1] == _terrabench ]]; then _terrabench "$@"; else compdef _terrabench terrabench; fi
)",
                     kNames, zsh_specs(app), commands, branches);
}

struct Format {
  std::string_view name;
  std::string (*write)(const CLI::App&);
};
constexpr Format kFormats[] = {{"man", man}, {"bash", bash}, {"zsh", zsh}};
constexpr std::array kNamesOfFormats = {kFormats[0].name, kFormats[1].name, kFormats[2].name};

}  // namespace

std::span<const std::string_view> manual_formats() { return kNamesOfFormats; }

std::string manual(const CLI::App& app, std::string_view format) {
  for (const Format& known : kFormats) {
    if (known.name == format) return known.write(app);
  }
  throw unknown_name("format", format, manual_formats());
}

}  // namespace terrabench

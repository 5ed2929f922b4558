// The manual page, and completion of command lines for shells, made from the parser's own description: they
// name what the program accepts, and nothing of them is written by hand.
#pragma once

#include <span>
#include <string>
#include <string_view>

namespace CLI {
class App;
}

namespace terrabench {

// man: a page for man(1), in roff; bash, zsh: a script that the shell reads. Words that an option knows are
// part of a script; names that a list prints are asked from the program when the user completes them.
std::span<const std::string_view> manual_formats();

// The text in one of these formats; throws unknown_name for another. `app` must have its commands.
std::string manual(const CLI::App& app, std::string_view format);

}  // namespace terrabench

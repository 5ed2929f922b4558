#include "experiments/assignments.h"

#include <algorithm>
#include <string_view>

namespace terrabench {

std::vector<std::string> split_assignments(std::span<const std::string> texts,
                                           std::span<const ParameterSpec> specs) {
  std::vector<std::string> all;
  for (const std::string& text : texts) {
    bool first = true, value_is_text = false;
    for (std::string_view rest = text; first || !rest.empty();) {
      const std::string_view part = rest.substr(0, rest.find(','));
      rest.remove_prefix(std::min(part.size() + 1, rest.size()));
      const std::size_t equals = part.find('=');
      const auto spec = std::find_if(specs.begin(), specs.end(), [&](const ParameterSpec& s) {
        return equals != part.npos && s.name == part.substr(0, equals);
      });
      if (first || spec != specs.end() || (equals != part.npos && !value_is_text)) {
        all.emplace_back(part);
        value_is_text = spec != specs.end() && std::holds_alternative<std::string>(spec->fallback);
      } else {
        all.back().append(",").append(part);
      }
      first = false;
    }
  }
  return all;
}

}  // namespace terrabench

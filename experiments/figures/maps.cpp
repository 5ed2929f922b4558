#include "experiments/figures/maps.h"

namespace terrabench::figures {

Image shaded_map(const Heightfield& field, const Light& light, const std::function<Rgb(float)>& colour,
                 double base, double by) {
  Image image(field.width, field.depth, {255, 255, 255});
  for (int j = 0; j < field.depth; ++j) {
    for (int i = 0; i < field.width; ++i) {
      const float height = field.at(i, j);
      if (Heightfield::is_no_data(height)) continue;
      image.set(i, j, lit(colour(height), base + by * light.at(i, j)));
    }
  }
  return image;
}

void PanelGrid::place(Sheet& sheet, int number, std::string_view words, const Image& image) const {
  sheet.text(x(number), y(number) - 8, words, text_size);
  sheet.picture(x(number), y(number), width, height, image);
}

void add_colour_key(Sheet& sheet, double x, double y, std::string_view words, double indent, double width,
                    const std::function<Rgb(double)>& colour, const std::vector<std::string>& labels) {
  std::vector<Sheet::Tick> ticks;
  for (std::size_t k = 0; k < labels.size(); ++k) {
    ticks.push_back({static_cast<double>(k) / static_cast<double>(labels.size() - 1), labels[k]});
  }
  sheet.text(x, y + 11, words, 12);
  sheet.colour_bar(x + indent, y, width, colour, ticks);
}

}  // namespace terrabench::figures

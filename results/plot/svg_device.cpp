#include "results/plot/svg_device.h"

#include <fmt/format.h>
#include <vtkBrush.h>
#include <vtkObjectFactory.h>
#include <vtkPen.h>
#include <vtkRenderingCoreEnums.h>
#include <vtkStdString.h>
#include <vtkTextProperty.h>
#include <vtkTextRenderer.h>

#include <algorithm>
#include <cmath>
#include <string_view>

#include "results/store/format.h"

namespace terrabench {
namespace {

constexpr int kDotsPerInch = 72;  // one font point is one pixel of the picture

// Added to the width of every text, so that charts keep axis titles off the numbers.
constexpr int kRoom = 8;

// Rounded to a hundredth of a pixel, so that equal charts give equal bytes.
std::string number(double value) {
  const double rounded = std::round(value * 100) / 100;
  return fmt::format("{}", rounded == 0 ? 0.0 : rounded);
}

std::string colour(const unsigned char* rgb) {
  return fmt::format("#{:02x}{:02x}{:02x}", rgb[0], rgb[1], rgb[2]);
}

std::string opacity(const char* attribute, unsigned char alpha) {
  return alpha == 255 ? "" : fmt::format(" {}=\"{}\"", attribute, number(alpha / 255.0));
}

}  // namespace

vtkStandardNewMacro(SvgDevice)

    void SvgDevice::start(int width, int height) {
  Geometry[0] = width;
  Geometry[1] = height;
  ViewportSize.Set(width, height);
  ViewportRect.Set(0, 0, width, height);
  body_.clear();
  group_.clear();
  hints_.clear();
  defs_.clear();
  clips_ = 0;
  clipping_ = false;
  matrices_.clear();
  matrix_->Identity();
}

std::string SvgDevice::svg(const std::string& title) const {
  return fmt::format(
      "<svg xmlns=\"http://www.w3.org/2000/svg\" width=\"{0}\" height=\"{1}\" viewBox=\"0 0 {0} {1}\" "
      "role=\"img\">\n"
      "<title>{2}</title>\n<defs>\n{3}</defs>\n<rect width=\"{0}\" height=\"{1}\" fill=\"#ffffff\"/>\n"
      "<g xml:space=\"preserve\" font-family=\"DejaVu Sans, sans-serif\" stroke-linecap=\"round\" "
      "stroke-linejoin=\"round\">\n{4}</g>\n</svg>\n",
      Geometry[0], Geometry[1], escape_html(title), defs_, body_);
}

SvgDevice::Point SvgDevice::place(const float* point) const {
  const double in[3] = {point[0], point[1], 1};
  double out[3];
  matrix_->MultiplyPoint(in, out);
  return {out[0], Geometry[1] - out[1]};
}

void SvgDevice::emit(const std::string& element) {
  constexpr std::string_view kEnd = "</g>\n";
  if (!clipping_) {
    body_ += element + "\n";
    group_.clear();
  } else if (group_ == clip_) {
    body_.insert(body_.size() - kEnd.size(), element + "\n");
  } else {
    body_ += fmt::format("<g clip-path=\"url(#{})\">\n{}\n{}", clip_, element, kEnd);
    group_ = clip_;
  }
}

void SvgDevice::emit_with_hint(const std::string& tag, const std::string& attributes) {
  if (hints_.empty()) return emit(fmt::format("<{}{}/>", tag, attributes));
  emit(fmt::format("<{0}{1}><title>{2}</title></{0}>", tag, attributes, escape_html(hints_.back())));
  hints_.pop_back();
}

std::string SvgDevice::stroke() const {
  const int type = Pen->GetLineType();
  if (type == vtkPen::NO_PEN || Pen->GetColorObject().GetAlpha() == 0) return " stroke=\"none\"";
  const double width = std::max(0.1F, Pen->GetWidth());
  std::string text = fmt::format(" stroke=\"{}\" stroke-width=\"{}\"",
                                 colour(Pen->GetColorObject().GetData()), number(width));
  text += opacity("stroke-opacity", Pen->GetColorObject().GetAlpha());
  const auto dashes = [&](std::initializer_list<double> lengths) {
    std::string list;
    for (const double length : lengths) list += (list.empty() ? "" : ",") + number(length * width);
    text += fmt::format(" stroke-dasharray=\"{}\"", list);
  };
  if (type == vtkPen::DASH_LINE) dashes({4, 3});
  if (type == vtkPen::DOT_LINE || type == vtkPen::DENSE_DOT_LINE) dashes({0.1, 2.5});
  if (type == vtkPen::DASH_DOT_LINE || type == vtkPen::DASH_DOT_DOT_LINE) dashes({4, 3, 0.1, 3});
  return text;
}

std::string SvgDevice::fill() const {
  const unsigned char alpha = Brush->GetColorObject().GetAlpha();
  if (alpha == 0) return " fill=\"none\"";
  return fmt::format(" fill=\"{}\"{}", colour(Brush->GetColorObject().GetData()),
                     opacity("fill-opacity", alpha));
}

std::string SvgDevice::path(const float* points, int n) const {
  std::string text;
  for (int i = 0; i < n; ++i) {
    const Point p = place(points + 2 * i);
    text += fmt::format("{}{} {}", i == 0 ? "M" : "L", number(p.x), number(p.y));
  }
  return text;
}

void SvgDevice::DrawPoly(float* points, int n, unsigned char*, int) {
  if (n > 1) emit(fmt::format("<path d=\"{}\" fill=\"none\"{}/>", path(points, n), stroke()));
}

void SvgDevice::DrawLines(float* points, int n, unsigned char*, int) {
  std::string text;
  for (int i = 0; i + 1 < n; i += 2) text += path(points + 2 * i, 2);
  if (!text.empty()) emit(fmt::format("<path d=\"{}\" fill=\"none\"{}/>", text, stroke()));
}

// VTK passes the marker's size as the pen's width. A white rim separates overlapping markers.
void SvgDevice::DrawMarkers(int shape, bool, float* points, int n, unsigned char*, int) {
  const double r = Pen->GetWidth() / 2;
  const std::string paint = fmt::format(" fill=\"{}\" stroke=\"#ffffff\" stroke-width=\"1\"",
                                        colour(Pen->GetColorObject().GetData()));
  const std::string lines = fmt::format(" fill=\"none\" stroke=\"{}\" stroke-width=\"{}\"",
                                        colour(Pen->GetColorObject().GetData()), number(r / 2));
  for (int i = 0; i < n; ++i) {
    const Point p = place(points + 2 * i);
    // A polygon around p: corners as multiples of the radius.
    const auto outline = [&](std::initializer_list<Point> corners) {
      std::string text;
      for (const Point& c : corners) {
        text +=
            fmt::format("{}{} {}", text.empty() ? "M" : "L", number(p.x + c.x * r), number(p.y + c.y * r));
      }
      return text;
    };
    if (shape == VTK_MARKER_SQUARE) {
      emit_with_hint(
          "path", fmt::format(" d=\"{}Z\"{}", outline({{-.9, -.9}, {.9, -.9}, {.9, .9}, {-.9, .9}}), paint));
    } else if (shape == VTK_MARKER_DIAMOND) {
      emit_with_hint("path", fmt::format(" d=\"{}Z\"{}",
                                         outline({{0, -1.25}, {1.25, 0}, {0, 1.25}, {-1.25, 0}}), paint));
    } else if (shape == VTK_MARKER_CROSS || shape == VTK_MARKER_PLUS) {
      const double a = shape == VTK_MARKER_CROSS ? 0.8 : 0, b = shape == VTK_MARKER_CROSS ? 0.8 : 1.1;
      const std::string one = outline({{-b, -a}, {b, a}});
      emit_with_hint("path", fmt::format(" d=\"{}{}\"{}", one, outline({{-a, b}, {a, -b}}), lines));
    } else {
      emit_with_hint("circle", fmt::format(" cx=\"{}\" cy=\"{}\" r=\"{}\"{}", number(p.x), number(p.y),
                                           number(r), paint));
    }
  }
}

void SvgDevice::DrawQuad(float* points, int n) {
  for (int i = 0; i + 4 <= n; i += 4) DrawColoredPolygon(points + 2 * i, 4, nullptr, 0);
}

void SvgDevice::DrawColoredPolygon(float* points, int n, unsigned char*, int) {
  if (n > 2) emit_with_hint("path", fmt::format(" d=\"{}Z\"{} stroke=\"none\"", path(points, n), fill()));
}

void SvgDevice::DrawString(float* point, const vtkStdString& text) {
  const Point p = place(point);
  const int size = TextProp->GetFontSize();
  constexpr const char* kAnchors[] = {"start", "middle", "end"};
  // From the anchor down to the baseline, in font sizes: a DejaVu Sans capital is 0.73 high, a descender 0.24
  // deep.
  const int vertical = TextProp->GetVerticalJustification();
  const double shift = vertical == VTK_TEXT_TOP ? 0.76 : vertical == VTK_TEXT_CENTERED ? 0.36 : -0.18;
  double rgb[3];
  TextProp->GetColor(rgb);
  unsigned char bytes[3];
  std::transform(rgb, rgb + 3, bytes,
                 [](double c) { return static_cast<unsigned char>(std::lround(c * 255)); });
  const double turn = -TextProp->GetOrientation();
  emit(
      fmt::format("<text transform=\"translate({},{}){}\" y=\"{}\" font-size=\"{}\" text-anchor=\"{}\"{} "
                  "fill=\"{}\">{}</text>",
                  number(p.x), number(p.y), turn == 0 ? "" : fmt::format(" rotate({})", number(turn)),
                  number(shift * size), size, kAnchors[std::clamp(TextProp->GetJustification(), 0, 2)],
                  TextProp->GetBold() != 0 ? " font-weight=\"bold\"" : "", colour(bytes), escape_html(text)));
}

void SvgDevice::ComputeStringBounds(const vtkStdString& text, float bounds[4]) {
  int box[4] = {0, 0, 0, 0};
  std::fill(bounds, bounds + 4, 0.0F);
  if (!vtkTextRenderer::GetInstance()->GetBoundingBox(TextProp, text, box, kDotsPerInch)) return;
  bounds[2] = static_cast<float>(box[1] - box[0] + 1 + kRoom);
  bounds[3] = static_cast<float>(box[3] - box[2] + 1);
}

void SvgDevice::SetColor4(unsigned char color[4]) {
  Pen->SetColor(color);
  Brush->SetColor(color);
}

void SvgDevice::PushMatrix() {
  matrices_.insert(matrices_.end(), matrix_->GetData(), matrix_->GetData() + 9);
}

void SvgDevice::PopMatrix() {
  matrix_->DeepCopy(matrices_.data() + matrices_.size() - 9);
  matrices_.resize(matrices_.size() - 9);
}

void SvgDevice::SetClipping(int* r) {
  clip_ = fmt::format("clip{}", ++clips_);
  defs_ +=
      fmt::format("<clipPath id=\"{}\"><rect x=\"{}\" y=\"{}\" width=\"{}\" height=\"{}\"/></clipPath>\n",
                  clip_, r[0], Geometry[1] - r[1] - r[3], r[2], r[3]);
  clipping_ = true;
}

void SvgDevice::EnableClipping(bool enable) { clipping_ = enable && !clip_.empty(); }

}  // namespace terrabench

// A VTK painting device that writes SVG, so that VTK's charts become vector pictures without a window or
// OpenGL.
#pragma once

#include <vtkContextDevice2D.h>
#include <vtkMatrix3x3.h>
#include <vtkNew.h>
#include <vtkPen.h>
#include <vtkStdString.h>

#include <algorithm>
#include <string>
#include <vector>

namespace terrabench {

// VTK's y points up in device pixels, SVG's down; points are converted on output. Text is real text in DejaVu
// Sans, measured with the same font. Images, textures and math text are not drawn: charts of lines and
// markers use none.
class SvgDevice : public vtkContextDevice2D {
 public:
  static SvgDevice* New();
  vtkTypeMacro(SvgDevice, vtkContextDevice2D)

      void start(int width, int height);  // discards what was painted
  std::string svg(const std::string& title) const;
  // What the markers and filled polygons that are drawn next show under the pointer, one by one; the others
  // show nothing.
  void set_hints(std::vector<std::string> hints) { hints_ = {hints.rbegin(), hints.rend()}; }

  void DrawPoly(float* points, int n, unsigned char* colors, int components) override;
  void DrawLines(float* points, int n, unsigned char* colors, int components) override;
  void DrawMarkers(int shape, bool highlight, float* points, int n, unsigned char* colors,
                   int components) override;
  void DrawQuad(float* points, int n) override;
  void DrawColoredPolygon(float* points, int n, unsigned char* colors, int components) override;
  void DrawString(float* point, const vtkStdString& text) override;
  void ComputeStringBounds(const vtkStdString& text, float bounds[4]) override;
  void ComputeJustifiedStringBounds(const char* text, float bounds[4]) override {
    ComputeStringBounds(vtkStdString(text), bounds);
  }
  void DrawMathTextString(float* point, const vtkStdString& text) override { DrawString(point, text); }
  // VTK demands these, and charts of lines, bars and markers call none of them.
  void DrawPoints(float*, int, unsigned char*, int) override {}
  void DrawPointSprites(vtkImageData*, float*, int, unsigned char*, int) override {}
  void DrawEllipseWedge(float, float, float, float, float, float, float, float) override {}
  void DrawEllipticArc(float, float, float, float, float, float) override {}
  void DrawString(float*, const vtkUnicodeString&) override {}
  void ComputeStringBounds(const vtkUnicodeString&, float bounds[4]) override {
    std::fill_n(bounds, 4, 0.0F);
  }
  void DrawImage(float[2], float, vtkImageData*) override {}
  void DrawImage(const vtkRectf&, vtkImageData*) override {}
  void SetTexture(vtkImageData*, int) override {}
  void SetColor4(unsigned char color[4]) override;
  void SetPointSize(float size) override { Pen->SetWidth(size); }
  void SetLineWidth(float width) override { Pen->SetWidth(width); }
  void SetLineType(int type) override { Pen->SetLineType(type); }
  void SetMatrix(vtkMatrix3x3* matrix) override { matrix_->DeepCopy(matrix); }
  void GetMatrix(vtkMatrix3x3* matrix) override { matrix->DeepCopy(matrix_); }
  void MultiplyMatrix(vtkMatrix3x3* matrix) override { vtkMatrix3x3::Multiply3x3(matrix_, matrix, matrix_); }
  void PushMatrix() override;
  void PopMatrix() override;
  void SetClipping(int* rectangle) override;
  void EnableClipping(bool enable) override;

 protected:
  SvgDevice() = default;
  ~SvgDevice() override = default;

 private:
  struct Point {
    double x, y;
  };
  Point place(const float* point) const;  // scene to SVG
  std::string stroke() const;
  std::string fill() const;
  std::string path(const float* points, int n) const;
  void emit(const std::string& element);
  void emit_with_hint(const std::string& tag, const std::string& attributes);

  std::string body_, defs_, clip_;
  std::vector<std::string> hints_;  // the next is the last
  std::string group_;               // the clip of the group that ends body_; empty: no group does
  int clips_ = 0;
  bool clipping_ = false;
  std::vector<double> matrices_;  // nine each
  vtkNew<vtkMatrix3x3> matrix_;
};

}  // namespace terrabench

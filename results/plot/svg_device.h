// A VTK painting device that writes SVG, so that VTK's charts become vector pictures without a window or
// OpenGL.
#pragma once

#include <vtkContextDevice2D.h>
#include <vtkMatrix3x3.h>
#include <vtkNew.h>

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

  void DrawPoly(float* points, int n, unsigned char* colors, int components) override;
  void DrawLines(float* points, int n, unsigned char* colors, int components) override;
  void DrawPoints(float* points, int n, unsigned char* colors, int components) override;
  void DrawPointSprites(vtkImageData*, float* points, int n, unsigned char* colors, int components) override;
  void DrawMarkers(int shape, bool highlight, float* points, int n, unsigned char* colors,
                   int components) override;
  void DrawQuad(float* points, int n) override;
  void DrawColoredPolygon(float* points, int n, unsigned char* colors, int components) override;
  void DrawEllipseWedge(float x, float y, float outer_x, float outer_y, float inner_x, float inner_y,
                        float start, float stop) override;
  void DrawEllipticArc(float x, float y, float radius_x, float radius_y, float start, float stop) override;
  void DrawString(float* point, const vtkStdString& text) override;
  void DrawString(float* point, const vtkUnicodeString& text) override;
  void ComputeStringBounds(const vtkStdString& text, float bounds[4]) override;
  void ComputeStringBounds(const vtkUnicodeString& text, float bounds[4]) override;
  void ComputeJustifiedStringBounds(const char* text, float bounds[4]) override;
  void DrawMathTextString(float* point, const vtkStdString& text) override;
  void DrawImage(float[2], float, vtkImageData*) override {}
  void DrawImage(const vtkRectf&, vtkImageData*) override {}
  void SetColor4(unsigned char color[4]) override;
  void SetTexture(vtkImageData*, int) override {}
  void SetPointSize(float size) override;
  void SetLineWidth(float width) override;
  void SetLineType(int type) override;
  void SetMatrix(vtkMatrix3x3* matrix) override;
  void GetMatrix(vtkMatrix3x3* matrix) override;
  void MultiplyMatrix(vtkMatrix3x3* matrix) override;
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

  std::string body_, defs_, clip_;
  std::string group_;  // the clip of the group that ends body_; empty: no group does
  int clips_ = 0;
  bool clipping_ = false;
  std::vector<double> matrices_;  // nine each
  vtkNew<vtkMatrix3x3> matrix_;
};

}  // namespace terrabench

// SPDX-License-Identifier: GPL-3.0-or-later
#include "editor/viewport/layer.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <cstring>
#include <string>

#include <vtkCellArray.h>
#include <vtkCellData.h>
#include <vtkFloatArray.h>
#include <vtkIdTypeArray.h>
#include <vtkPlane.h>
#include <vtkPointData.h>
#include <vtkPoints.h>
#include <vtkProperty.h>
#include <vtkShaderProperty.h>
#include <vtkUniforms.h>
#include <vtkUnsignedCharArray.h>

namespace standpoint {

namespace {

vtkSmartPointer<vtkPoints> pointsOf(const std::vector<float>& positions) {
  vtkNew<vtkFloatArray> array;
  array->SetNumberOfComponents(3);
  array->SetNumberOfTuples(static_cast<vtkIdType>(positions.size() / 3));
  if (!positions.empty()) std::memcpy(array->GetPointer(0), positions.data(), positions.size() * sizeof(float));
  auto points = vtkSmartPointer<vtkPoints>::New();
  points->SetData(array);
  return points;
}

vtkSmartPointer<vtkCellArray> cellsOf(const std::vector<std::int64_t>& indices, vtkIdType size) {
  vtkNew<vtkTypeInt64Array> array;
  array->SetNumberOfTuples(static_cast<vtkIdType>(indices.size()));
  if (!indices.empty()) std::memcpy(array->GetPointer(0), indices.data(), indices.size() * sizeof(std::int64_t));
  auto cells = vtkSmartPointer<vtkCellArray>::New();
  cells->SetData(size, array);
  return cells;
}

vtkSmartPointer<vtkUnsignedCharArray> coloursOf(const std::vector<Rgba>& colours) {
  auto array = vtkSmartPointer<vtkUnsignedCharArray>::New();
  array->SetNumberOfComponents(4);
  array->SetNumberOfTuples(static_cast<vtkIdType>(colours.size()));
  if (!colours.empty()) std::memcpy(array->GetPointer(0), colours.data(), colours.size() * sizeof(Rgba));
  return array;
}

// What VTK computes for distant lights, without the highlights, which a surface here has none of: they take a processor
// that draws a third of a picture, though they come out as 0.
std::string diffuseLight() {
  std::string code = "  vec3 diffuse = vec3(0,0,0);\n";
  for (int i = 0; i < kLights; ++i) {
    const std::string n = std::to_string(i);
    code += "  diffuse += (max(0.0, dot(normalVCVSOutput, -lightDirectionVC" + n + ")) * lightColor" + n + ");\n";
  }
  return code +
         "  diffuse = diffuse * diffuseColor;\n"
         "  gl_FragData[0] = vec4(ambientColor + diffuse, opacity);\n";
}

// What coincides is told apart by depths that differ by so many units of 1/65000. VTK itself would add them to each
// pixel's: a processor then has to shade what is hidden before it knows that. Here they are added to the corners.
// As a uniform, so that one program draws them all.
void shiftDepths(vtkShaderProperty& shader, double units) {
  constexpr double kUnits = 65000, kDepthsInClipSpace = 2;  // of the whole range
  shader.ClearAllVertexShaderReplacements();
  shader.AddVertexShaderReplacement("//VTK::PositionVC::Impl", true,
                                    "//VTK::PositionVC::Impl\n  gl_Position.z += depthShift * gl_Position.w;\n", false);
  shader.GetVertexCustomUniforms()->SetUniformf("depthShift", static_cast<float>(kDepthsInClipSpace * units / kUnits));
}

}  // namespace

void Layer::light(bool wanted) {
  if (lit == wanted) return;  // a shader that is said anew is compiled anew
  lit = wanted;
  actor->GetProperty()->SetLighting(wanted);
  auto* shader = actor->GetShaderProperty();
  shader->ClearAllFragmentShaderReplacements();
  if (!wanted) return;
  shader->AddFragmentShaderReplacement("//VTK::Light::Impl", true, diffuseLight(), false);
  // For the same reason; nothing that is lit is invisible.
  shader->AddFragmentShaderReplacement("if (gl_FragData[0].a <= 0.0)", true, "if (false)", false);
}

void Layer::drawSurface(double offset) {
  auto* property = actor->GetProperty();
  property->SetInterpolationToFlat();
  property->SetAmbient(0.34);
  property->SetDiffuse(0.78);
  property->SetSpecular(0);
  light(true);
  mapper->SetColorModeToDirectScalars();
  shiftDepths(*actor->GetShaderProperty(), offset);
}

void Layer::drawLines(std::array<double, 3> colour, double opacity, double width) {
  auto* property = actor->GetProperty();
  light(false);
  property->SetColor(colour.data());
  property->SetOpacity(opacity);
  property->SetLineWidth(static_cast<float>(width));
  constexpr double kBeforeSurfaces = -4;
  shiftDepths(*actor->GetShaderProperty(), kBeforeSurfaces);
}

void Layer::show(const MergedTriangles& triangles) {
  vtkNew<vtkPolyData> data;
  data->SetPoints(pointsOf(triangles.positions));
  data->SetPolys(cellsOf(triangles.corners, 3));
  if (triangles.graded)
    data->GetPointData()->SetScalars(coloursOf(triangles.colours));
  else
    data->GetCellData()->SetScalars(coloursOf(triangles.colours));
  if (triangles.graded)
    mapper->SetScalarModeToUsePointData();
  else
    mapper->SetScalarModeToUseCellData();
  set(data, triangles.colours.empty());
}

void Layer::show(const PaintedTriangles& painted, vtkTexture* texture) {
  show(painted.triangles);
  vtkNew<vtkFloatArray> coordinates;
  coordinates->SetNumberOfComponents(2);
  coordinates->SetNumberOfTuples(static_cast<vtkIdType>(painted.coordinates.size() / 2));
  if (!painted.coordinates.empty())
    std::memcpy(coordinates->GetPointer(0), painted.coordinates.data(), painted.coordinates.size() * sizeof(float));
  vtkPolyData::SafeDownCast(mapper->GetInput())->GetPointData()->SetTCoords(coordinates);
  actor->SetTexture(texture);
  light(!painted.unlit);
}

void Layer::show(const MergedLines& lines) {
  vtkNew<vtkPolyData> data;
  data->SetPoints(pointsOf(lines.positions));
  data->SetLines(cellsOf(lines.ends, 2));
  set(data, lines.ends.empty());
}

void Layer::set(vtkPolyData* data, bool empty) {
  mapper->SetInputData(data);
  actor->SetMapper(mapper);
  filled = !empty;
  reveal(true);
}

void Layer::cut(const std::vector<ClipPlane>& kept) {
  if (cut_by == kept) return;
  cut_by = kept;
  mapper->RemoveAllClippingPlanes();
  for (const auto& [point, inward] : kept) {
    vtkNew<vtkPlane> plane;
    plane->SetOrigin(point.x(), point.y(), point.z());
    plane->SetNormal(inward.x(), inward.y(), inward.z());
    mapper->AddClippingPlane(plane);
  }
}

void Layer::paint(const std::vector<Rgba>& colours) {
  if (!colours.empty()) mapper->GetInput()->GetCellData()->SetScalars(coloursOf(colours));
}

double groundHeight_m(const Bounds& bounds) { return bounds.min.z() - 0.02; }

vtkSmartPointer<vtkPolyData> groundGrid(const Bounds& bounds, Theme theme) {
  const double reach =
      std::max(4.0, 0.9 * std::hypot(bounds.max.x() - bounds.min.x(), bounds.max.y() - bounds.min.y()));
  const double step = std::pow(10.0, std::max(0.0, std::floor(std::log10(reach / 8))));
  const Eigen::Vector3d centre = (bounds.min + bounds.max) / 2;
  const double cx = std::round(centre.x() / step) * step, cy = std::round(centre.y() / step) * step,
               z = groundHeight_m(bounds);
  const int lines = static_cast<int>(std::ceil(reach / step));
  const std::array<unsigned char, 3> tone =
      theme == Theme::light ? std::array<unsigned char, 3>{92, 102, 118} : std::array<unsigned char, 3>{150, 162, 180};
  constexpr int kParts = 40;  // of a line, so that each can have its own strength
  vtkNew<vtkPoints> points;
  vtkNew<vtkCellArray> cells;
  vtkNew<vtkUnsignedCharArray> colours;
  colours->SetNumberOfComponents(4);
  for (int axis = 0; axis < 2; ++axis)
    for (int i = -lines; i <= lines; ++i)
      for (int part = 0; part <= kParts; ++part) {
        const double across = i * step, along = (2.0 * part / kParts - 1) * lines * step;
        const double x = axis == 0 ? across : along, y = axis == 0 ? along : across;
        const auto id = points->InsertNextPoint(cx + x, cy + y, z);
        const double fade = std::clamp(1 - std::hypot(x, y) / (lines * step), 0.0, 1.0);
        const auto absolute = std::lround(((axis == 0 ? cx : cy) + across) / step);
        const double strength = absolute % 10 == 0 ? 150 : 70;
        const unsigned char rgba[4] = {tone[0], tone[1], tone[2], static_cast<unsigned char>(strength * fade)};
        colours->InsertNextTypedTuple(rgba);
        if (part == 0) continue;
        const vtkIdType ends[2] = {id - 1, id};
        cells->InsertNextCell(2, ends);
      }
  auto data = vtkSmartPointer<vtkPolyData>::New();
  data->SetPoints(points);
  data->SetLines(cells);
  data->GetPointData()->SetScalars(colours);
  return data;
}

}  // namespace standpoint

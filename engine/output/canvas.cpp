#include "engine/output/canvas.h"

#include <algorithm>
#include <utility>

#include <fmt/format.h>
#include <vtkCamera.h>
#include <vtkDataSetSurfaceFilter.h>
#include <vtkImageShrink3D.h>
#include <vtkLightKit.h>
#include <vtkPlane.h>
#include <vtkPolyData.h>
#include <vtkPolyDataMapper.h>
#include <vtkProperty.h>
#include <vtkScalarBarActor.h>
#include <vtkTableBasedClipDataSet.h>
#include <vtkTextProperty.h>
#include <vtkWindowToImageFilter.h>

#include "engine/output/camera.h"

namespace scree::output {

namespace {

// The picture is drawn this many times as wide and high and averaged: thin edges come out smooth on any graphics driver.
constexpr int oversampling = 2;
constexpr double legend_width = 0.17;  // of the picture

vtkSmartPointer<vtkActor> make_surface(vtkUnstructuredGrid& grid, const Picture& picture, vtkScalarsToColors& colours) {
  vtkNew<vtkDataSetSurfaceFilter> surface;
  vtkNew<vtkTableBasedClipDataSet> clip;
  surface->SetInputData(&grid);
  if (picture.cut) {
    vtkNew<vtkPlane> plane;
    plane->SetOrigin(0, *picture.cut, 0);
    plane->SetNormal(0, 1, 0);
    clip->SetInputData(&grid);
    clip->SetClipFunction(plane);
    surface->SetInputConnection(clip->GetOutputPort());
  }
  vtkNew<vtkPolyDataMapper> mapper;
  mapper->SetInputConnection(surface->GetOutputPort());
  mapper->SetLookupTable(&colours);
  mapper->UseLookupTableScalarRangeOn();
  mapper->InterpolateScalarsBeforeMappingOn();
  auto actor = vtkSmartPointer<vtkActor>::New();
  actor->SetMapper(mapper);
  vtkProperty& look = *actor->GetProperty();
  look.SetInterpolationToFlat();
  look.SetEdgeVisibility(picture.lines ? 0 : 1);
  look.SetEdgeColor(0.25, 0.23, 0.27);
  look.SetLineWidth(oversampling * (picture.lines ? 1.8F : 0.5F));
  look.SetPointSize(oversampling * 3.0F);
  look.SetLighting(!picture.lines);
  look.SetAmbient(0.25);
  look.SetDiffuse(0.78);
  return actor;
}

void set_up_text(vtkTextProperty& text, int size) {
  text.SetFontFamilyToArial();
  text.SetFontSize(oversampling * size);
  text.SetColor(0.1, 0.1, 0.12);
  text.BoldOff();
  text.ItalicOff();
  text.ShadowOff();
}

vtkSmartPointer<vtkScalarBarActor> make_legend(const Picture& picture, vtkScalarsToColors& colours) {
  auto legend = vtkSmartPointer<vtkScalarBarActor>::New();
  legend->SetLookupTable(&colours);
  legend->SetTitle((picture.title.empty() ? picture.array : picture.title).c_str());
  legend->SetNumberOfLabels(6);
  legend->SetLabelFormat("%.4g");
  legend->UnconstrainedFontSizeOn();
  legend->SetBarRatio(0.2);
  legend->SetTextPad(oversampling * 4);
  legend->SetVerticalTitleSeparation(oversampling * 14);
  set_up_text(*legend->GetTitleTextProperty(), 17);
  set_up_text(*legend->GetLabelTextProperty(), 15);
  legend->SetPosition(0.1, 0.2);
  legend->SetWidth(0.8);
  legend->SetHeight(0.6);
  return legend;
}

std::string time_stamp(double time) {
  if (time < 600) return fmt::format("t = {:.4g} s", time);
  if (time < 3 * 3600) return fmt::format("t = {:.4g} min", time / 60);
  return fmt::format("t = {:.4g} h", time / 3600);
}

vtkSmartPointer<vtkTextActor> make_stamp(double time) {
  auto stamp = vtkSmartPointer<vtkTextActor>::New();
  stamp->SetInput(time_stamp(time).c_str());
  set_up_text(*stamp->GetTextProperty(), 19);
  stamp->SetPosition(oversampling * 24, oversampling * 22);
  return stamp;
}

void place(vtkCamera& target, const std::vector<Eigen::Vector3d>& points, const Picture& picture, double scene_width) {
  const Lens lens{.aspect = scene_width * picture.width / picture.height};
  const auto [low, high] =
      std::minmax_element(points.begin(), points.end(), [](const auto& a, const auto& b) { return a.z() < b.z(); });
  const bool flat = low->z() == high->z();
  Eigen::Vector3d back(0.42, -1, 0.55);
  if (picture.cut) back = {0.2, -1, 0.3};  // to look at the cut, not along it
  const Camera camera = flat ? aim(points, Eigen::Vector3d::UnitZ(), Eigen::Vector3d::UnitY(), lens)
                             : aim(points, back, Eigen::Vector3d::UnitZ(), lens);
  target.SetFocalPoint(camera.focus.data());
  target.SetPosition(camera.eye.data());
  target.SetViewUp(camera.up.data());
  target.SetViewAngle(lens.angle);
}

}  // namespace

Canvas::Canvas(const Picture& picture, Colouring colouring, const std::vector<Eigen::Vector3d>& points)
    : picture_(picture), colouring_(std::move(colouring)) {
  const double width = colouring_.legend ? 1 - legend_width : 1;
  scene_->SetBackground(1, 1, 1);
  scene_->SetViewport(0, 0, width, 1);
  place(*scene_->GetActiveCamera(), points, picture, width);
  // White light: the legend's colours are to be found on the blocks.
  vtkNew<vtkLightKit> lights;
  lights->SetKeyLightWarmth(0.5);
  lights->SetFillLightWarmth(0.5);
  lights->SetKeyLightIntensity(0.9);
  lights->AddLightsToRenderer(scene_);
  side_->SetBackground(1, 1, 1);
  side_->SetViewport(width, 0, 1, 1);
  side_->AddActor2D(make_legend(picture, *colouring_.colours));
  window_->SetOffScreenRendering(1);
  window_->SetMultiSamples(0);
  window_->SetSize(oversampling * picture.width, oversampling * picture.height);
  window_->AddRenderer(scene_);
  if (colouring_.legend) window_->AddRenderer(side_);
}

vtkSmartPointer<vtkImageData> Canvas::draw(const ShownFrame& frame) {
  if (blocks_) {
    scene_->RemoveActor(blocks_);
    scene_->RemoveActor2D(stamp_);
  }
  blocks_ = make_surface(*frame.grid, picture_, *colouring_.colours);
  stamp_ = make_stamp(frame.time);
  scene_->AddActor(blocks_);
  scene_->AddActor2D(stamp_);
  scene_->ResetCameraClippingRange();
  window_->Render();
  vtkNew<vtkWindowToImageFilter> image;
  image->SetInput(window_);
  image->SetInputBufferTypeToRGB();
  image->ReadFrontBufferOff();
  vtkNew<vtkImageShrink3D> average;
  average->SetInputConnection(image->GetOutputPort());
  average->SetShrinkFactors(oversampling, oversampling, 1);
  average->AveragingOn();
  average->Update();
  return average->GetOutput();
}

}  // namespace scree::output

#include "engine/output/render.h"

#include <algorithm>
#include <cmath>
#include <utility>
#include <vector>

#include <fmt/format.h>
#include <vtkActor.h>
#include <vtkCamera.h>
#include <vtkCellData.h>
#include <vtkColorSeries.h>
#include <vtkColorTransferFunction.h>
#include <vtkDataSetSurfaceFilter.h>
#include <vtkDoubleArray.h>
#include <vtkErrorCode.h>
#include <vtkImageShrink3D.h>
#include <vtkLightKit.h>
#include <vtkLookupTable.h>
#include <vtkNew.h>
#include <vtkPNGWriter.h>
#include <vtkPlane.h>
#include <vtkPointData.h>
#include <vtkPolyData.h>
#include <vtkPolyDataMapper.h>
#include <vtkProperty.h>
#include <vtkRenderWindow.h>
#include <vtkRenderer.h>
#include <vtkScalarBarActor.h>
#include <vtkSmartPointer.h>
#include <vtkTableBasedClipDataSet.h>
#include <vtkTextActor.h>
#include <vtkTextProperty.h>
#include <vtkUnstructuredGrid.h>
#include <vtkWindowToImageFilter.h>
#include <vtkXMLUnstructuredGridReader.h>

#include "engine/base/atomic_file.h"
#include "engine/base/check.h"
#include "engine/output/camera.h"
#include "engine/output/offscreen_display.h"
#include "engine/output/series_index.h"

namespace scree::output {

namespace {

// The picture is drawn this many times as wide and high and averaged: thin edges come out smooth on any graphics driver.
constexpr int oversampling = 2;
constexpr double legend_width = 0.17;  // of the picture

struct Colouring {
  vtkSmartPointer<vtkScalarsToColors> colours;
  bool legend = true;
};

SeriesEntry choose_frame(const Picture& picture) {
  const auto entries = read_index(picture.series);
  if (entries.empty()) throw RunError(fmt::format("{}: has no frame to draw", picture.series.string()));
  if (!picture.time) return entries.back();
  return *std::min_element(entries.begin(), entries.end(), [&](const SeriesEntry& a, const SeriesEntry& b) {
    return std::abs(a.time - *picture.time) < std::abs(b.time - *picture.time);
  });
}

vtkSmartPointer<vtkUnstructuredGrid> read_frame(const std::filesystem::path& file) {
  vtkNew<vtkXMLUnstructuredGridReader> reader;
  reader->SetFileName(file.c_str());
  reader->Update();
  if (reader->GetErrorCode() != vtkErrorCode::NoError) {
    throw RunError(
        fmt::format("{}: could not be read ({})", file.string(), vtkErrorCode::GetStringFromErrorCode(reader->GetErrorCode())));
  }
  return reader->GetOutput();
}

std::string array_names(vtkUnstructuredGrid& grid) {
  std::string names;
  for (vtkDataSetAttributes* data : std::initializer_list<vtkDataSetAttributes*>{grid.GetPointData(), grid.GetCellData()}) {
    for (int i = 0; i < data->GetNumberOfArrays(); ++i) {
      names += fmt::format("{}{}", names.empty() ? "" : ", ", data->GetArrayName(i));
    }
  }
  return names;
}

// Makes the wanted array the scalars of the grid, with the offset added, and returns it. Vectors are drawn by their length.
vtkDataArray* select_array(vtkUnstructuredGrid& grid, const Picture& picture) {
  for (vtkDataSetAttributes* data : std::initializer_list<vtkDataSetAttributes*>{grid.GetPointData(), grid.GetCellData()}) {
    vtkDataArray* array = data->GetArray(picture.array.c_str());
    if (array == nullptr) continue;
    if (array->GetDataType() == VTK_DOUBLE) {
      vtkNew<vtkDoubleArray> shown;
      shown->SetName("shown");
      shown->SetNumberOfValues(array->GetNumberOfTuples());
      std::vector<double> tuple(array->GetNumberOfComponents());
      for (vtkIdType i = 0; i < array->GetNumberOfTuples(); ++i) {
        array->GetTuple(i, tuple.data());
        const double length = std::hypot(tuple[0], tuple.size() > 1 ? tuple[1] : 0, tuple.size() > 2 ? tuple[2] : 0);
        shown->SetValue(i, (tuple.size() == 1 ? tuple[0] : length) + picture.offset);
      }
      data->SetScalars(shown);
    } else {
      data->SetScalars(array);
    }
    return data->GetScalars();
  }
  Problem problem;
  problem.key = "array";
  problem.value = picture.array;
  problem.rule = "one of " + array_names(grid);
  throw InputError(std::move(problem));
}

Colouring make_colours(vtkDataArray& array, const Picture& picture) {
  if (array.GetDataType() != VTK_DOUBLE) {
    vtkNew<vtkColorSeries> series;
    series->SetColorScheme(vtkColorSeries::BREWER_QUALITATIVE_SET2);
    auto table = vtkSmartPointer<vtkLookupTable>::New();
    const int last = std::max(1, static_cast<int>(array.GetRange()[1]));
    table->SetNumberOfTableValues(last + 1);
    table->SetTableRange(0, last);
    for (int i = 0; i <= last; ++i) {
      const vtkColor3ub colour = series->GetColorRepeating(i);
      table->SetTableValue(i, colour.GetRed() / 255.0, colour.GetGreen() / 255.0, colour.GetBlue() / 255.0);
    }
    return {table, false};
  }
  std::array<double, 2> range{array.GetRange()[0], array.GetRange()[1]};
  if (picture.range) range = *picture.range;
  if (!(range[1] > range[0])) range[1] = range[0] + 1;
  // Cold rock is dark blue, hot rock glows; the lightness rises all the way, so that it also reads in grey.
  auto glow = vtkSmartPointer<vtkColorTransferFunction>::New();
  glow->SetColorSpaceToLab();
  const auto add = [&](double at, double r, double g, double b) {
    glow->AddRGBPoint(range[0] + at * (range[1] - range[0]), r, g, b);
  };
  add(0, 0.22, 0.28, 0.56);
  add(0.3, 0.55, 0.30, 0.60);
  add(0.6, 0.85, 0.33, 0.32);
  add(0.8, 0.97, 0.60, 0.24);
  add(1, 1.00, 0.92, 0.60);
  return {glow, true};
}

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
  look.EdgeVisibilityOn();
  look.SetEdgeColor(0.25, 0.23, 0.27);
  look.SetLineWidth(oversampling * 0.5F);
  look.SetPointSize(oversampling * 3.0F);
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

// Points the camera must see: what is drawn of the grid inside the view.
std::vector<Eigen::Vector3d> points_in_view(vtkUnstructuredGrid& grid, const Picture& picture) {
  std::vector<Eigen::Vector3d> points;
  for (vtkIdType i = 0; i < grid.GetNumberOfPoints(); ++i) {
    const Eigen::Vector3d point(grid.GetPoint(i));
    if (picture.view && !picture.view->contains(point)) continue;
    if (!picture.cut || point.y() >= *picture.cut) points.push_back(point);
  }
  if (points.empty()) throw RunError(fmt::format("{}: there is nothing in the view to draw", picture.series.string()));
  return points;
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

vtkSmartPointer<vtkRenderer> make_scene(vtkUnstructuredGrid& grid, const Picture& picture, vtkScalarsToColors& colours,
                                        double width) {
  auto scene = vtkSmartPointer<vtkRenderer>::New();
  scene->SetBackground(1, 1, 1);
  scene->SetViewport(0, 0, width, 1);
  scene->AddActor(make_surface(grid, picture, colours));
  place(*scene->GetActiveCamera(), points_in_view(grid, picture), picture, width);
  scene->ResetCameraClippingRange();
  // White light: the legend's colours are to be found on the blocks.
  vtkNew<vtkLightKit> lights;
  lights->SetKeyLightWarmth(0.5);
  lights->SetFillLightWarmth(0.5);
  lights->SetKeyLightIntensity(0.9);
  lights->AddLightsToRenderer(scene);
  return scene;
}

void save(vtkRenderWindow& window, const std::filesystem::path& png) {
  vtkNew<vtkWindowToImageFilter> image;
  image->SetInput(&window);
  image->SetInputBufferTypeToRGB();
  image->ReadFrontBufferOff();
  vtkNew<vtkImageShrink3D> average;
  average->SetInputConnection(image->GetOutputPort());
  average->SetShrinkFactors(oversampling, oversampling, 1);
  average->AveragingOn();
  write_atomically(png, [&](const std::filesystem::path& temporary) {
    vtkNew<vtkPNGWriter> writer;
    writer->SetInputConnection(average->GetOutputPort());
    writer->SetFileName(temporary.c_str());
    writer->Write();
    if (writer->GetErrorCode() != vtkErrorCode::NoError) {
      throw RunError(fmt::format("{}: could not be written ({})", png.string(),
                                 vtkErrorCode::GetStringFromErrorCode(writer->GetErrorCode())));
    }
  });
}

}  // namespace

void render(const Picture& picture, const std::filesystem::path& png) {
  const SeriesEntry frame = choose_frame(picture);
  const auto grid = read_frame(picture.series.parent_path() / frame.file);
  const Colouring colouring = make_colours(*select_array(*grid, picture), picture);

  const double scene_width = colouring.legend ? 1 - legend_width : 1;
  const auto scene = make_scene(*grid, picture, *colouring.colours, scene_width);
  scene->AddActor2D(make_stamp(frame.time));
  vtkNew<vtkRenderer> side;
  side->SetBackground(1, 1, 1);
  side->SetViewport(scene_width, 0, 1, 1);
  side->AddActor2D(make_legend(picture, *colouring.colours));

  const OffscreenDisplay display;  // outlives the window
  vtkNew<vtkRenderWindow> window;
  window->SetOffScreenRendering(1);
  window->SetMultiSamples(0);
  window->SetSize(oversampling * picture.width, oversampling * picture.height);
  window->AddRenderer(scene);
  if (colouring.legend) window->AddRenderer(side);
  window->Render();
  save(*window, png);
}

}  // namespace scree::output

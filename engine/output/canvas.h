// A picture being drawn, again and again for an animation; for this room only.
#pragma once

#include <vector>

#include <vtkActor.h>
#include <vtkImageData.h>
#include <vtkNew.h>
#include <vtkRenderWindow.h>
#include <vtkRenderer.h>
#include <vtkTextActor.h>

#include "engine/output/colouring.h"
#include "engine/output/offscreen_display.h"
#include "engine/output/shown_frame.h"

namespace scree::output {

class Canvas {
 public:
  // The camera sees all `points`; 3-D is seen from above at an angle, from the side of negative y, 2-D from the front.
  Canvas(const Picture& picture, Colouring colouring, const std::vector<Eigen::Vector3d>& points);

  // The frame as an image in RGB, bottom row first.
  vtkSmartPointer<vtkImageData> draw(const ShownFrame& frame);

 private:
  const Picture& picture_;
  Colouring colouring_;
  OffscreenDisplay display_;  // outlives the window
  vtkNew<vtkRenderWindow> window_;
  vtkNew<vtkRenderer> scene_;
  vtkNew<vtkRenderer> side_;  // of the legend
  vtkSmartPointer<vtkActor> blocks_;
  vtkSmartPointer<vtkTextActor> stamp_;
};

}  // namespace scree::output

#include "engine/output/render.h"

#include <algorithm>
#include <cmath>
#include <vector>

#include <fmt/format.h>
#include <vtkErrorCode.h>
#include <vtkNew.h>
#include <vtkPNGWriter.h>
#include <vtkUnsignedCharArray.h>

#include "engine/base/atomic_file.h"
#include "engine/base/check.h"
#include "engine/output/canvas.h"
#include "engine/output/video.h"
#include "engine/output/vtk_room.h"

namespace scree::output {

namespace {

// Unless told how long an animation is. Fewer frames in a second are a slide show.
constexpr double usual_duration = 10;  // [s]
constexpr double fewest_per_second = 2;
constexpr double most_per_second = 15;  // whatever is told
// Of the flows of contacts, the part that the legend of lines spans: the strongest few would make all others look cold.
constexpr double shown_part = 0.98;
constexpr std::size_t points_per_frame = 5000;  // that the camera of an animation looks at

using Range = std::array<double, 2>;

std::vector<SeriesEntry> frames_of(const Picture& picture) {
  auto entries = read_index(picture.series);
  if (entries.empty()) throw RunError(fmt::format("{}: has no frame to draw", picture.series.string()));
  return entries;
}

SeriesEntry choose_frame(const Picture& picture) {
  const auto entries = frames_of(picture);
  if (!picture.time) return entries.back();
  const double first = entries.front().time, last = entries.back().time;
  const double interval = (last - first) / std::max(1.0, static_cast<double>(entries.size()) - 1);
  if (*picture.time < first - interval || *picture.time > last + interval) {
    Problem problem;
    problem.where.file = picture.series.string();
    problem.key = "time";
    problem.value = fmt::format("{:g} s", *picture.time);
    problem.rule = fmt::format("must be near a frame; there are some from {:g} to {:g} s", first, last);
    throw InputError(problem);
  }
  return *std::min_element(entries.begin(), entries.end(), [&](const SeriesEntry& a, const SeriesEntry& b) {
    return std::abs(a.time - *picture.time) < std::abs(b.time - *picture.time);
  });
}

Range range_of(vtkDataArray& array, const Picture& picture) {
  if (picture.range) return *picture.range;
  if (!picture.lines || array.GetNumberOfTuples() == 0) return {array.GetRange()[0], array.GetRange()[1]};
  std::vector<double> values;
  for (vtkIdType i = 0; i < array.GetNumberOfTuples(); ++i) values.push_back(array.GetComponent(i, 0));
  const auto at = values.begin() + static_cast<std::ptrdiff_t>(shown_part * static_cast<double>(values.size() - 1));
  std::nth_element(values.begin(), at, values.end());
  return {0, *at};
}

// Through memory: what is wrong with the file is then said as of all others.
void save(vtkImageData& image, const std::filesystem::path& png) {
  vtkNew<vtkPNGWriter> writer;
  writer->SetInputData(&image);
  writer->WriteToMemoryOn();
  writer->Write();
  vtkUnsignedCharArray* bytes = writer->GetResult();
  if (bytes == nullptr) {
    throw RunError(
        fmt::format("{}: could not be made ({})", png.string(), vtkErrorCode::GetStringFromErrorCode(writer->GetErrorCode())));
  }
  write_text(png, {reinterpret_cast<const char*>(bytes->GetPointer(0)), static_cast<std::size_t>(bytes->GetNumberOfValues())});
}

// As many frames as can be seen in the time, evenly spread; the last is always one of them.
std::vector<SeriesEntry> thinned(const std::vector<SeriesEntry>& entries, double duration) {
  const auto most = static_cast<std::size_t>(std::max(1.0, duration * most_per_second));
  if (entries.size() <= most) return entries;
  std::vector<SeriesEntry> chosen;
  for (std::size_t i = 1; i <= most; ++i) chosen.push_back(entries[i * entries.size() / most - 1]);
  return chosen;
}

double rate_of(std::size_t frames, const Film& film) {
  const auto count = static_cast<double>(frames);
  const double wanted = film.duration ? count / *film.duration : std::max(count / usual_duration, fewest_per_second);
  return std::min(wanted, most_per_second);
}

void tell(const Film& film) {
  if (film.before_frame) film.before_frame();
}

// What all frames have in common: the legend, and where the camera looks.
struct Common {
  vtkDataArray* array = nullptr;  // of `last`
  ShownFrame last;
  Range range{};
  std::vector<Eigen::Vector3d> points;
};

Common look_through(const Picture& picture, const Film& film, const std::vector<SeriesEntry>& entries) {
  Common common;
  for (const SeriesEntry& entry : entries) {
    tell(film);
    common.last = read_shown(picture, entry);
    common.array = common.last.array;
    const Range range = range_of(*common.array, picture);
    const bool first = common.points.empty();
    common.range = first ? range : Range{std::min(common.range[0], range[0]), std::max(common.range[1], range[1])};
    const auto points = points_in_view(*common.last.grid, picture);
    const std::size_t step = points.size() / points_per_frame + 1;
    for (std::size_t i = 0; i < points.size(); i += step) common.points.push_back(points[i]);
  }
  return common;
}

}  // namespace

namespace vtk {

double render(const Picture& picture, const std::filesystem::path& png) {
  const ShownFrame frame = read_shown(picture, choose_frame(picture));
  const Colouring colouring = make_colours(*frame.array, range_of(*frame.array, picture));
  Canvas canvas(picture, colouring, points_in_view(*frame.grid, picture));
  save(*canvas.draw(frame), png);
  return frame.time;
}

void animate(const Picture& picture, const Film& film, const std::filesystem::path& video) {
  const auto entries = thinned(frames_of(picture), film.duration.value_or(usual_duration));
  const Common common = look_through(picture, film, entries);
  Canvas canvas(picture, make_colours(*common.array, common.range), common.points);
  write_video(video, {picture.width, picture.height, rate_of(entries.size(), film)}, [&](const TakeImage& take) {
    for (const SeriesEntry& entry : entries) {
      tell(film);
      const auto image = canvas.draw(read_shown(picture, entry));
      take(static_cast<const unsigned char*>(image->GetScalarPointer()));
    }
  });
}

}  // namespace vtk

}  // namespace scree::output

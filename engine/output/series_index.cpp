#include "engine/output/series_index.h"

#include <cstdlib>

#include <fmt/format.h>
#include <vtkSmartPointer.h>
#include <vtkXMLDataElement.h>
#include <vtkXMLUtilities.h>

#include "engine/base/atomic_file.h"
#include "engine/base/check.h"

namespace scree::output {

std::vector<SeriesEntry> read_index(const std::filesystem::path& index) {
  if (!std::filesystem::is_regular_file(index)) throw RunError(fmt::format("{}: there is no such series", index.string()));
  const auto root = vtkSmartPointer<vtkXMLDataElement>::Take(vtkXMLUtilities::ReadElementFromFile(index.c_str()));
  auto* collection = root == nullptr ? nullptr : root->FindNestedElementWithName("Collection");
  if (collection == nullptr) throw RunError(fmt::format("{}: is no series of frames (.pvd)", index.string()));
  std::vector<SeriesEntry> entries;
  for (int i = 0; i < collection->GetNumberOfNestedElements(); ++i) {
    auto* frame = collection->GetNestedElement(i);
    const char* time = frame->GetAttribute("timestep");
    const char* file = frame->GetAttribute("file");
    if (time == nullptr || file == nullptr || !std::filesystem::is_regular_file(index.parent_path() / file)) {
      throw RunError(fmt::format("{}: names a frame that is missing ({})", index.string(), file == nullptr ? "no name" : file));
    }
    entries.push_back({std::strtod(time, nullptr), file});
  }
  return entries;
}

void write_index(const std::filesystem::path& index, const std::vector<SeriesEntry>& entries) {
  std::string text =
      "<?xml version=\"1.0\"?>\n"
      "<VTKFile type=\"Collection\" version=\"0.1\" byte_order=\"LittleEndian\">\n"
      "  <Collection>\n";
  for (const SeriesEntry& entry : entries) {
    text += fmt::format("    <DataSet timestep=\"{}\" part=\"0\" file=\"{}\"/>\n", entry.time, entry.file);
  }
  write_text(index, text + "  </Collection>\n</VTKFile>\n");
}

}  // namespace scree::output

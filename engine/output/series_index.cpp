#include "engine/output/series_index.h"

#include <fmt/format.h>
#include <boost/property_tree/ptree.hpp>
#include <boost/property_tree/xml_parser.hpp>

#include "engine/base/atomic_file.h"
#include "engine/base/check.h"
#include "engine/base/plain_number.h"

namespace scree::output {

std::vector<SeriesEntry> read_index(const std::filesystem::path& index) {
  std::error_code ignored;
  if (!std::filesystem::is_regular_file(index, ignored)) {
    throw RunError(fmt::format("{}: there is no such series of frames", index.string()));
  }
  boost::property_tree::ptree root;
  try {
    boost::property_tree::read_xml(index.string(), root);
  } catch (const boost::property_tree::xml_parser_error&) {
    root.clear();
  }
  const auto collection = root.get_child_optional("VTKFile.Collection");
  if (!collection) throw RunError(fmt::format("{}: is no series of frames (.pvd)", index.string()));
  std::vector<SeriesEntry> entries;
  for (const auto& [name, frame] : *collection) {
    if (name != "DataSet") continue;
    const auto time = plain_number(frame.get("<xmlattr>.timestep", std::string()));
    const auto file = frame.get_optional<std::string>("<xmlattr>.file");
    if (!time || !file || !std::filesystem::is_regular_file(index.parent_path() / *file, ignored)) {
      throw RunError(fmt::format("{}: names a frame that is missing ({})", index.string(), file.value_or("no name")));
    }
    entries.push_back({*time, *file});
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
